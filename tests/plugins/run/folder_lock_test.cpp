/// Who may write into an output folder.

#include "run/folder_lock.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>
#include <fstream>
#include <iterator>
#include <sstream>
#include <vector>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;

class FolderLocks : public testing::Test {
 protected:
  FolderLocks() { fs::create_directories(folder_); }
  ~FolderLocks() override { fs::remove_all(folder_); }

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

  fs::path folder_ = fs::path(testing::TempDir()) / fmt::format("hauberk_lock_{}", ::getpid());
};

TEST_F(FolderLocks, AreHeldByOneRunAndGivenBack)
{
  std::string name;
  {
    const FolderLock lock(folder_, "");
    ASSERT_EQ(words().size(), 5U);
    name = fmt::format("{}:{}", words()[0], ::getpid());
    expect_refused("", "the run " + name + " writes into this folder; wait for it");
    expect_refused("elsewhere:1", "--take-over " + name + " (not elsewhere:1)");
    const FolderLock other(folder_, name);  // by its name
  }
  EXPECT_FALSE(fs::exists(folder_ / lock_file));
}

TEST_F(FolderLocks, OfAProcessThatIsGoneIsTakenOver)
{
  // A child that ends without giving it back.
  const pid_t child = ::fork();
  if (child == 0) {
    static_cast<void>(new FolderLock(folder_, ""));
    ::_exit(0);
  }
  siginfo_t ended{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT), 0);  // it stays a zombie
  const std::vector<std::string> left = words();
  ASSERT_EQ(left.at(1), std::to_string(child));
  {
    const FolderLock lock(folder_, "");
  }
  EXPECT_FALSE(fs::exists(folder_ / lock_file));
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  leave(left);
  {
    const FolderLock lock(folder_, "");
  }
  EXPECT_FALSE(fs::exists(folder_ / lock_file));

  // A process of the same number that began at another time, and one before the machine was started.
  std::vector<std::string> own;
  {
    const FolderLock lock(folder_, "");
    own = words();
  }
  for (const std::size_t changed : {2U, 3U}) {
    std::vector<std::string> other = own;
    other[changed] += "0";
    leave(other);
    const FolderLock lock(folder_, "");
    EXPECT_EQ(words(), own);
  }
}

TEST_F(FolderLocks, OfAnotherMachineIsNeverTakenToBeGone)
{
  std::vector<std::string> own;
  {
    const FolderLock lock(folder_, "");
    own = words();
  }
  std::vector<std::string> other = own;
  other[0] = "elsewhere", other[1] = "999999999";
  leave(other);
  expect_refused("", "the run elsewhere:999999999 writes into this folder");
  expect_refused("elsewhere:1", "--take-over elsewhere:999999999");
  {
    const FolderLock lock(folder_, "elsewhere:999999999");
    EXPECT_EQ(words(), own);
  }
  // Nor that of a container whose processes cannot be seen from here.
  other = own;
  other[1] = "999999999", other[4] = "pid:[1]";
  leave(other);
  expect_refused("", own[0] + ":999999999");
  // What is no lock is not deleted.
  leave({"?"});
  expect_refused("", "writes into this folder");
}

TEST_F(FolderLocks, AreNotWrittenThroughLinks)
{
  std::ofstream(folder_ / "mine.txt") << "mine";
  fs::create_symlink(folder_ / "mine.txt", folder_ / lock_file);
  EXPECT_THROW(FolderLock(folder_, ""), InputError);
  std::ifstream in(folder_ / "mine.txt");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "mine");
}

}  // namespace
}  // namespace hauberk::test
