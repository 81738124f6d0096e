#include "tasks/variants/grid.hpp"

#include <gtest/gtest.h>
#include <boost/json/parse.hpp>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <stdexcept>

namespace hauberk {
namespace {

/// Row k has the answer k^2, but: 2 is no variant, 3 is refused when it is solved, 5 fails, 7 is stopped.
class Squares final : public GridRows {
 public:
  explicit Squares(std::size_t count) : answers(count), variants_(count)
  {
    for (std::size_t k = 0; k < count; ++k) variants_[k].experiment.emplace();
    variants_[2] = {std::nullopt, "no such variant"};
  }

  const VariantReading& variant(std::size_t row) const override { return variants_[row]; }

  EnterRow solve(std::size_t row, const Experiment& e) override
  {
    EXPECT_EQ(&e, &*variants_[row].experiment);
    if (row == 3) throw InputError("no room");
    if (row == 5) throw std::runtime_error("lost");
    if (row == 7) return {};
    return entry(row, std::to_string(row * row));
  }

  EnterRow refuse(std::size_t row, RowStatus status, const std::string& message) override
  {
    return entry(row, to_string(status) + ": " + message);
  }

  std::vector<std::string> answers;
  std::vector<std::size_t> order;  ///< in which rows were entered

 private:
  EnterRow entry(std::size_t row, const std::string& answer)
  {
    return [this, row, answer]() -> std::size_t {
      EXPECT_FALSE(entering_.exchange(true)) << "two rows at a time";
      answers[row] = answer;
      order.push_back(row);
      entering_ = false;
      return 1;
    };
  }

  std::vector<VariantReading> variants_;
  std::atomic<bool> entering_{false};
};

class GridEngine : public ::testing::TestWithParam<unsigned> {};

TEST_P(GridEngine, EveryRowIsSolvedOrSaysWhyNotAndIsSaved)
{
  Progress progress(Progress::Mode::quiet);
  int saved = 0;
  RunContext context{GetParam(), progress, {}, false, {}, [&saved] { ++saved; }, {}, {}};
  Squares rows(40);
  std::vector<std::size_t> order(40);
  std::iota(order.rbegin(), order.rend(), 0);
  Grid(context, "squares", order.size()).run(rows, order, context.threads);
  for (std::size_t k = 0; k < rows.answers.size(); ++k) {
    const std::string expected = k == 2   ? "refused: no such variant"
                                 : k == 3 ? "refused: no room"
                                 : k == 5 ? "failed: lost"
                                 : k == 7 ? ""
                                          : std::to_string(k * k);
    EXPECT_EQ(rows.answers[k], expected);
  }
  EXPECT_EQ(rows.order.size(), 39U);
  EXPECT_EQ(saved, 39);
  // One at a time they come in the order that was asked for.
  if (GetParam() == 1) {
    EXPECT_TRUE(std::is_sorted(rows.order.rbegin(), rows.order.rend()));
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, GridEngine, ::testing::Values(1U, 3U));

/// Its entries throw.
class Unwritable final : public GridRows {
 public:
  const VariantReading& variant(std::size_t) const override { return variant_; }
  EnterRow solve(std::size_t, const Experiment&) override
  {
    ++solved;
    return []() -> std::size_t { throw std::runtime_error("disk full"); };
  }
  EnterRow refuse(std::size_t, RowStatus, const std::string&) override { return {}; }

  std::atomic<int> solved = 0;

 private:
  VariantReading variant_{Experiment(), ""};
};

TEST(Grid, AnEntryThatThrowsEndsTheWalk)
{
  Progress progress(Progress::Mode::quiet);
  RunContext context{1, progress, {}, false, {}, [] {}, {}, {}};
  Unwritable rows;
  const std::vector<std::size_t> order(20);
  EXPECT_THROW(Grid(context, "rows", order.size()).run(rows, order, 1), std::runtime_error);
  EXPECT_EQ(rows.solved, 1);
}

TEST(TakeRows, AreTheSameInNumberAndOrder)
{
  const auto take = [](const boost::json::value& entry, int& row) {
    if (entry.as_int64() / 10 != row / 10) return false;
    row = static_cast<int>(entry.as_int64());
    return true;
  };
  const auto message = [&](const char* text) -> std::string {
    std::vector<int> rows{10, 20};
    try {
      take_rows(boost::json::parse(text).as_array(), rows, "rows", take);
      return std::to_string(rows[0] + rows[1]);
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message("[11, 22]"), "33");
  EXPECT_EQ(message("[11]"), "its rows are not complete");
  EXPECT_EQ(message("[22, 11]"), "its rows are in another order");
}

}  // namespace
}  // namespace hauberk
