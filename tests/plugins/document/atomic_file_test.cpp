#include "document/atomic_file.hpp"
#include "temporary_folder.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <array>
#include <csignal>
#include <fstream>
#include <sstream>

namespace hauberk {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

std::string content(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// One file of a folder.
void write_file(const fs::path& path, const std::string& text)
{
  write_files_atomically(path.parent_path(), {{path.filename().string(), text}}, {});
}

/// What the output folder may hold.
constexpr std::array names{"results.json", "limits.csv"};

class AtomicFile : public ::testing::Test {
 protected:
  std::size_t entries() const
  {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

/// Lets files grow to `bytes` only: beyond, writing fails as on a full disk.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes)
  {
    ::getrlimit(RLIMIT_FSIZE, &former_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, former_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk()
  {
    ::setrlimit(RLIMIT_FSIZE, &former_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit former_{};
  void (*handler_)(int) = nullptr;
};

TEST_F(AtomicFile, ReplacesAndLeavesNothingElse)
{
  write_file(folder_ / "results.json", "first");
  write_file(folder_ / "results.json", std::string(100000, 'x'));
  EXPECT_EQ(content(folder_ / "results.json"), std::string(100000, 'x'));
  EXPECT_EQ(entries(), 1u);
}

TEST_F(AtomicFile, FullDiskKeepsTheFormerFileAndNamesIt)
{
  const fs::path path = folder_ / "results.json";
  write_file(path, "former");
  std::string message;
  {
    const SmallDisk disk(4096);
    try {
      write_file(path, std::string(100000, 'x'));
    } catch (const ComputationError& error) {
      message = error.what();
    }
  }
  EXPECT_EQ(message, path.string() + ": cannot be written: File too large");
  EXPECT_EQ(content(path), "former");
  EXPECT_EQ(entries(), 1u) << "the temporary file must be gone";
}

TEST_F(AtomicFile, MissingFolderAndFolderInTheWay)
{
  EXPECT_THROW(write_file(folder_ / "none" / "a.json", "x"), ComputationError);
  fs::create_directory(folder_ / "a.json");
  EXPECT_THROW(write_file(folder_ / "a.json", "x"), ComputationError);
  EXPECT_EQ(entries(), 1u);
}

TEST_F(AtomicFile, OutputFolderIsPreparedOrRefused)
{
  const fs::path out = folder_ / "deep" / "out";
  prepare_output_directory(out, false, names);
  EXPECT_TRUE(fs::is_directory(out));
  EXPECT_TRUE(fs::is_empty(out));
  write_file(out / "results.json", "{}");
  try {
    prepare_output_directory(out, false, names);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(
        error.what(),
        out.string() + ": holds results already (results.json); give another folder with -o, or --force");
  }
  EXPECT_NO_THROW(prepare_output_directory(out, true, names));
  write_file(folder_ / "limits.csv", "somebody's");
  EXPECT_THROW(prepare_output_directory(folder_, false, names), InputError);
  EXPECT_EQ(content(out / "results.json"), "{}");
  write_file(folder_ / "file", "");
  EXPECT_THROW(prepare_output_directory(folder_ / "file", false, names), InputError);
  EXPECT_THROW(prepare_output_directory(folder_ / "file" / "out", false, names), InputError);
}

}  // namespace
}  // namespace hauberk
