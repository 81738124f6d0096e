/// Kills at any moment: nothing is half-written, former results stay, and a run goes on where it was.

#include "document/json_text.hpp"
#include "result_files.hpp"

#include <gtest/gtest.h>
#include <boost/json/value.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;
namespace json = boost::json;

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
  const WorkFolder folder;
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
      const Contents before = contents(out);
      Process process({"run", file, "-o", out, "--threads", "2", "--resume"}, folder);
      std::this_thread::sleep_for(moment(rng) * duration);
      process.signal(signal);
      const Outcome o = process.wait();
      const Contents left = contents(out);
      expect_whole(left, what);
      if (o.code == 1000 + signal) {
        // Killed: for SIGTERM that is before it was listened to.
        EXPECT_TRUE(signal == SIGKILL || left == before) << what;
      } else {
        EXPECT_TRUE(o.code == 0 || (signal == SIGTERM && o.code == 130)) << what << ' ' << o.code << o.err;
        // Before anything is computed there is nothing to write.
        EXPECT_TRUE(left.contains("results.json") || (o.code == 130 && left == before)) << what;
        EXPECT_EQ(without_temporaries(left).size(), left.size()) << what;
      }
    }
    const Outcome o = run_program({"run", file, "-o", out, "--threads", "2", "--resume"});
    EXPECT_EQ(o.code, 0) << what << o.err;
    const json::value resumed = timeless(read_results(out));
    EXPECT_EQ(write_json(resumed), write_json(whole)) << what;
    const Contents left = contents(out);
    expect_whole(left, what);
    EXPECT_EQ(without_temporaries(left).size(), left.size()) << what;
  }
}

INSTANTIATE_TEST_SUITE_P(AnyMoment, Kills,
                         ::testing::Combine(::testing::ValuesIn(task_cases()),
                                            ::testing::Values(SIGKILL, SIGTERM)),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param).name) +
                                  (std::get<1>(info.param) == SIGKILL ? "_killed" : "_terminated");
                         });

/// At the worst moment: as soon as a file is seen that has no name yet.
TEST(Kills, WhileFilesAreWritten)
{
  const WorkFolder folder;
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
    EXPECT_EQ(resumed.size(), 4U);
    EXPECT_EQ(without_temporaries(resumed).size(), 4U);
  }
  if (hit == 0) GTEST_SKIP() << "the disk is too fast to be caught at that moment";
}

/// Results of a former run are in their place or kept beside, whole, until another run is done.
TEST(Kills, FormerResultsStayUntilTheRunIsDone)
{
  const WorkFolder folder;
  const std::string out = folder / "out", mail = folder.write("m.json", chainmail_text());
  ASSERT_EQ(run_program({"run", folder.write("c.json", map_text()), "-o", out}).code, 0);
  const Contents before = contents(out);
  ASSERT_EQ(before.size(), 4U);
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
    EXPECT_EQ(contents(out + "/.hauberk-previous"), before);
  }
  ASSERT_EQ(run_program({"run", mail, "-o", out, "--force"}).code, 0);
  EXPECT_FALSE(fs::exists(out + "/.hauberk-previous"));
  const Contents after = contents(out);
  EXPECT_EQ(after.size(), 4U);
  EXPECT_FALSE(after.contains("stability.csv")) << "of the former run";
}

}  // namespace
}  // namespace hauberk::test
