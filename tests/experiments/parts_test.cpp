/// Runs in parts: gathered, they are the run that was not divided; and what is missing, damaged or of another
/// run is told.

#include "document/json_text.hpp"
#include "document/record_line.hpp"
#include "result_files.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <boost/crc.hpp>
#include <boost/json/array.hpp>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;
namespace json = boost::json;

/// Compressions, which learn from scenes that this one contains, and stretches.
std::string fan_text()
{
  return with(chainmail_text(), R"("directions_deg": [0, 30, 90])", R"("directions_deg": [0, 90])");
}

/// Directions over a sphere of strains.
std::string sphere_text()
{
  return with(with(chainmail_text(), R"("directions_deg": [0, 30, 90])", R"("directions": { "sphere": 1 })"),
              R"("repeat": [2, 1],)", R"("repeat": [1, 1],)");
}

/// Rows that learn from rows: a cell once and twice, and with its height fixed or not.
std::string rows_text()
{
  return R"({ "name": "rows", "task": "sweep", "cell": { "weave": { "name": "chain" } },
  "load_case": { "plugin": "in_plane_periodic", "directions_deg": [0] },
  "solver": { "tolerance": 1e-3 },
  "sweep": { "vary": [ { "name": "cells", "pointers": ["/cell/repeat"], "values": [[1, 1], [2, 1]] },
                       { "name": "clearance", "pointers": ["/solver/clearance"], "values": [0.05, 0.1] } ] } })";
}

std::string starts_text()
{
  return with(design_text(), R"("perturbation": 0,)", R"("starts": 3, "perturbation": 0.1,)");
}

const std::vector<TaskCase> divided{{"fan", fan_text},     {"sphere", sphere_text}, {"rows", rows_text},
                                    {"sweep", sweep_text}, {"stability", map_text}, {"design", starts_text}};

std::string part(int k, int n) { return fmt::format("{}/{}", k, n); }

Outcome run_part(const std::string& file, const std::string& out, int k, int n)
{
  return run_program({"run", file, "--part", part(k, n), "-o", out, "--quiet"});
}

/// A record as the program writes it, by another implementation of its checksum.
std::string with_checksum(const std::string& record)
{
  boost::crc_32_type crc;
  crc.process_bytes(record.data(), record.size());
  return fmt::format("{} {:08x} .", record, crc.checksum());
}

void write_lines(const fs::path& file, const std::vector<std::string>& lines)
{
  std::ofstream out(file, std::ios::binary);
  for (const std::string& line : lines) out << line << '\n';
}

/// Changes a record of a log, and makes it whole again.
void change(const fs::path& file, const std::string& beginning, const std::string& from,
            const std::string& to)
{
  std::vector<std::string> lines = lines_of(file);
  for (std::string& line : lines) {
    if (!line.starts_with(beginning)) continue;
    const std::string record(undamaged_record(line).value());
    const std::size_t at = record.find(from);
    ASSERT_NE(at, std::string::npos) << record;
    line = with_checksum(record.substr(0, at) + to + record.substr(at + from.size()));
    write_lines(file, lines);
    return;
  }
  FAIL() << "no record " << beginning << " in " << file;
}

class DividedRun : public ::testing::TestWithParam<TaskCase> {
 protected:
  void SetUp() override { file_ = folder_.write("e.json", GetParam().text()); }

  Contents whole()
  {
    const Outcome o = run_program({"run", file_, "-o", folder_ / "whole", "--quiet"});
    EXPECT_EQ(o.code, 0) << o.out << o.err;
    return results_in(folder_ / "whole");
  }

  WorkFolder folder_;
  std::string file_;
};

/// The parts in any order, one of them by two processes at a time.
TEST_P(DividedRun, GatheredIsTheWholeRunByteForByte)
{
  const Contents expected = whole();
  const std::string out = folder_ / "out";
  for (const int k : {3, 1}) ASSERT_EQ(run_part(file_, out, k, 3).code, 0);
  {
    const WorkFolder other;
    Process twin({"run", file_, "--part", "2/3", "-o", out, "--quiet"}, other);
    const Outcome own = run_part(file_, out, 2, 3);
    EXPECT_EQ(own.code, 0) << own.err;
    EXPECT_EQ(twin.wait().code, 0);
  }
  const Outcome o = run_program({"gather", out});
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  EXPECT_EQ(results_in(out), expected);
  EXPECT_NE(o.out.find("3 parts with "), std::string::npos) << o.out;
  EXPECT_EQ(o.out.find("of no use"), std::string::npos) << o.out;
  EXPECT_EQ(run_program({"verify", out}).code, 0);
  // Nothing that a part had done was done again, but for the searches that are compared.
  for (const std::string& line : lines_of(fs::path(out) / "parts" / "gathered" / "searches-1.log"))
    EXPECT_TRUE(line.find("%20start") == std::string::npos || line.starts_with("S 'limits%20after:"))
        << line.substr(0, 60);
  const Outcome again = run_program({"gather", out});
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.out.find("complete already"), std::string::npos) << again.out;
}

INSTANTIATE_TEST_SUITE_P(Parts, DividedRun, ::testing::ValuesIn(divided),
                         [](const auto& info) { return info.param.name; });

/// More parts than there is to do, and kills at any moment.
TEST(Parts, KilledPartsAreNamedAndGoOn)
{
  const WorkFolder folder;
  const std::string file = folder.write("e.json", fan_text()), out = folder / "out";
  ASSERT_EQ(run_program({"run", file, "-o", folder / "whole", "--quiet"}).code, 0);
  const Outcome none = run_program({"gather", out});
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("holds no parts of a run"), std::string::npos) << none.err;
  for (int k = 1; k <= 4; ++k) {
    Process process({"run", file, "--part", part(k, 4), "-o", out, "--quiet"}, folder);
    std::this_thread::sleep_for(std::chrono::milliseconds(60 * k));
    process.signal(k % 2 == 0 ? SIGKILL : SIGTERM);
    const Outcome o = process.wait();
    EXPECT_TRUE(o.code == 0 || o.code == 130 || o.code == 1000 + SIGKILL || o.code == 1000 + SIGTERM)
        << o.code;
  }
  fs::remove_all(fs::path(out) / "parts" / "2-of-4");
  const Outcome missing = run_program({"gather", out, "--missing"});
  EXPECT_EQ(missing.code, 0);
  EXPECT_NE(missing.out, "");
  const Outcome incomplete = run_program({"gather", out});
  EXPECT_EQ(incomplete.code, 1);
  EXPECT_NE(incomplete.err.find("of 4 parts missing: "), std::string::npos) << incomplete.err;
  EXPECT_FALSE(fs::exists(fs::path(out) / "results.json"));
  for (int k = 1; k <= 4; ++k) EXPECT_EQ(run_part(file, out, k, 4).code, 0);
  EXPECT_EQ(run_program({"gather", out, "--missing"}).out, "");
  // A gathering that is stopped goes on, too.
  Process stopped({"gather", out, "--quiet"}, folder);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  stopped.signal(SIGTERM);
  stopped.wait();
  const Outcome o = run_program({"gather", out});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(results_in(out), results_in(folder / "whole"));
}

class OnePart : public ::testing::Test {
 protected:
  void SetUp() override
  {
    file_ = folder_.write("e.json", chain_text());
    out_ = folder_ / "out";
    ASSERT_EQ(run_part(file_, out_, 1, 1).code, 0);
  }

  fs::path log() const { return fs::path(out_) / "parts" / "1-of-1" / "searches-1.log"; }

  WorkFolder folder_;
  std::string file_, out_;
};

/// A number that is wrong though its checksum is right: it is found by doing the search once more.
TEST_F(OnePart, WrongNumbersAreNotGathered)
{
  change(log(), "S 'limit%200%20start%200", " 0.", " 0.1");
  const Outcome o = run_program({"gather", out_});
  EXPECT_EQ(o.code, 1) << o.out;
  EXPECT_NE(o.err.find("'limit 0 start 0' of "), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("searches-1.log"), std::string::npos) << o.err;
  EXPECT_FALSE(fs::exists(fs::path(out_) / "results.json"));
}

TEST_F(OnePart, ProcessorsOfSeveralKindsAreNamed)
{
  const std::vector<std::string> lines = lines_of(log());
  const std::string head(undamaged_record(lines.front()).value());
  std::istringstream words(head);
  std::string word;
  for (int k = 0; k < 5; ++k) words >> word;  // H, format, identity, part, processor
  change(log(), "H ", word, "'Abacus");
  change(log(), "S 'limit%200%20start%200", " 0.", " 0.1");
  const Outcome o = run_program({"gather", out_});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("processors of several kinds round differently"), std::string::npos) << o.err;
  const json::value results = read_results(out_);
  EXPECT_EQ(results.at_pointer("/provenance/processors/0").as_string(), "Abacus");
  EXPECT_EQ(results.at_pointer("/provenance/processors").as_array().size(), 2U);
  EXPECT_EQ(run_program({"verify", out_}).code, 0);
}

TEST_F(OnePart, DamagedLogsAreComputedAgain)
{
  std::vector<std::string> lines = lines_of(log());
  lines[1][30] = lines[1][30] == '1' ? '2' : '1';
  write_lines(log(), lines);
  const Outcome missing = run_program({"gather", out_});
  EXPECT_EQ(missing.code, 1);
  EXPECT_NE(missing.err.find("line 2 is damaged"), std::string::npos) << missing.err;
  ASSERT_EQ(run_part(file_, out_, 1, 1).code, 0);
  EXPECT_EQ(run_program({"gather", out_}).code, 0);
  ASSERT_EQ(run_program({"run", file_, "-o", folder_ / "whole"}).code, 0);
  EXPECT_EQ(results_in(out_), results_in(folder_ / "whole"));
}

TEST_F(OnePart, OtherRunsAreRefused)
{
  const auto refused = [](const Outcome& o, const char* why) {
    EXPECT_EQ(o.code, 2) << o.out << o.err;
    EXPECT_NE(o.err.find(why), std::string::npos) << o.err;
  };
  refused(run_part(file_, out_, 1, 2), "is divided into 1 parts, not 2");
  const char* other_run = "the parts there are of another experiment";
  refused(run_program({"run", file_, "--part", "1/1", "-o", out_, "--set", "/solver/clearance=0.1"}),
          other_run);
  EXPECT_FALSE(fs::exists(fs::path(out_) / "parts" / "1-of-2")) << "nothing is written";
  // The same text at another place is the same experiment.
  const std::string copy = folder_.write("copy.json", chain_text());
  EXPECT_EQ(run_part(copy, out_, 1, 1).code, 0);
  folder_.write("e.json", with(chain_text(), "\"preset\": \"accurate\"", "\"tolerance\": 1e-3"));
  refused(run_part(file_, out_, 1, 1), other_run);
  refused(run_program({"gather", out_}), "was computed from another experiment");
  EXPECT_EQ(run_program({"gather", out_, "--experiment", copy}).code, 0);
}

/// Another build of one version is another program.
TEST_F(OnePart, OfAnotherBuildAreRefused)
{
  const fs::path prefix = fs::path(HAUBERK_PROGRAM).parent_path().parent_path();
  fs::create_directories(folder_.path() / "other/bin");
  fs::create_directory_symlink(prefix / "lib", folder_.path() / "other/lib");
  fs::copy(HAUBERK_PROGRAM, folder_.path() / "other/bin");
  // One word of a message is another one.
  std::string program = read_text(HAUBERK_PROGRAM);
  const std::string word = "join the parts of a divided run";
  program.replace(program.find(word), 4, "JOIN");
  std::ofstream(folder_.path() / "other/bin/hauberk", std::ios::binary) << program;
  const std::string command = fmt::format("'{}' gather '{}' 2> '{}' > /dev/null",
                                          folder_ / "other/bin/hauberk", out_, folder_ / "err");
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
  EXPECT_NE(read_text(folder_.path() / "err").find("by another build of the program"), std::string::npos)
      << read_text(folder_.path() / "err");
}

/// The folder of a gathering that died on another node.
TEST_F(OnePart, GatheringTakesOver)
{
  folder_.write("out/.hauberk-lock", "node17 4711 abc def\n");
  const Outcome refused = run_program({"gather", out_});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--take-over node17:4711"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(fs::path(out_) / "parts" / "gathered")) << "nothing is written";
  EXPECT_EQ(run_program({"gather", out_, "--take-over", "node17:4711"}).code, 0);
}

/// Indices of contacts, of which there are no such: the search is done again.
TEST(Parts, HostileLogsAreComputedAgain)
{
  const WorkFolder folder;
  const std::string file = folder.write(
      "e.json", with(chain_text(), R"("preset": "accurate")", R"("contact": "constrained", "starts": 3)"));
  const std::string out = folder / "out";
  ASSERT_EQ(run_part(file, out, 1, 1).code, 0);
  const fs::path log = fs::path(out) / "parts" / "1-of-1" / "searches-1.log";
  std::vector<std::string> lines = lines_of(log);
  std::size_t changed = 0;
  for (std::string& line : lines) {
    const auto record = undamaged_record(line);
    // The first contact after how many there are: element bodies 0 and 1 of an image.
    const std::size_t at = record ? record->rfind(" 1 0 0 0 0 ") : std::string_view::npos;
    const std::size_t other = record ? record->rfind(" 0 1 0 0 0 ") : std::string_view::npos;
    const std::size_t place = at != std::string_view::npos ? at : other;
    if (place == std::string_view::npos || line.find("start%200") != std::string::npos) continue;
    line = with_checksum(std::string(record->substr(0, place)) + " 1000000 1000000 0 0 0 " +
                         std::string(record->substr(place + 11)));
    ++changed;
  }
  ASSERT_GE(changed, 1U);
  write_lines(log, lines);
  const Outcome o = run_program({"gather", out});
  EXPECT_EQ(o.code, 0) << o.err;
  ASSERT_EQ(run_program({"run", file, "-o", folder / "whole"}).code, 0);
  EXPECT_EQ(results_in(out), results_in(folder / "whole"));
}

class DesignParts : public ::testing::Test {
 protected:
  void SetUp() override
  {
    file_ = folder_.write("e.json", starts_text());
    out_ = folder_ / "out";
    log_ = fs::path(out_) / "parts" / "1-of-1" / "start-1-1.log";
  }

  WorkFolder folder_;
  std::string file_, out_;
  fs::path log_;
};

TEST_F(DesignParts, AreInterruptedAndGoOn)
{
  const std::string file =
      folder_.write("long.json", with(starts_text(), R"("starts": 3)", R"("starts": 100000)"));
  Process process({"run", file, "--part", "1/1", "-o", out_, "--quiet"}, folder_);
  for (int k = 0; k < 6000 && !fs::exists(log_); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  process.signal(SIGINT);
  const Outcome o = process.wait();
  EXPECT_EQ(o.code, 130) << o.out << o.err;
  EXPECT_NE(o.out.find("interrupted; the same command goes on"), std::string::npos) << o.out;
}

TEST_F(DesignParts, WrongEvaluationsAreNotGathered)
{
  ASSERT_EQ(run_part(file_, out_, 1, 1).code, 0);
  std::vector<std::string> lines = lines_of(log_);
  const std::string record(undamaged_record(lines[1]).value());
  const std::size_t at = record.rfind(" 0.");
  ASSERT_NE(at, std::string::npos);
  lines[1] = with_checksum(record.substr(0, at) + " 0.5" + record.substr(at + 3));
  write_lines(log_, lines);
  const Outcome o = run_program({"gather", out_});
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("start-1-1.log: its first evaluation is not what it is here"), std::string::npos)
      << o.err;
  EXPECT_FALSE(fs::exists(fs::path(out_) / "results.json"));
  // The advice leads out.
  fs::remove_all(log_.parent_path());
  ASSERT_EQ(run_part(file_, out_, 1, 1).code, 0);
  EXPECT_EQ(run_program({"gather", out_}).code, 0);
}

TEST_F(DesignParts, OfTwoProcessesHaveTwoLogs)
{
  const WorkFolder other;
  Process twin({"run", file_, "--part", "1/1", "-o", out_, "--quiet"}, other);
  EXPECT_EQ(run_part(file_, out_, 1, 1).code, 0);
  EXPECT_EQ(twin.wait().code, 0);
  // One that began when the other was done has found that out.
  const fs::path folder = log_.parent_path();
  const bool both = fs::exists(folder / "searches-2.log");
  EXPECT_EQ(fs::exists(folder / "start-1-2.log"), both);
  // A kill has left one without a first line.
  std::ofstream(folder / "start-1-9.log").flush();
  ASSERT_TRUE(fs::exists(folder / "start-1-9.log"));
  if (both) {
    EXPECT_EQ(lines_of(folder / "start-1-1.log"), lines_of(folder / "start-1-2.log"));
  }
  EXPECT_EQ(run_program({"gather", out_}).code, 0);
}

TEST(Parts, WhatCannotBeDivided)
{
  const WorkFolder folder;
  const std::string chart = folder.write("c.json", chart_text()),
                    chain = folder.write("e.json", chain_text());
  const auto refused = [&](const std::vector<std::string>& words, const char* why) {
    const Outcome o = run_program(words);
    EXPECT_EQ(o.code, 2) << o.out << o.err;
    EXPECT_NE(o.err.find(why), std::string::npos) << o.err;
    EXPECT_FALSE(fs::exists(folder.path() / "out")) << why;
  };
  const std::string out = folder / "out";
  refused({"run", chart, "--part", "1/2", "-o", out},
          "the task 'chart' cannot be divided: it measures times");
  refused({"submit", chart, "--engine", "slurm", "--array", "2", "-o", out}, "cannot be divided");
  for (const char* bad : {"0/2", "3/2", "2", "a/b", "1/0", "1/99999"})
    refused({"run", chain, "--part", bad, "-o", out}, "expected K/N");
  for (const char* option : {"--force", "--resume"})
    refused({"run", chain, "--part", "1/2", option, "-o", out}, "not of a part");
  refused({"submit", chain, "--engine", "slurm", "-o", out}, "either --array N or --steps N");
  refused({"submit", chain, "--engine", "pbs", "--array", "2", "-o", out}, "slurm");
  refused({"submit", chain, "--engine", "slurm", "--array", "0", "-o", out}, "from 1 to");
  refused({"submit", chain, "--engine", "slurm", "--array", "2", "--sbatch", "time=1", "-o", out},
          "expected an option of sbatch");
  refused({"submit", chain, "--engine", "slurm", "--array", "2", "-o", folder / "a%b"}, "'%' in it");
}

/// A scheduler in a script: `sbatch` runs what it is given at once, in the order of the array, and kills the
/// jobs whose numbers the file `kill` lists, once each, and those of the file `always`; `srun` runs as many
/// tasks as the job has.
class Scheduler : public ::testing::Test {
 protected:
  void SetUp() override
  {
    fs::create_directory(folder_.path() / "bin");
    script("sbatch", R"(array= name= id=$(($(cat "$STATE/id" 2>/dev/null || echo 0) + 1))
echo "$id" > "$STATE/id"
echo "$*" >> "$STATE/calls"
while [ $# -gt 0 ]; do
  case "$1" in
    --parsable) ;;
    --array=*) array=${1#--array=} ;;
    --dependency=afterany:*) ;;
    *) break ;;
  esac
  shift
done
tasks=$(grep -o -- '--ntasks=[0-9]*' "$1" | cut -d= -f2)
export STATE_TASKS="$tasks"
run() { PATH="$PATH" /bin/sh "$@" >> "$STATE/out" 2>&1; }
if [ -n "$array" ]; then
  for range in $(echo "$array" | tr , ' '); do
    for k in $(seq "${range%-*}" "${range#*-}"); do
      if grep -qx "$k" "$STATE/always" 2>/dev/null; then continue; fi
      if grep -qx "$k" "$STATE/kill" 2>/dev/null; then sed -i "/^$k\$/d" "$STATE/kill"; continue; fi
      SLURM_ARRAY_TASK_ID=$k run "$@"
    done
  done
else
  run "$@"
fi
echo "$id;cluster")");
    script("srun", R"([ "$1" = --kill-on-bad-exit=0 ] && shift
for rank in $(seq 0 $((STATE_TASKS - 1))); do
  k=$((rank + 1))
  if grep -qx "$k" "$STATE/kill" 2>/dev/null; then sed -i "/^$k\$/d" "$STATE/kill"; continue; fi
  SLURM_PROCID=$rank "$@"
done)");
    path_ = std::getenv("PATH");
    ::setenv("PATH", (folder_ / "bin" + ":" + path_).c_str(), 1);
    ::setenv("STATE", folder_.path().c_str(), 1);
    file_ = folder_.write("it's e.json", chain_text());
    out_ = folder_ / "o'ut";
    ASSERT_EQ(run_program({"run", file_, "-o", folder_ / "whole", "--set", "/solver/starts=3"}).code, 0);
  }
  void TearDown() override
  {
    ::setenv("PATH", path_.c_str(), 1);
    ::unsetenv("STATE");
  }

  void script(const std::string& name, const std::string& text) const
  {
    const std::string file = folder_.write("bin/" + name, "#!/bin/sh\n" + text + "\n");
    fs::permissions(file, fs::perms::owner_all);
  }
  Outcome submit(const std::string& how, const std::string& more = "--quiet") const
  {
    std::vector<std::string> words{"submit",
                                   file_,
                                   "--engine",
                                   "slurm",
                                   how,
                                   "5",
                                   "-o",
                                   out_,
                                   "--set",
                                   "/solver/starts=3",
                                   "--sbatch=--time=10"};
    if (more == "--dry-run") words.push_back(more);
    return run_program(words);
  }
  std::string said() const { return read_text(folder_.path() / "out"); }

  WorkFolder folder_;
  std::string path_, file_, out_;
};

TEST_F(Scheduler, MissingPartsAreSubmittedAgainAndGathered)
{
  folder_.write("kill", "2\n3\n5\n");
  const Outcome o = submit("--array");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("job 1: 5 parts\n"), std::string::npos) << o.out;
  EXPECT_NE(read_text(folder_.path() / "calls").find("--array=2-3,5 "), std::string::npos)
      << read_text(folder_.path() / "calls");
  EXPECT_EQ(results_in(out_), results_in(folder_ / "whole")) << said();
  EXPECT_NE(read_text(fs::path(out_) / "parts" / "array.sh").find("#SBATCH --time=10\n"), std::string::npos);
}

TEST_F(Scheduler, AtMostAStatedNumberOfTimes)
{
  folder_.write("always", "4\n");
  ASSERT_EQ(submit("--array").code, 0);
  EXPECT_FALSE(fs::exists(fs::path(out_) / "results.json"));
  EXPECT_NE(said().find("1 of 5 parts missing: 4"), std::string::npos) << said();
  const std::string calls = read_text(folder_.path() / "calls");
  std::size_t again = 0;
  for (std::size_t at = 0; (at = calls.find("--array=4 ", at)) != std::string::npos; ++at) ++again;
  EXPECT_EQ(again, 2U) << calls;
}

TEST_F(Scheduler, StepsOfOneJob)
{
  folder_.write("kill", "2\n");
  const Outcome o = submit("--steps");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(results_in(out_), results_in(folder_ / "whole")) << said();
}

TEST_F(Scheduler, DryRunsSubmitNothing)
{
  const Outcome o = submit("--array", "--dry-run");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_FALSE(fs::exists(folder_.path() / "calls"));
  EXPECT_NE(o.out.find("sbatch --parsable --array=1-5 "), std::string::npos) << o.out;
}

TEST_F(Scheduler, ThatRefusesIsTold)
{
  script("sbatch", "echo 'sbatch: error: invalid account' >&2; exit 1");
  const Outcome o = submit("--array");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("invalid account"), std::string::npos);
  EXPECT_NE(o.err.find("what is left to submit is: sbatch --parsable --array=1-5 "), std::string::npos)
      << o.err;
}

/// The array is queued, the job that gathers is not: only that is left.
TEST_F(Scheduler, ThatTakesHalfIsTold)
{
  script("sbatch", R"(case "$*" in *dependency*) exit 1;; esac; echo 7)");
  const Outcome o = submit("--array");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.out.find("job 7: 5 parts"), std::string::npos) << o.out;
  EXPECT_NE(o.err.find("what is left to submit is: sbatch --parsable --dependency=afterany:7 "),
            std::string::npos)
      << o.err;
}

}  // namespace
}  // namespace hauberk::test
