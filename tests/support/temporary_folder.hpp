#pragma once
/// A folder for the files of one test.

#include <stdlib.h>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace hauberk::test {

/// Fresh, of a canonical path, and removed with all that is in it when its time is over.
class TemporaryFolder {
 public:
  TemporaryFolder()
  {
    namespace fs = std::filesystem;
    std::string name = (fs::canonical(fs::temp_directory_path()) / "hauberk-XXXXXX").native();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder " + name);
    path_ = name;
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  /// A folder in it, made where it is not there.
  std::filesystem::path folder(const std::string& name) const
  {
    std::filesystem::create_directories(path_ / name);
    return path_ / name;
  }
  /// A file in it with that content.
  std::filesystem::path file(const std::string& name, const std::string& content) const
  {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace hauberk::test
