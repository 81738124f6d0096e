/// Outcomes of searches as records.

#include "parts/locked_record.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hauberk::test {
namespace {

const KeepGoing always = [] { return true; };

std::string text_of_record(const Locked& l)
{
  RecordWriter out('S');
  write_locked(l, out);
  return out.text();
}

/// What was read is what was written: it is written in the same way again, to the bit.
void expect_kept(const Locked& l)
{
  const std::string text = text_of_record(l);
  RecordReader in(std::string_view(text).substr(1));
  const Locked again = read_locked(in);
  EXPECT_TRUE(in.good);
  EXPECT_TRUE(in.ended());
  EXPECT_EQ(text_of_record(again), text);
  EXPECT_EQ(again.state.macro, l.state.macro);
  EXPECT_EQ(again.message, l.message);
  EXPECT_EQ(again.stages.size(), l.stages.size());
  EXPECT_EQ(again.path.size(), l.path.size());
}

class EveryContact : public ::testing::TestWithParam<ContactChoice> {};

TEST_P(EveryContact, IsKept)
{
  const SceneSpec spec = chain({5.0, 0.7, 0.7}, {5.0, 0.7, 0.7}, 12.0);
  const Sheet sheet;
  const Model model = make_model(spec, sheet, 0.0);
  Schedule schedule;
  schedule.keep_path = true;
  const MacroLoad load = macro_load(model, Direction::at_degrees(0.0), Sense::positive);
  const Locked l = lock(model, rest_state(model), load, GetParam(), schedule, always);
  ASSERT_EQ(l.status, LockStatus::locked) << l.message;
  ASSERT_TRUE(is_recordable(l));
  EXPECT_EQ(l.pressed.has_value(), GetParam() == ContactChoice::constrained);
  expect_kept(l);
}

INSTANTIATE_TEST_SUITE_P(LockedRecord, EveryContact,
                         ::testing::Values(ContactChoice::automatic, ContactChoice::nearest,
                                           ContactChoice::arc, ContactChoice::published,
                                           ContactChoice::constrained),
                         [](const auto& info) {
                           return "choice_" + std::to_string(static_cast<int>(info.param));
                         });

TEST(LockedRecord, KeepsNumbersThatAreNone)
{
  Locked l;
  l.status = LockStatus::unbounded;
  l.message = "a % 'word'\n\x1b and \t more";
  l.state.macro = Vector::Constant(2, -0.0);
  l.state.e = Vector::Constant(1, std::numeric_limits<double>::quiet_NaN());
  l.stage.target = std::numeric_limits<double>::infinity();
  l.stage.least_curvature = -std::numeric_limits<double>::infinity();
  l.stage.tether = Matrix::Constant(2, 0, 0.0);
  l.error_estimate = 5e-324;
  l.path.resize(3, l.state);
  const std::string text = text_of_record(l);
  RecordReader in(std::string_view(text).substr(1));
  const Locked again = read_locked(in);
  EXPECT_TRUE(in.good && in.ended());
  EXPECT_EQ(text_of_record(again), text);
  EXPECT_EQ(again.message, l.message);
  EXPECT_TRUE(std::signbit(again.state.macro[1]));
  EXPECT_EQ(again.stage.tether.rows(), 2);
}

/// Whatever is cut off or changed, it is noticed, and nothing is read beyond the end.
TEST(LockedRecord, CutAndChangedRecordsAreNoticed)
{
  Locked l;
  l.state.macro = Vector::Constant(3, 0.1);
  l.state.rotation.resize(2, Mat3::Identity());
  l.trail.resize(2, l.state);
  const std::string text = text_of_record(l);
  for (std::size_t n = 1; n + 1 < text.size(); ++n) {
    RecordReader in(std::string_view(text).substr(1, n));
    read_locked(in);
    EXPECT_FALSE(in.good && in.ended() && n + 2 < text.size() && text[n + 1] == ' ') << n;
  }
  RecordWriter whole('S');
  write_locked(l, whole);
  const std::string line = std::move(whole).line();
  ASSERT_EQ(undamaged_record(line), std::string_view(text));
  for (std::size_t k = 0; k < line.size(); ++k) {
    for (const char by : {'\x01', '\x10', '\x40'}) {
      std::string changed = line;
      changed[k] = static_cast<char>(changed[k] ^ by);
      EXPECT_FALSE(undamaged_record(changed)) << k;
    }
    EXPECT_FALSE(undamaged_record(std::string_view(line).substr(0, k))) << k;
  }
}

}  // namespace
}  // namespace hauberk::test
