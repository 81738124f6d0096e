#include "support.hpp"

#include <hauberk/host/process_state.hpp>

#include <clocale>
#include <iostream>
#include <locale>
#include <sstream>

namespace hauberk::test {
namespace {

/// A decimal comma under a name that no system has to know.
class Comma : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
};

TEST(ProcessState, NothingChangedIsNothingSaid)
{
  const ProcessState before;
  std::cout << "";
  EXPECT_EQ(before.restore(), "");
}

TEST(ProcessState, EachPartIsNamedAndPutBack)
{
  const TemporaryFolder folder;
  const fs::path directory = fs::current_path();
  const ProcessState before;
  fs::current_path(folder.path());
  EXPECT_EQ(before.restore(), "current directory");
  EXPECT_EQ(fs::current_path(), directory);

  std::setlocale(LC_NUMERIC, "C.UTF-8");
  EXPECT_EQ(before.restore(), "locale");
  EXPECT_STREQ(std::setlocale(LC_ALL, nullptr), "C");
  const std::locale comma(std::locale::classic(), new Comma);
  std::locale::global(comma);
  EXPECT_EQ(before.restore(), "locale");
  EXPECT_EQ(std::locale(), std::locale::classic());

  std::ostringstream elsewhere;
  std::streambuf* const buffer = std::cout.rdbuf(elsewhere.rdbuf());
  EXPECT_EQ(before.restore(), "state of std::cout");
  EXPECT_EQ(std::cout.rdbuf(), buffer);
  std::cerr.precision(3);
  std::clog << std::hex;
  std::cin.exceptions(std::ios::badbit);
  EXPECT_EQ(before.restore(), "state of std::cin, state of std::cerr, state of std::clog");
  EXPECT_EQ(std::cerr.precision(), 6);
  EXPECT_EQ(std::clog.flags() & std::ios::basefield, std::ios::dec);
  EXPECT_EQ(std::cin.exceptions(), std::ios::goodbit);
  std::cout.imbue(comma);
  EXPECT_EQ(before.restore(), "state of std::cout");
  EXPECT_EQ(before.restore(), "");
}

TEST(ProcessState, ADirectoryThatIsGoneIsSaid)
{
  const fs::path directory = fs::current_path();
  {
    const TemporaryFolder folder;
    fs::current_path(folder.folder("here"));
    const ProcessState before;
    fs::current_path(directory);
    fs::remove(folder / "here");
    EXPECT_EQ(before.restore(), "current directory, which is gone");
  }
  EXPECT_EQ(fs::current_path(), directory);
}

}  // namespace
}  // namespace hauberk::test
