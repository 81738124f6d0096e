#include "document/read_file.hpp"
#include "temporary_folder.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace hauberk {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

class ReadWholeFile : public ::testing::Test {
 protected:
  std::string path(const char* name) const { return (folder_ / name).string(); }
  /// What is said of a file that is refused; empty where it is read.
  static std::string refusal(const std::string& file, std::size_t megabytes = 1)
  {
    try {
      read_whole_file(file, megabytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

TEST_F(ReadWholeFile, GivesEveryByteUpToTheLimit)
{
  const std::string text = std::string("a\0b\r\n", 5) + std::string((1 << 20) - 5, 'x');
  std::ofstream(path("full"), std::ios::binary) << text;
  EXPECT_EQ(read_whole_file(path("full"), 1), text);
  std::ofstream(path("full"), std::ios::binary | std::ios::app) << 'y';
  EXPECT_EQ(refusal(path("full")), "cannot read '" + path("full") + "': it is larger than 1 MB");
}

TEST_F(ReadWholeFile, NeitherWaitsForAPipeNorReadsADevice)
{
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);  // nobody writes to it
  for (const std::string& file : {path("pipe"), std::string("/dev/zero")})
    EXPECT_NE(refusal(file).find("device or a pipe"), std::string::npos) << refusal(file);
  fs::create_symlink("/dev/zero", path("link"));
  EXPECT_NE(refusal(path("link")).find("device or a pipe"), std::string::npos);
  EXPECT_NE(refusal(folder_.string()).find("folder"), std::string::npos);
  EXPECT_NE(refusal(path("none")).find("No such file"), std::string::npos);
}

TEST_F(ReadWholeFile, LooksAtTheSizeBeforeItReads)
{
  std::ofstream(path("hole"), std::ios::binary) << 'x';
  fs::resize_file(path("hole"), std::uintmax_t{1} << 40);  // a terabyte that takes no place
  EXPECT_NE(refusal(path("hole"), 1024).find("larger than 1024 MB"), std::string::npos);
}

}  // namespace
}  // namespace hauberk
