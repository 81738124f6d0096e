/// What befalls a run from outside: its folder vanishes, the clock is set back, another machine wants its
/// folder.

#include "result_files.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;

void wait_for(const fs::path& file)
{
  for (int k = 0; k < 3000 && !fs::exists(file); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_TRUE(fs::exists(file));
}

/// The results are rescued, whole, and the run says where.
TEST(Faults, TheFolderVanishes)
{
  const WorkFolder folder;
  const std::string file = folder.write("m.json", chainmail_text()), out = folder / "out";
  ASSERT_EQ(run_program({"run", file, "-o", folder / "whole"}).code, 0);
  ::setenv("TMPDIR", folder.path().c_str(), 1);
  Process process({"run", file, "-o", out, "--quiet"}, folder);
  wait_for(out + "/.hauberk-lock");
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  fs::remove_all(out);
  const Outcome o = process.wait();
  ::unsetenv("TMPDIR");
  EXPECT_EQ(o.code, 1) << o.err;
  const std::string said = "the results are in ";
  const std::size_t at = o.err.find(said);
  ASSERT_NE(at, std::string::npos) << o.err;
  const std::size_t begin = at + said.size();
  const fs::path rescued = o.err.substr(begin, o.err.find(':', begin) - begin);
  EXPECT_EQ(results_in(rescued), results_in(folder / "whole"));
}

/// The results are rescued likewise, and what the folder holds stays as it is. Nobody is refused a folder
/// when the superuser runs the tests, who is refused none.
TEST(Faults, TheFolderBecomesReadOnly)
{
  const WorkFolder folder;
  const std::string file = folder.write("m.json", chainmail_text()), out = folder / "out";
  fs::permissions(file, fs::perms::others_read, fs::perm_options::add);
  const std::string spare = folder / "spare";
  std::string run_as_nobody;
  if (::geteuid() == 0) {
    if (std::system("setpriv --reuid=65534 --regid=65534 --clear-groups true 2> /dev/null") != 0)
      GTEST_SKIP() << "no setpriv here";
    run_as_nobody = "setpriv --reuid=65534 --regid=65534 --clear-groups ";
  }
  ASSERT_EQ(run_program({"run", file, "-o", folder / "whole"}).code, 0);
  for (const std::string& one : {out, spare}) {
    fs::create_directory(one);
    fs::permissions(one, fs::perms::all);
  }
  fs::permissions(folder.path(), fs::perms::others_read | fs::perms::others_exec, fs::perm_options::add);
  const std::string command = fmt::format("TMPDIR='{}' {}'{}' run '{}' -o '{}' --quiet > /dev/null 2> '{}'",
                                          spare, run_as_nobody, HAUBERK_PROGRAM, file, out, folder / "err");
  int code = -1;
  std::thread run([&] { code = WEXITSTATUS(std::system(command.c_str())); });
  wait_for(out + "/.hauberk-lock");
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // it tries the folder, and begins to compute
  fs::permissions(out, fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write,
                  fs::perm_options::remove);
  const Contents then = contents(out);
  run.join();
  const std::string error = read_text(folder / "err");
  EXPECT_EQ(code, 1) << error;
  const std::string said = "the results are in ";
  const std::size_t at = error.find(said);
  ASSERT_NE(at, std::string::npos) << error;
  const std::size_t begin = at + said.size();
  const fs::path rescued = error.substr(begin, error.find(':', begin) - begin);
  EXPECT_EQ(rescued.parent_path(), spare) << error;
  EXPECT_EQ(results_in(rescued), results_in(folder / "whole"));
  EXPECT_EQ(without_temporaries(contents(out)), without_temporaries(then));
  fs::permissions(out, fs::perms::all);  // so that it can be removed
}

#ifdef HAUBERK_CLOCK_BACK
/// Nothing depends on the wall clock: a run that is killed and resumed under one that goes back ends the
/// same.
TEST(Faults, TheClockIsSetBack)
{
  const WorkFolder folder;
  for (const TaskCase& task : task_cases()) {
    if (std::string(task.name) == "chart") continue;  // its results are times
    const std::string file = folder.write("e.json", task.text());
    const std::string whole = folder / (std::string("whole_") + task.name);
    const std::string out = folder / (std::string("out_") + task.name);
    ASSERT_EQ(run_program({"run", file, "-o", whole}).code, 0);
    ::setenv("LD_PRELOAD", HAUBERK_CLOCK_BACK, 1);
    Process process({"run", file, "-o", out, "--quiet"}, folder);
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    process.signal(SIGKILL);
    process.wait();
    const Outcome o = run_program({"run", file, "-o", out, "--resume"});
    ::unsetenv("LD_PRELOAD");
    EXPECT_EQ(o.code, 0) << task.name << o.err;
    EXPECT_EQ(results_in(out), results_in(whole)) << task.name;
  }
}
#endif

/// Two machines on one folder: namespaces of their own for host names and processes.
TEST(Faults, TwoMachinesOnOneFolder)
{
  const WorkFolder folder;
  if (::geteuid() != 0 || std::system("unshare --uts --pid --fork true 2> /dev/null") != 0)
    GTEST_SKIP() << "no namespaces here";
  const std::string out = folder / "out", file = folder.write("e.json", endless_text());
  const auto on = [&](const char* host, const std::string& more, const char* log) {
    return fmt::format(
        "unshare --uts --pid --fork --kill-child sh -c \"hostname {}; exec '{}' run '{}' -o '{}' --quiet {}\" "
        "> /dev/null 2> '{}'",
        host, HAUBERK_PROGRAM, file, out, more, folder / log);
  };
  std::thread first([&] { std::system(on("first", "", "first.err").c_str()); });
  wait_for(out + "/.hauberk-lock");
  for (int k = 0; k < 3000 && read_text(out + "/.hauberk-lock").empty(); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  for (const char* more : {"", "--force", "--resume", "--take-over first:1"}) {
    EXPECT_EQ(WEXITSTATUS(std::system(on("second", more, "second.err").c_str())), 2) << more;
    EXPECT_NE(read_text(folder / "second.err").find("the run first:1 writes into this folder"),
              std::string::npos)
        << read_text(folder / "second.err");
  }
  EXPECT_EQ(std::system(fmt::format("pkill -KILL -f -- '[-]o {}'", out).c_str()), 0);
  first.join();
  // The lock went with the process; the second machine goes on.
  folder.write("e.json", chain_text());
  EXPECT_EQ(WEXITSTATUS(std::system(on("second", "--force", "second.err").c_str())), 0)
      << read_text(folder / "second.err");
  EXPECT_EQ(run_program({"verify", out}).code, 0);
}

}  // namespace
}  // namespace hauberk::test
