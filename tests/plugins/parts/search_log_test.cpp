/// Logs of searches: what is recalled, compared and refused.

#include "parts/search_log.hpp"
#include "parts/locked_record.hpp"
#include "temporary_folder.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;

Locked outcome(double value)
{
  Locked l;
  l.status = LockStatus::locked;
  l.state.macro = Vector::Constant(1, value);
  return l;
}

std::string read(const fs::path& file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class SearchLog : public ::testing::Test {
 protected:
  SearchLogs logs(const std::string& identity = "that")
  {
    return {identity, [this](const std::string& warning) { warnings_ += warning + "\n"; }};
  }
  /// A log of searches "s0", "s1", ... with these values.
  fs::path written(const std::vector<double>& values, const std::string& processor = "P",
                   bool complete = true)
  {
    SearchLogs out = logs();
    out.write_to(folder_, "searches", {"", "1-of-1", processor, "host:1"});
    for (std::size_t k = 0; k < values.size(); ++k)
      out.record("s" + std::to_string(k), outcome(values[k]), 0.5);
    EXPECT_EQ(complete && out.complete(), complete);
    return folder_ / ("searches-" + std::to_string(++written_) + ".log");
  }

  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
  std::string warnings_;
  int written_ = 0;
};

TEST_F(SearchLog, RecallsWhatWasRecorded)
{
  const fs::path file = written({0.25, -0.0});
  SearchLogs in = logs();
  const auto contents = in.read(file);
  ASSERT_TRUE(contents);
  EXPECT_TRUE(contents->complete);
  EXPECT_EQ(contents->searches, 2U);
  EXPECT_EQ(contents->origin.processor, "P");
  EXPECT_EQ(contents->origin.part, "1-of-1");
  const auto known = in.recall("s0");
  ASSERT_TRUE(known);
  EXPECT_EQ(known->locked.state.macro[0], 0.25);
  EXPECT_EQ(known->seconds, 0.5);
  EXPECT_TRUE(std::signbit(in.recall("s1")->locked.state.macro[0]));
  EXPECT_FALSE(in.recall("s2"));
  EXPECT_EQ(warnings_, "");
}

TEST_F(SearchLog, TellsOnceOfSearchesThatAreDoneAgain)
{
  const fs::path file = written({0.25, 0.5, 0.75});
  SearchLogs in = logs();
  ASSERT_TRUE(in.read(file));
  EXPECT_TRUE(in.recall("s0"));
  const std::string blanks(fs::file_size(file), ' ');
  std::ofstream(file, std::ios::binary) << blanks;
  for (const char* name : {"s1", "s2"}) {
    EXPECT_FALSE(in.recall(name));
    in.record(name, outcome(0.5), 0.1);
  }
  in.record("s3", outcome(1.0), 0.1);  // one that no log has
  EXPECT_EQ(in.done_again(), 2U);
  EXPECT_EQ(warnings_,
            "warning: " + file.string() +
                ": what it has of the search 's1' is of no use; this one and the like are done again\n");
}

TEST_F(SearchLog, TwoRunsNeverShareAFile)
{
  SearchLogs a = logs(), b = logs();
  a.write_to(folder_, "searches", {"", "1-of-1", "P", "a:1"});
  b.write_to(folder_, "searches", {"", "1-of-1", "P", "b:1"});
  a.record("s", outcome(1.0), 0.1);
  b.record("s", outcome(1.0), 0.2);
  SearchLogs in = logs();
  EXPECT_EQ(in.read(folder_ / "searches-1.log")->origin.run, "a:1");
  EXPECT_EQ(in.read(folder_ / "searches-2.log")->origin.run, "b:1");
  EXPECT_TRUE(in.conflicts().empty()) << "times may differ";
  EXPECT_EQ(in.known(), 1U);
}

TEST_F(SearchLog, OutcomesThatDifferAreConflicts)
{
  SearchLogs in = logs();
  in.read(written({1.0, 2.0}));
  in.read(written({1.0, std::nextafter(2.0, 3.0)}));
  in.read(written({std::nextafter(1.0, 2.0), 2.0}, "Q"));
  const auto conflicts = in.conflicts();
  ASSERT_EQ(conflicts.size(), 2U);
  EXPECT_EQ(conflicts[0].search, "s1");
  EXPECT_TRUE(conflicts[0].one_processor);
  EXPECT_NE(conflicts[0].file.find("searches-1.log"), std::string::npos);
  EXPECT_NE(conflicts[0].other.find("searches-2.log"), std::string::npos);
  EXPECT_EQ(conflicts[1].search, "s0");
  EXPECT_FALSE(conflicts[1].one_processor);
}

/// Every two of one kind of processor are compared, also where the first is of another.
TEST_F(SearchLog, OutcomesOfOneKindAreCompared)
{
  SearchLogs in = logs();
  in.read(written({1.0}, "P"));
  in.read(written({1.1}, "Q"));
  in.read(written({1.2}, "Q"));
  const auto conflicts = in.conflicts();
  ASSERT_EQ(conflicts.size(), 3U);
  EXPECT_EQ(std::count_if(conflicts.begin(), conflicts.end(), [](const auto& c) { return c.one_processor; }),
            1);
  in.read(written({1.0}, "Q"));  // as the first, and unlike both of its kind
  EXPECT_EQ(in.conflicts().size(), 5U);
}

/// One search of each log is done once more, and only that.
TEST_F(SearchLog, ChecksOneOfEach)
{
  for (const double found : {1.0, 1.5}) {
    SearchLogs in = logs();
    in.read(written({1.0, 2.0}));
    in.check_one_of_each();
    EXPECT_FALSE(in.recall("s0"));
    EXPECT_FALSE(in.recall("s0")) << "not done yet";
    EXPECT_TRUE(in.recall("s1"));
    EXPECT_EQ(in.checked().first, 0U) << "a search that is never done is not compared";
    in.record("s0", outcome(found), 9.0);
    EXPECT_EQ(in.checked(), (std::pair<std::size_t, std::size_t>(1, 1)));
    EXPECT_EQ(in.conflicts().size(), found == 1.0 ? 0U : 1U);
  }
}

/// Wherever a kill cuts it off, what is before it is believed.
TEST_F(SearchLog, CutLogs)
{
  const fs::path file = written({1.0, 2.0, 3.0});
  const std::string text = read(file);
  std::size_t first = text.find('\n') + 1;
  for (std::size_t n = 0; n < text.size(); ++n) {
    std::ofstream(file, std::ios::binary) << text.substr(0, n);
    SearchLogs in = logs();
    const auto contents = in.read(file);
    ASSERT_EQ(contents.has_value(), n >= first) << n;
    if (!contents) continue;
    const auto whole =
        static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<long>(n), '\n')) - 1;
    EXPECT_EQ(contents->searches, std::min<std::size_t>(3, whole)) << n;
    EXPECT_FALSE(contents->complete);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(in.recall("s" + std::to_string(k)).has_value(), k < whole) << n;
  }
}

TEST_F(SearchLog, DamageEndsWhatIsBelieved)
{
  const fs::path file = written({1.0, 2.0, 3.0});
  std::string text = read(file);
  const std::size_t second = text.find("'s1");
  text[second + 20] = text[second + 20] == '7' ? '8' : '7';
  std::ofstream(file, std::ios::binary) << text;
  SearchLogs in = logs();
  const auto contents = in.read(file);
  ASSERT_TRUE(contents);
  EXPECT_EQ(contents->searches, 1U);
  EXPECT_FALSE(contents->complete);
  EXPECT_NE(warnings_.find("searches-1.log: line 3 is damaged"), std::string::npos) << warnings_;
}

TEST_F(SearchLog, ChangedWhileInUse)
{
  const fs::path file = written({1.0});
  SearchLogs in = logs();
  in.read(file);
  fs::resize_file(file, 0);
  EXPECT_FALSE(in.recall("s0")) << "it is computed again";
}

TEST_F(SearchLog, OtherFilesAreRefusedOrNotBelieved)
{
  const fs::path file = written({1.0});
  SearchLogs other = logs("this");
  EXPECT_THROW(other.read(file), InputError);
  SearchLogs in = logs();
  std::ofstream(folder_ / "text.log") << "text\n";
  EXPECT_FALSE(in.read(folder_ / "text.log"));
  fs::create_symlink(file, folder_ / "link.log");
  EXPECT_FALSE(in.read(folder_ / "link.log"));
  EXPECT_FALSE(in.read("/dev/zero"));
  EXPECT_FALSE(in.read(folder_));
  EXPECT_EQ(in.known(), 0U);
  EXPECT_EQ(std::count(warnings_.begin(), warnings_.end(), '\n'), 4);
}

/// What holds second derivatives of contacts is not kept, and computed again.
TEST_F(SearchLog, WhatCannotBeKeptIsNot)
{
  Locked l = outcome(1.0);
  l.pressed.emplace();
  EXPECT_TRUE(is_recordable(l));
  l.pressed->hessian = Matrix::Identity(2, 2);
  EXPECT_FALSE(is_recordable(l));
  SearchLogs out = logs();
  out.write_to(folder_, "searches", {"", "1-of-1", "P", "a:1"});
  out.record("s", l, 0.1);
  ASSERT_TRUE(out.complete());
  SearchLogs in = logs();
  const auto contents = in.read(folder_ / "searches-1.log");
  ASSERT_TRUE(contents);
  EXPECT_EQ(contents->searches, 0U);
}

}  // namespace
}  // namespace hauberk::test
