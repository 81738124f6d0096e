/// The folder of a divided run.

#include "parts/part_folder.hpp"
#include "temporary_folder.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>
#include <fstream>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;

class PartFolder : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directory(folder_ / parts_folder); }

  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

TEST(Share, TextAndItems)
{
  const Share third = share_named("3/8");
  EXPECT_EQ(third.index, 2U);
  EXPECT_EQ(part_name(third), "3-of-8");
  for (const char* bad :
       {"", "/", "3", "3/", "/8", "0/8", "9/8", "-1/8", "3/8 ", "3/8/8", "1/10001", "+1/2", "1.0/2"})
    EXPECT_THROW(share_named(bad), InputError) << bad;
  // Every item of two lists is in one share, and they are shared out as if they were one list.
  for (std::size_t count = 1; count < 7; ++count) {
    for (std::size_t first = 0; first < 9; ++first) {
      for (std::size_t item = 0; item < 20; ++item) {
        for (std::size_t k = 0; k < count; ++k) {
          const Share share{k, count};
          EXPECT_EQ(share.has(item), item % count == k);
          EXPECT_EQ(share.after(first).has(item), share.has(first + item));
        }
      }
    }
  }
}

TEST(PartList, IsThatOfSlurm)
{
  EXPECT_EQ(part_list({}), "");
  EXPECT_EQ(part_list({4}), "4");
  EXPECT_EQ(part_list({1, 2, 3, 7, 9, 10}), "1-3,7,9-10");
}

TEST_F(PartFolder, HoldsOneDivision)
{
  const Division d{8, "0a1b", "/a/b \"c\".json", {"/x=1", "y=\"2\""}, {"/lib"}};
  EXPECT_THROW(read_division(folder_), InputError);
  enter_division(folder_, d);
  enter_division(folder_, d);  // by another part
  const Division there = read_division(folder_);
  EXPECT_EQ(there.count, d.count);
  EXPECT_EQ(there.identity, d.identity);
  EXPECT_EQ(there.experiment, d.experiment);
  EXPECT_EQ(there.set, d.set);
  EXPECT_EQ(there.libraries, d.libraries);
  Division other = d;
  other.count = 7;
  EXPECT_THROW(enter_division(folder_, other), InputError);
  other = d;
  other.identity = "0a1c";
  EXPECT_THROW(enter_division(folder_, other), InputError);
  other = d;
  other.experiment = "/another/way/to/the/same.json";
  enter_division(folder_, other);
  EXPECT_EQ(read_division(folder_).experiment, d.experiment);
}

TEST_F(PartFolder, DamagedDivisionsAreRefused)
{
  const fs::path file = folder_ / parts_folder / parts_file;
  for (
      const char* text :
      {"", "{}", "[]", R"({"format": "hauberk-parts/2"})",
       R"({"format": "hauberk-parts/1", "parts": 0, "identity": "", "experiment": "", "set": [], "plugin_path": []})",
       R"({"format": "hauberk-parts/1", "parts": 1e300, "identity": "", "experiment": "", "set": [], "plugin_path": []})",
       R"({"format": "hauberk-parts/1", "parts": 2, "identity": "", "experiment": 3, "set": [], "plugin_path": []})"}) {
    std::ofstream(file) << text;
    EXPECT_THROW(read_division(folder_), InputError) << text;
  }
  fs::remove(file);
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);  // must not be waited for
  EXPECT_THROW(read_division(folder_), InputError);
}

TEST_F(PartFolder, LogsAreClaimedOnce)
{
  const fs::path first = claim_log(folder_, "a"), second = claim_log(folder_, "a");
  EXPECT_EQ(first, folder_ / "a-1.log");
  EXPECT_EQ(second, folder_ / "a-2.log");
  fs::create_symlink("/dev/null", folder_ / "a-3.log");
  EXPECT_EQ(claim_log(folder_, "a"), folder_ / "a-4.log");
  EXPECT_THROW(claim_log(folder_ / "nowhere", "a"), ComputationError);
}

TEST_F(PartFolder, LogsComeInTheOrderOfTheirNumbers)
{
  for (const char* name : {"a-10.log", "a-2.log", "a-1.log", "a-x.log", "a-.log", "ab-3.log", "a-4.log.tmp"})
    std::ofstream(folder_ / name) << "x";
  const std::vector<fs::path> expected{folder_ / "a-1.log", folder_ / "a-2.log", folder_ / "a-10.log"};
  EXPECT_EQ(logs_in(folder_, "a"), expected);
  EXPECT_TRUE(logs_in(folder_ / "nowhere", "a").empty());
}

}  // namespace
}  // namespace hauberk::test
