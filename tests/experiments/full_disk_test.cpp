/// Disks that are full and folders that cannot be written: nothing is half-written, former results stay, and
/// what was computed is on the disk or can be computed again.

#include "document/json_text.hpp"
#include "result_files.hpp"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;

/// Programs started while this lives may write files up to `bytes`; beyond, writing fails as on a full disk.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes)
  {
    ::getrlimit(RLIMIT_FSIZE, &former_);
    const rlimit limit{bytes, former_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() { ::setrlimit(RLIMIT_FSIZE, &former_); }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit former_{};
};

Outcome run_on_small_disk(const std::vector<std::string>& arguments, rlim_t bytes)
{
  const WorkFolder folder;
  const SmallDisk disk(bytes);
  return Process(arguments, folder).wait();
}

/// What it holds is made of times: its size is not that of another run.
bool sized_by_times(const std::string& name) { return name == "chart.csv" || name == "chart.svg"; }

class FullDisk : public ::testing::TestWithParam<TaskCase> {};

/// The limit cuts each file in turn near its end, and all of them.
TEST_P(FullDisk, LeavesNothingOrEverything)
{
  const WorkFolder folder;
  const std::string file = folder.write("e.json", GetParam().text());
  const Outcome whole = run_program({"run", file, "-o", folder / "whole"});
  ASSERT_EQ(whole.code, 0) << whole.out << whole.err;
  const Contents complete = contents(folder / "whole");
  std::vector<std::size_t> sizes;
  for (const auto& [name, text] : complete) {
    if (!sized_by_times(name)) sizes.push_back(text.size());
  }
  const std::size_t largest = *std::max_element(sizes.begin(), sizes.end());
  std::vector<std::size_t> disks{1};
  // Not by a byte: times have more digits in one run than in another.
  const auto too_small = [](std::size_t size) { return size - size / 20 - 1; };
  for (const std::size_t size : sizes) disks.push_back(too_small(size));
  int number = 0;
  for (const std::size_t disk : disks) {
    const std::string out = folder / ("out" + std::to_string(++number));
    // Messages go to a file, too.
    const std::size_t bytes = std::max<std::size_t>(disk, 1200);
    if (disk > 1 && disk < bytes) continue;
    const Outcome o = run_on_small_disk({"run", file, "-o", out, "--quiet"}, bytes);
    EXPECT_EQ(o.code, 1) << o.out << o.err;
    const std::size_t at = o.err.find("hauberk: " + out + "/");
    ASSERT_NE(at, std::string::npos) << o.err;
    const std::size_t name_at = at + 10 + out.size();
    const std::string name = o.err.substr(name_at, o.err.find(':', name_at) - name_at);
    ASSERT_TRUE(complete.contains(name)) << o.err;
    if (!sized_by_times(name)) {
      EXPECT_GE(too_small(complete.at(name).size()), bytes - bytes / 20) << "a file that would have fit";
    }
    EXPECT_NE(o.err.find(": cannot be written: File too large; make room, then go on with --resume from what "
                         "was written before\n"),
              std::string::npos)
        << o.err;
    // Partial results that were smaller may be there: all of them, and whole.
    const Contents left = contents(out);
    expect_whole(left, "disk of " + std::to_string(bytes));
    EXPECT_EQ(without_temporaries(left).size(), left.size());
    EXPECT_TRUE(left.empty() || left.contains("results.json"));
    for (const auto& [left_name, text] : left) EXPECT_LE(text.size(), bytes);
    // With room again it goes on.
    const Outcome again = run_program({"run", file, "-o", out, "--resume", "--quiet"});
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(write_json(timeless(read_results(out))), write_json(timeless(read_results(folder / "whole"))));
  }
  // All fits: nothing is said.
  const Outcome enough = run_on_small_disk({"run", file, "-o", folder / "enough", "--quiet"}, largest + 4096);
  EXPECT_EQ(enough.code, 0) << enough.err;
  EXPECT_EQ(enough.err, "");
}

INSTANTIATE_TEST_SUITE_P(Tasks, FullDisk, ::testing::ValuesIn(task_cases()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(FullDisk, FormerResultsStay)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", chain_text()), out = folder / "out";
  ASSERT_EQ(run_program({"run", file, "-o", out}).code, 0);
  const Contents before = contents(out);
  for (const rlim_t bytes : {1200, 4096}) {
    const Outcome o = run_on_small_disk(
        {"run", file, "-o", out, "--force", "--set", "/solver/tolerance=1e-3", "--set", "/expect=[]"}, bytes);
    EXPECT_EQ(o.code, 1) << o.err;
    EXPECT_EQ(contents(out), before);
    EXPECT_FALSE(fs::exists(out + "/.hauberk-previous"));
  }
}

bool appears(const fs::path& file)
{
  for (int k = 0; k < 1200; ++k) {
    if (fs::exists(file)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

/// The folder is gone when results are to be written to it: they go where temporary files do.
TEST(FullDisk, ResultsAreRescued)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", endless_text()), out = folder / "out";
  fs::create_directory(folder / "tmp");
  ::setenv("TMPDIR", (folder / "tmp").c_str(), 1);
  Process process({"run", file, "-o", out, "--threads", "2"}, folder);
  ::unsetenv("TMPDIR");
  ASSERT_TRUE(appears(out + "/results.json"));
  fs::remove_all(out);
  process.signal(SIGTERM);
  const Outcome o = process.wait();
  EXPECT_EQ(o.code, 1) << o.err;
  std::vector<fs::path> rescued;
  for (const auto& entry : fs::directory_iterator(folder / "tmp")) rescued.push_back(entry.path());
  ASSERT_EQ(rescued.size(), 1U) << o.err;
  EXPECT_NE(o.err.find("hauberk: " + out +
                       "/limits.csv: cannot be written: No such file or directory; the results are in " +
                       rescued[0].string() +
                       ": make room and move them, or go on with --resume from what was written before\n"),
            std::string::npos)
      << o.err;
  expect_whole(contents(rescued[0]), "rescued");
  EXPECT_EQ(read_results(rescued[0]).at_pointer("/limits/0/status").as_string(), "unbounded");
}

TEST(FullDisk, StandardOutputAndProgress)
{
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const WorkFolder folder;
  const std::string file = folder.write("c.json", chain_text());
  Process full_out({"run", file, "-o", folder / "a"}, folder, "/dev/full");
  const Outcome o = full_out.wait();
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("hauberk: standard output cannot be written\n"), std::string::npos) << o.err;
  EXPECT_EQ(read_results(folder / "a").at_pointer("/limits/0/status").as_string(), "locked");
  // Progress is not worth a result.
  EXPECT_EQ(Process({"run", file, "-o", folder / "b"}, folder, "", "/dev/full").wait().code, 0);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--help"},
                                                {"run", "--help"},
                                                {"plugins", "list"},
                                                {"man"},
                                                {"check", file, "--thorough"}})
    EXPECT_EQ(Process(words, folder, "/dev/full").wait().code, 1) << words.back();
}

/// As root no permission helps, so these are folders that nobody can write to.
TEST(FoldersThatCannotBeWritten, AreBadInputBeforeAnythingIsComputed)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", endless_text());
  for (const std::string& out :
       {file + "/below/a/file", std::string("/proc/hauberk"), std::string("/dev/null")}) {
    const Outcome o = run_program({"run", file, "-o", out});
    EXPECT_EQ(o.code, 2) << out;
    EXPECT_EQ(o.err.find("hauberk: " + out + ": this output folder cannot be "), 0U) << o.err;
    EXPECT_TRUE(o.err.ends_with("; give another one with -o\n")) << o.err;
  }
}

/// What no results there name is somebody's own, whatever it is called.
TEST(ForeignFiles, StayWhereTheyAre)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", chain_text()), out = folder / "out";
  fs::create_directories(out);
  for (const char* name : {"sweep.svg", "designed.json", "notes.txt"})
    folder.write(std::string("out/") + name, "mine");
  ASSERT_EQ(run_program({"run", file, "-o", out, "--force"}).code, 0);
  for (const char* name : {"sweep.svg", "designed.json", "notes.txt"})
    EXPECT_EQ(read_text(fs::path(out) / name), "mine") << name;
  // What runs left goes with their results.
  const std::string sweep = folder.write("s.json", sweep_text());
  fs::remove(fs::path(out) / "sweep.svg");
  ASSERT_EQ(run_program({"run", sweep, "-o", out, "--force"}).code, 0);
  EXPECT_FALSE(fs::exists(fs::path(out) / "profile.svg"));
  ASSERT_EQ(run_program({"run", file, "-o", out, "--force"}).code, 0);
  EXPECT_FALSE(fs::exists(fs::path(out) / "sweep.svg"));
  EXPECT_EQ(read_text(fs::path(out) / "designed.json"), "mine");
}

/// Nor is anything removed that a link leads to.
TEST(ForeignFiles, BehindALinkStay)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", chain_text()), out = folder / "out";
  ASSERT_EQ(run_program({"run", file, "-o", out}).code, 0);
  fs::create_directories(folder / "other");
  folder.write("other/results.json", "mine");
  folder.write("other/limits.csv", "mine");
  fs::create_directory_symlink(folder / "other", fs::path(out) / ".hauberk-previous");
  ASSERT_EQ(run_program({"run", file, "-o", out, "--force"}).code, 0);
  EXPECT_EQ(read_text(folder / "other/results.json"), "mine");
  EXPECT_EQ(read_text(folder / "other/limits.csv"), "mine");
  EXPECT_EQ(contents(folder / "other").size(), 2U);
  fs::create_directory_symlink(folder / "other", fs::path(out) / ".hauberk-previous");
  ASSERT_EQ(run_program({"run", file, "-o", out, "--resume"}).code, 0) << "complete already";
  EXPECT_EQ(contents(folder / "other").size(), 2U);
}

/// `...json` would be written to `out/..`.
TEST(ForeignFiles, NamesThatAreNoFolders)
{
  const WorkFolder folder;
  for (const char* name : {"...json", "..json"}) {
    const Outcome o = run_program({"run", folder.write(name, chain_text())});
    EXPECT_EQ(o.code, 2) << o.out;
    EXPECT_NE(o.err.find("gives no folder for results; give one with -o"), std::string::npos) << o.err;
  }
}

TEST(FoldersThatCannotBeWritten, WhatAKilledRunLeftIsRemoved)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", chain_text()), out = folder / "out";
  fs::create_directory(out);
  // No process has this number; one that runs has mine.
  folder.write("out/.results.json.tmp-4194305", "{");
  folder.write("out/.hauberk-write-test.4194305", "");
  const std::string mine = ".limits.csv.tmp-" + std::to_string(::getpid());
  folder.write("out/" + mine, "");
  folder.write("out/.notes.tmp-4194305", "somebody's");
  EXPECT_EQ(run_program({"run", file, "-o", out}).code, 0);
  const Contents left = contents(out);
  EXPECT_FALSE(left.contains(".results.json.tmp-4194305"));
  EXPECT_FALSE(left.contains(".hauberk-write-test.4194305"));
  EXPECT_TRUE(left.contains(mine));
  EXPECT_TRUE(left.contains(".notes.tmp-4194305"));
}

}  // namespace
}  // namespace hauberk::test
