/// Interrupting a run, and going on with it.

#include "document/json_text.hpp"
#include "result_files.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <sys/wait.h>
#include <unistd.h>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <thread>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;
namespace json = boost::json;

/// Takes hours: a limit with very many starts. The first one is, at once, one that nothing stops.
std::string endless_text()
{
  return with(with(chain_text(), R"("directions_deg": [0])", R"("directions_deg": [90, 0])"),
              R"("preset": "accurate")", R"("preset": "accurate", "starts": 200000)");
}

bool appears(const fs::path& file)
{
  for (int k = 0; k < 1200; ++k) {
    if (fs::exists(file)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

class Stopping : public ::testing::TestWithParam<int> {};

TEST_P(Stopping, LeavesPartialResults)
{
  const WorkFolder folder;
  Process process({"run", folder.write("c.json", endless_text()), "-o", folder / "out", "--threads", "2"},
                  folder);
  ASSERT_TRUE(appears(folder.path() / "out" / "results.json"));
  process.signal(GetParam());
  const Outcome o = process.wait();
  EXPECT_EQ(o.code, 130) << o.err;
  EXPECT_NE(o.out.find("interrupted: these results are partial; go on with --resume\n"), std::string::npos)
      << o.out;
  const json::value r = read_results(folder / "out");
  EXPECT_EQ(r.at_pointer("/limits/0/status").as_string(), "unbounded");
  EXPECT_EQ(r.at_pointer("/limits/1/status").as_string(), "interrupted");
}

INSTANTIATE_TEST_SUITE_P(Signals, Stopping, ::testing::Values(SIGINT, SIGTERM));

TEST(Stopping, AKillLosesNothingFinished)
{
  const WorkFolder folder;
  Process process({"run", folder.write("c.json", endless_text()), "-o", folder / "out", "--threads", "2"},
                  folder);
  ASSERT_TRUE(appears(folder.path() / "out" / "results.json"));
  process.signal(SIGKILL);
  EXPECT_EQ(process.wait().code, 1000 + SIGKILL);
  EXPECT_EQ(read_results(folder / "out").at_pointer("/limits/0/status").as_string(), "unbounded");
}

TEST(Resuming, GivesTheSameResultsAsOneRun)
{
  const WorkFolder folder;
  // What was learnt from other limits is learnt again, so that nothing would be kept.
  const std::string file =
      folder.write("mail.json", with(chainmail_text(), R"("starts": 2)", R"("starts": 2, "lessons": false)"));
  const std::string out = folder / "out";
  ASSERT_EQ(run_program({"run", file, "-o", out}).code, 0);
  const json::value whole = read_results(out);
  // As an interrupt leaves it: two limits are not there yet.
  json::value partial = whole;
  for (const char* k : {"/limits/1", "/limits/4"}) {
    partial.at_pointer(std::string(k) + "/status") = "interrupted";
    partial.at_pointer(std::string(k) + "/value") = nullptr;
    partial.at_pointer(std::string(k) + "/poses").as_array().clear();
  }
  // Marks a limit that must not be computed again.
  partial.at_pointer("/limits/0/message") = "kept";
  // The largest part of a run that was done in parts: more than the other ones need.
  json::value timings = read_timings(out);
  timings.at("peak_memory_bytes") = std::int64_t{1} << 40;
  std::ofstream(out + "/timings.json") << write_json(timings);
  write_partial_results(out, partial);

  const Outcome o = run_program({"run", file, "-o", out, "--resume"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("resuming: finished limits are kept\n"), std::string::npos) << o.err;
  json::value resumed = read_results(out);
  EXPECT_EQ(resumed.at_pointer("/limits/0/message").as_string(), "kept");
  EXPECT_EQ(number_at(read_timings(out), "/peak_memory_bytes"), std::ldexp(1.0, 40));
  EXPECT_EQ(number_at(read_timings(out), "/seconds/~1limits~10"), number_at(timings, "/seconds/~1limits~10"));
  resumed.at_pointer("/limits/0/message") = whole.at_pointer("/limits/0/message");
  EXPECT_EQ(write_json(timeless(resumed)), write_json(timeless(whole)));

  // Times that cannot be read are no reason to lose results, and are not lost in silence.
  std::ofstream(out + "/timings.json") << "{ \"format\"";
  write_partial_results(out, partial);
  const Outcome timeless_run = run_program({"run", file, "-o", out, "--resume"});
  EXPECT_EQ(timeless_run.code, 0) << timeless_run.err;
  EXPECT_NE(timeless_run.err.find("timings.json:"), std::string::npos) << timeless_run.err;
  EXPECT_NE(timeless_run.err.find("; the times of that run are left out\n"), std::string::npos)
      << timeless_run.err;
  json::value untimed = read_results(out);
  untimed.at_pointer("/limits/0/message") = whole.at_pointer("/limits/0/message");
  EXPECT_EQ(write_json(timeless(untimed)), write_json(timeless(whole)));

  // What a kill after the last result leaves: a file without its name, and results of the run before.
  const pid_t killed = ::fork();
  if (killed == 0) ::_exit(0);
  ::waitpid(killed, nullptr, 0);
  const std::string unnamed = out + "/.limits.csv.tmp-" + std::to_string(killed);
  const std::string previous = out + "/.hauberk-previous";
  std::filesystem::create_directory(previous);
  for (const std::string& left : {unnamed, previous + "/limits.csv"}) std::ofstream(left) << "old";
  const Outcome again = run_program({"run", file, "-o", out, "--resume"});
  EXPECT_EQ(again.code, 0);
  EXPECT_EQ(again.out, out + "/results.json: complete already\n");
  EXPECT_FALSE(std::filesystem::exists(unnamed));
  EXPECT_FALSE(std::filesystem::exists(previous));
}

/// A limit that was finished before the kill learns from one that was not.
TEST(Resuming, FinishedLimitsLearnFromNewOnes)
{
  const WorkFolder folder;
  const std::string alone_text =
      with(with(with(chainmail_text(), R"("repeat": [2, 1])", R"("repeat": [2, 2])"), "[0, 30, 90]",
                R"([0], "senses": ["compress"], "hold": [])"),
           R"("starts": 2 })", R"("neighbours": 0 }, "seed": 3)");
  const std::string text = with(alone_text, "[0]", "[0, 10]"), out = folder / "out";
  const std::string file = folder.write("mail.json", text);
  ASSERT_EQ(run_program({"run", file, "-o", out}).code, 0);
  const json::value whole = read_results(out);
  ASSERT_EQ(run_program({"run", folder.write("alone.json", alone_text), "-o", folder / "alone", "--set",
                         "/solver/lessons=false"})
                .code,
            0);
  const json::value alone = read_results(folder / "alone");
  ASSERT_GT(number_at(alone, "/limits/0/value"), 0.9 * number_at(whole, "/limits/0/value"))
      << "there is nothing to learn here";
  json::value partial = whole;
  partial.at_pointer("/limits/0") = alone.at_pointer("/limits/0");
  partial.at_pointer("/limits/1/status") = "interrupted";
  write_partial_results(out, partial);
  EXPECT_EQ(run_program({"run", file, "-o", out, "--resume"}).code, 0);
  EXPECT_EQ(write_json(timeless(read_results(out))), write_json(timeless(whole)));
  // What has learnt learns again, from states of its own run.
  partial = whole;
  partial.at_pointer("/limits/1/status") = "interrupted";
  write_partial_results(out, partial);
  EXPECT_EQ(run_program({"run", file, "-o", out, "--resume"}).code, 0);
  EXPECT_EQ(write_json(timeless(read_results(out))), write_json(timeless(whole)));
}

TEST(Resuming, StartsAnewWhereNothingIs)
{
  const WorkFolder folder;
  const Outcome o =
      run_program({"run", folder.write("c.json", chain_text()), "-o", folder / "out", "--resume"});
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.err.find("nothing to resume: starting anew\n"), std::string::npos) << o.err;
}

TEST(Resuming, RefusesOtherExperiments)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", chain_text());
  ASSERT_EQ(run_program({"run", file, "-o", folder / "out"}).code, 0);
  const std::string results = folder / "out/results.json", before = read_text(results);
  const Outcome o =
      run_program({"run", file, "-o", folder / "out", "--resume", "--set", "/solver/tolerance=1e-3"});
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(
      o.err,
      "hauberk: " + results +
          ": cannot be resumed: it was computed from another experiment; give the same file and --set, or "
          "start anew with --force\n");
  EXPECT_EQ(read_text(results), before);
}

/// A number that somebody has changed is not gone on from, and neither is what nothing vouches for.
TEST(Resuming, RefusesWhatWasChanged)
{
  const WorkFolder folder;
  const std::string file = folder.write("e.json", endless_text()), out = folder / "out";
  Process process({"run", file, "-o", out, "--quiet"}, folder);
  for (int k = 0; k < 3000 && !fs::exists(out + "/results.json"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  process.signal(SIGINT);
  ASSERT_EQ(process.wait().code, 130);
  const std::string text = read_text(out + "/results.json");
  const auto refused = [&](const char* why) {
    const Outcome o = run_program({"run", file, "-o", out, "--resume"});
    EXPECT_EQ(o.code, 2) << o.out;
    EXPECT_NE(o.err.find(why), std::string::npos) << o.err;
  };
  std::string changed = text;
  changed.replace(changed.find("\"unbounded\""), 11, "\"stalled\"");
  std::ofstream(out + "/results.json", std::ios::binary) << changed;
  refused("results.json: cannot be resumed: it is not as the run left it");
  std::ofstream(out + "/results.json", std::ios::binary) << text;
  fs::remove(out + "/.hauberk-digest");
  refused("nothing tells that these partial results are as a run left them");
}

TEST(Resuming, RefusesOtherFormats)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", chain_text());
  ASSERT_EQ(run_program({"run", file, "-o", folder / "out"}).code, 0);
  const std::string results = folder / "out/results.json";
  const std::string other = with(read_text(results), "\"hauberk-results/2\"", "\"hauberk-results/1\"");
  std::ofstream(results) << other;
  const Outcome o = run_program({"run", file, "-o", folder / "out", "--resume"});
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(o.err,
            "hauberk: " + results +
                ": cannot be resumed: it has the format hauberk-results/1, and this program goes on from "
                "hauberk-results/2 alone; start anew with --force\n");
  EXPECT_EQ(read_text(results), other);
}

TEST(Resuming, RefusesFilesThatAreNoResults)
{
  const WorkFolder folder;
  fs::create_directory(folder / "out");
  const std::string results = folder.write("out/results.json", "{\"experiment\": 1}");
  const Outcome o =
      run_program({"run", folder.write("c.json", chain_text()), "-o", folder / "out", "--resume"});
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("hauberk: " + results + ": cannot be resumed: "), std::string::npos) << o.err;
  EXPECT_EQ(read_text(results), "{\"experiment\": 1}");
}

}  // namespace
}  // namespace hauberk::test
