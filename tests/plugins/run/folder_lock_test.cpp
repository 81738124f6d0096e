/// Who may write into an output folder.

#include "run/folder_lock.hpp"
#include "temporary_folder.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>
#include <atomic>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>
#include <vector>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;

class FolderLocks : public testing::Test {
 protected:
  std::string text() const
  {
    std::ifstream in(folder_ / lock_file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::vector<std::string> words() const
  {
    std::istringstream in(text());
    return {std::istream_iterator<std::string>(in), {}};
  }
  void leave(const std::vector<std::string>& words) const
  {
    std::ofstream(folder_ / lock_file) << fmt::format("{}\n", fmt::join(words, " "));
  }
  void expect_refused(const std::string& take_over, const std::string& message) const
  {
    const std::string before = text();
    try {
      const FolderLock lock(folder_, take_over);
      ADD_FAILURE() << "not refused";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(message), std::string::npos) << e.what();
    }
    EXPECT_EQ(text(), before);
  }
  /// The words of a lock of this run.
  std::vector<std::string> own() const
  {
    const FolderLock lock(folder_, "");
    return words();
  }

  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

TEST_F(FolderLocks, AreHeldByOneRunAndGivenBack)
{
  {
    const FolderLock lock(folder_, "");
    ASSERT_EQ(words().size(), 4U);
    const std::string name = fmt::format("{}:{}", words()[0], ::getpid());
    expect_refused("", "the run " + name + " writes into this folder; wait for it");
    expect_refused("elsewhere:1", "the run " + name);
    expect_refused(name, "the run " + name);  // it is going on
  }
  EXPECT_FALSE(fs::exists(folder_ / lock_file));
}

TEST_F(FolderLocks, OfAProcessThatIsGoneIsTakenOver)
{
  // A child that ends without giving it back, and stays a zombie.
  const pid_t child = ::fork();
  if (child == 0) {
    static_cast<void>(new FolderLock(folder_, ""));
    ::_exit(0);
  }
  siginfo_t ended{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT), 0);
  ASSERT_EQ(words().at(1), std::to_string(child));
  {
    const FolderLock lock(folder_, "");
    EXPECT_EQ(words().at(1), std::to_string(::getpid()));
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  // Killed before it had written; and before the machine was started again.
  leave({});
  EXPECT_EQ(own().size(), 4U);
  std::vector<std::string> before = own();
  if (before[2] == "-") GTEST_SKIP() << "this machine has no id";
  before[3] += "0";
  leave(before);
  EXPECT_EQ(own().size(), 4U);
}

TEST_F(FolderLocks, OfAnotherMachineIsNeverTakenToBeGone)
{
  const std::vector<std::string> here = own();
  // Another name, and the same name of which nothing else is the same, as containers may have it.
  std::vector<std::string> elsewhere = here, namesake = here;
  elsewhere[0] = "elsewhere", elsewhere[1] = "999999999", elsewhere[2] += "0", elsewhere[3] += "0";
  namesake[1] = "999999999", namesake[2] += "0", namesake[3] += "0";
  for (const std::vector<std::string>& other : {elsewhere, namesake}) {
    const std::string name = other[0] + ":999999999";
    leave(other);
    expect_refused("", "the run " + name + " writes into this folder");
    expect_refused("elsewhere:1", "--take-over " + name + " (not elsewhere:1)");
    const FolderLock lock(folder_, name);
    EXPECT_EQ(words(), here);
  }
  leave({"?"});  // what nobody has written
  expect_refused("", "writes into this folder");
}

TEST_F(FolderLocks, AreNotWrittenThroughLinks)
{
  std::ofstream(folder_ / "mine.txt") << "mine";
  fs::create_symlink(folder_ / "mine.txt", folder_ / lock_file);
  EXPECT_THROW(FolderLock(folder_, ""), InputError);
  std::ifstream in(folder_ / "mine.txt");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "mine");
  fs::remove(folder_ / lock_file);
  fs::create_directory(folder_ / lock_file);
  EXPECT_THROW(FolderLock(folder_, ""), InputError);
}

/// However many ask at once, and however often it is given back in between.
TEST_F(FolderLocks, AreNeverHeldTwice)
{
  std::atomic<int> holding = 0, most = 0, taken = 0;
  std::vector<std::jthread> runs;
  for (int k = 0; k < 4; ++k)
    runs.emplace_back([&] {
      for (int i = 0; i < 300; ++i) {
        try {
          const FolderLock lock(folder_, "");
          most = std::max(most.load(), ++holding);
          ++taken;
          std::this_thread::yield();
          --holding;
        } catch (const InputError&) {
          std::this_thread::yield();
        }
      }
    });
  runs.clear();
  EXPECT_EQ(most, 1);
  EXPECT_GT(taken, 4);
}

}  // namespace
}  // namespace hauberk::test
