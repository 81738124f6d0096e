#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <typeinfo>

namespace hauberk::test {

namespace fs = std::filesystem;

inline const fs::path bad_plugins = BAD_PLUGINS;

inline fs::path bad(const std::string& id) { return bad_plugins / (id + ".so"); }

/// The text of the exception of type Error that f throws; anything else is a failure.
template <class Error, class F>
std::string message_of(F&& f)
{
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << "threw " << typeid(error).name() << ": " << error.what();
    return {};
  }
  ADD_FAILURE() << "threw nothing";
  return {};
}

/// A fresh folder, removed at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder()
  {
    std::string name = (fs::canonical(fs::temp_directory_path()) / "hauberk-XXXXXX").native();
    if (!mkdtemp(name.data())) throw std::runtime_error("mkdtemp failed");
    path_ = name;
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }
  fs::path operator/(const std::string& name) const { return path_ / name; }
  fs::path folder(const std::string& name) const
  {
    fs::create_directories(path_ / name);
    return path_ / name;
  }
  fs::path file(const std::string& name, const std::string& content) const
  {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  fs::path path_;
};

}  // namespace hauberk::test
