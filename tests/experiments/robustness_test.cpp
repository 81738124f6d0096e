/// Disks that are full, folders that cannot be written, kills at any moment: nothing is half-written, former
/// results stay, and what was computed is on the disk or can be computed again.

#include "program.hpp"

#include <hauberk/results/json_text.hpp>

#include <gtest/gtest.h>

#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <thread>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;
namespace json = boost::json;

using Contents = std::map<std::string, std::string>;

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
  const TemporaryFolder folder;
  const SmallDisk disk(bytes);
  return Process(arguments, folder).wait();
}

/// Files of a folder by name; none where there is no folder.
Contents contents(const fs::path& folder)
{
  Contents out;
  if (!fs::exists(folder)) return out;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) out[entry.path().filename().string()] = read_text(entry.path());
  }
  return out;
}

/// Names that begin with a dot: what a killed program has not yet given its name.
bool is_temporary(const std::string& name) { return name.front() == '.'; }

Contents without_temporaries(Contents files)
{
  std::erase_if(files, [](const auto& file) { return is_temporary(file.first); });
  return files;
}

/// Every result is whole: JSON that parses, a table whose rows are equally long, a picture that is closed.
void expect_whole(const Contents& files, const std::string& what)
{
  for (const auto& [name, text] : files) {
    if (is_temporary(name)) continue;
    if (name.ends_with(".json")) {
      EXPECT_NO_THROW(parse_json(text, name)) << what;
    } else if (name.ends_with(".csv")) {
      ASSERT_TRUE(text.ends_with("\n")) << what << ' ' << name;
      std::istringstream lines(text);
      std::string line;
      std::getline(lines, line);
      const auto columns = std::count(line.begin(), line.end(), ',');
      EXPECT_GT(columns, 3) << what << ' ' << name;
      while (std::getline(lines, line)) EXPECT_GE(std::count(line.begin(), line.end(), ','), columns) << line;
    } else if (name.ends_with(".svg")) {
      EXPECT_TRUE(text.ends_with("</svg>\n")) << what << ' ' << name;
    } else {
      ADD_FAILURE() << what << ": left " << name;
    }
  }
  if (!files.contains("results.json")) return;
  const json::value results = parse_json(files.at("results.json"), "results.json");
  for (const auto& [key, name] : results.at("files").as_object())
    EXPECT_TRUE(files.contains(std::string(name.as_string()))) << what << ": lacks " << name;
}

struct TaskCase {
  const char* name;
  std::string (*text)();
  bool same_when_resumed;  ///< bit for bit, share/doc/command.md
};

const TaskCase tasks[] = {
    {"limits", chainmail_text, true}, {"design", design_text, false}, {"stability", map_text, true}};

std::ostream& operator<<(std::ostream& out, const TaskCase& task) { return out << task.name; }

class FullDisk : public ::testing::TestWithParam<TaskCase> {};

/// The limit cuts each file in turn near its end, and all of them.
TEST_P(FullDisk, LeavesNothingOrEverything)
{
  const TemporaryFolder folder;
  const std::string file = folder.write("e.json", GetParam().text());
  const Outcome whole = run_program({"run", file, "-o", folder / "whole"});
  ASSERT_EQ(whole.code, 0) << whole.out << whole.err;
  const Contents complete = contents(folder / "whole");
  std::vector<std::size_t> sizes;
  for (const auto& [name, text] : complete) sizes.push_back(text.size());
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
    EXPECT_GE(too_small(complete.at(name).size()), bytes - bytes / 20) << "a file that would have fit";
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
    if (GetParam().same_when_resumed) {
      EXPECT_EQ(write_json(timeless(read_results(out))),
                write_json(timeless(read_results(folder / "whole"))));
    }
  }
  // All fits: nothing is said.
  const Outcome enough = run_on_small_disk({"run", file, "-o", folder / "enough", "--quiet"}, largest + 4096);
  EXPECT_EQ(enough.code, 0) << enough.err;
  EXPECT_EQ(enough.err, "");
}

INSTANTIATE_TEST_SUITE_P(Tasks, FullDisk, ::testing::ValuesIn(tasks),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(FullDisk, FormerResultsStay)
{
  const TemporaryFolder folder;
  const std::string file = folder.write("c.json", chain_text()), out = folder / "out";
  ASSERT_EQ(run_program({"run", file, "-o", out}).code, 0);
  const Contents before = contents(out);
  for (const rlim_t bytes : {1200, 4096}) {
    const Outcome o = run_on_small_disk(
        {"run", file, "-o", out, "--force", "--set", "/solver/preset=fast", "--set", "/expect=[]"}, bytes);
    EXPECT_EQ(o.code, 1) << o.err;
    EXPECT_EQ(contents(out), before);
    EXPECT_FALSE(fs::exists(out + "/previous"));
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

/// Never done: a limit with very many starts beside one that is decided at once.
std::string endless_text()
{
  return with(with(chain_text(), R"(["stretch"])", R"(["compress", "stretch"])"), R"("preset": "accurate")",
              R"("preset": "accurate", "starts": 200000)");
}

/// The folder is gone when results are to be written to it: they go where temporary files do.
TEST(FullDisk, ResultsAreRescued)
{
  const TemporaryFolder folder;
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
  EXPECT_EQ(read_results(rescued[0]).at_pointer("/limits/0/status").as_string(), "not_attained");
}

TEST(FullDisk, StandardOutputAndProgress)
{
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const TemporaryFolder folder;
  const std::string file = folder.write("c.json", chain_text());
  Process full_out({"run", file, "-o", folder / "a"}, folder, "/dev/full");
  const Outcome o = full_out.wait();
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("hauberk: standard output cannot be written\n"), std::string::npos) << o.err;
  EXPECT_EQ(read_results(folder / "a").at_pointer("/limits/0/status").as_string(), "locked");
  // Progress is not worth a result.
  EXPECT_EQ(Process({"run", file, "-o", folder / "b"}, folder, "", "/dev/full").wait().code, 0);
}

/// As root no permission helps, so these are folders that nobody can write to.
TEST(FoldersThatCannotBeWritten, AreBadInputBeforeAnythingIsComputed)
{
  const TemporaryFolder folder;
  const std::string file = folder.write("c.json", endless_text());
  for (const std::string& out :
       {file + "/below/a/file", std::string("/proc/hauberk"), std::string("/dev/null")}) {
    const Outcome o = run_program({"run", file, "-o", out});
    EXPECT_EQ(o.code, 2) << out;
    EXPECT_EQ(o.err.find("hauberk: " + out + ": this output folder cannot be "), 0U) << o.err;
    EXPECT_TRUE(o.err.ends_with("; give another one with -o\n")) << o.err;
  }
}

TEST(FoldersThatCannotBeWritten, WhatAKilledRunLeftIsRemoved)
{
  const TemporaryFolder folder;
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

/// Kills per task and signal; HAUBERK_KILLS for more.
int kill_count()
{
  const char* text = std::getenv("HAUBERK_KILLS");
  return text != nullptr ? std::atoi(text) : 3;
}

class Kills : public ::testing::TestWithParam<std::tuple<TaskCase, int>> {};

/// When the kill hits is random (its fraction of the time of a whole run is seeded); that nothing is broken
/// afterwards must hold for every moment.
TEST_P(Kills, LeaveWholeResultsThatCanBeResumed)
{
  const auto& [task, signal] = GetParam();
  const TemporaryFolder folder;
  const std::string file = folder.write("e.json", task.text());
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(run_program({"run", file, "-o", folder / "whole", "--threads", "2"}).code, 0);
  const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - begin;
  const json::value whole = timeless(read_results(folder / "whole"));
  std::mt19937_64 rng(static_cast<unsigned>(signal));
  std::uniform_real_distribution<double> moment(0.0, 1.0);
  for (int k = 0; k < kill_count(); ++k) {
    const std::string out = folder / ("out" + std::to_string(k));
    const std::string what = "kill " + std::to_string(k);
    // Twice, the second time while it resumes.
    for (int kill = 0; kill < 2; ++kill) {
      Process process({"run", file, "-o", out, "--threads", "2", "--resume"}, folder);
      std::this_thread::sleep_for(moment(rng) * duration);
      process.signal(signal);
      const Outcome o = process.wait();
      const Contents left = contents(out);
      expect_whole(left, what);
      if (o.code == 1000 + signal) {
        // Killed: for SIGTERM that is before it was listened to.
        EXPECT_TRUE(signal == SIGKILL || left.empty()) << what;
      } else {
        EXPECT_TRUE(o.code == 0 || (signal == SIGTERM && o.code == 130)) << what << ' ' << o.code << o.err;
        EXPECT_TRUE(left.contains("results.json")) << what;
        EXPECT_EQ(without_temporaries(left).size(), left.size()) << what;
      }
    }
    const Outcome o = run_program({"run", file, "-o", out, "--threads", "2", "--resume"});
    EXPECT_EQ(o.code, 0) << what << o.err;
    const json::value resumed = timeless(read_results(out));
    if (task.same_when_resumed) {
      EXPECT_EQ(write_json(resumed), write_json(whole)) << what;
    } else {
      // The search starts again from the best design so far; what precedes it does not depend on that.
      EXPECT_EQ(write_json(resumed.at_pointer("/design/initial/limits")),
                write_json(whole.at_pointer("/design/initial/limits")))
          << what;
      EXPECT_NE(resumed.at_pointer("/design/status").as_string(), "interrupted") << what;
    }
    const Contents left = contents(out);
    expect_whole(left, what);
    EXPECT_EQ(without_temporaries(left).size(), left.size()) << what;
  }
}

INSTANTIATE_TEST_SUITE_P(AnyMoment, Kills,
                         ::testing::Combine(::testing::ValuesIn(tasks), ::testing::Values(SIGKILL, SIGTERM)),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param).name) +
                                  (std::get<1>(info.param) == SIGKILL ? "_killed" : "_terminated");
                         });

/// At the worst moment: as soon as a file is seen that has no name yet.
TEST(Kills, WhileFilesAreWritten)
{
  const TemporaryFolder folder;
  const std::string file = folder.write("c.json", chain_text());
  const auto writing = [](const Contents& files) {
    return std::any_of(files.begin(), files.end(), [](const auto& f) {
      return f.first.starts_with(".limits") || f.first.starts_with(".results");
    });
  };
  int hit = 0;
  for (int k = 0; k < 12; ++k) {
    const std::string out = folder / ("out" + std::to_string(k));
    fs::create_directory(out);
    Process process({"run", file, "-o", out, "--quiet"}, folder);
    // Looks without a pause; a run that is done has a table, too.
    while (!writing(contents(out)) && !fs::exists(out + "/results.json")) {
    }
    process.signal(SIGKILL);
    process.wait();
    const Contents left = contents(out);
    hit += writing(left) ? 1 : 0;
    expect_whole(left, "while writing");
    EXPECT_EQ(run_program({"run", file, "-o", out, "--resume"}).code, 0);
    const Contents resumed = contents(out);
    EXPECT_EQ(resumed.size(), 3U);
    EXPECT_EQ(without_temporaries(resumed).size(), 3U);
  }
  EXPECT_GT(hit, 0) << "the disk is too fast to be caught";
}

/// Results of a former run are in their place or kept beside, whole, until another run is done.
TEST(Kills, FormerResultsStayUntilTheRunIsDone)
{
  const TemporaryFolder folder;
  const std::string out = folder / "out", mail = folder.write("m.json", chainmail_text());
  ASSERT_EQ(run_program({"run", folder.write("c.json", map_text()), "-o", out}).code, 0);
  const Contents before = contents(out);
  ASSERT_EQ(before.size(), 3U);
  // Twice: what is kept is the finished run, not the partial one in between.
  for (int k = 0; k < 2; ++k) {
    Process process({"run", folder.write("e.json", endless_text()), "-o", out, "--threads", "2", "--force"},
                    folder);
    const auto replaced = [&] { return contents(out) != before && fs::exists(out + "/limits.csv"); };
    for (int wait = 0; wait < 1200 && !replaced(); ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ASSERT_TRUE(replaced());
    process.signal(k == 0 ? SIGKILL : SIGTERM);
    process.wait();
    expect_whole(contents(out), "forced");
    EXPECT_EQ(contents(out + "/previous"), before);
  }
  ASSERT_EQ(run_program({"run", mail, "-o", out, "--force"}).code, 0);
  EXPECT_FALSE(fs::exists(out + "/previous"));
  const Contents after = contents(out);
  EXPECT_EQ(after.size(), 3U);
  EXPECT_FALSE(after.contains("stability.csv")) << "of the former run";
}

}  // namespace
}  // namespace hauberk::test
