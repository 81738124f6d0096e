/// The section transition: values, defaults, and what is wrong with it.

#include "fake_plugins.hpp"
#include "tasks/transition/transition_section.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

const std::string section =
    R"("transition": { "activation_distance": 0.1, "paths": [ { "name": "turn", "rotation": { "axis": [0, 0, 2], "degrees": [5, -1] } }, { "name": "push", "steps": 7, "translation": { "to": [1, 2, 3] } } ] })";

std::string text(const std::string& what = section)
{
  return with(valid_text(), "\"name\": \"pair\"", "\"name\": \"pair\", \"task\": \"transition\", " + what);
}

std::string after(const std::string& from, const std::string& to)
{
  return problems_of(text(with(section, from, to)));
}

TEST(Transition, ReadsPathsAndFillsDefaults)
{
  const Experiment e = read_ok(text());
  EXPECT_EQ(e.task, "transition");
  const ExperimentTransition& t = *e.section<ExperimentTransition>();
  EXPECT_EQ(t.fixed, 0);
  EXPECT_EQ(t.moving, 1);
  EXPECT_EQ(t.activation_distance, 0.1);
  EXPECT_DOUBLE_EQ(t.range, 0.3);
  EXPECT_EQ(t.contacts, (std::vector<std::string>{"nearest", "published", "arc", "auto"}));
  ASSERT_EQ(t.paths.size(), 2U);
  EXPECT_EQ(t.paths[0].axis, Vec3(0, 0, 1));
  EXPECT_EQ(t.paths[0].through, Vec3(6, 0, 0)) << "the moving element's origin";
  EXPECT_EQ(t.paths[0].degrees_from, 5.0);
  EXPECT_EQ(t.paths[0].degrees_to, -1.0);
  EXPECT_EQ(t.paths[0].steps, 200);
  EXPECT_EQ(t.paths[1].axis, Vec3(0, 0, 0));
  EXPECT_EQ(t.paths[1].shift_from, Vec3(0, 0, 0));
  EXPECT_EQ(t.paths[1].shift_to, Vec3(1, 2, 3));
  EXPECT_EQ(t.paths[1].steps, 7);
}

TEST(Transition, RangeIsBeyondTheClearance)
{
  const Experiment e =
      read_ok(with(text(), "\"tolerance\": 1e-3", "\"tolerance\": 1e-3, \"clearance\": 0.5"));
  EXPECT_DOUBLE_EQ(e.section<ExperimentTransition>()->range, 0.8);
}

TEST(Transition, ReportsWhatMakesNoSense)
{
  EXPECT_EQ(problems_of(text("\"description\": \"none\"")),
            "t.json:1: missing key 'transition': task transition needs it");
  EXPECT_EQ(after("\"activation", "\"moving\": 2, \"activation"),
            "t.json:2: /transition/moving: expected the number of a placed element, from 0 to 1, found 2");
  EXPECT_EQ(after("\"activation", "\"moving\": 0, \"activation"),
            "t.json:2: /transition: fixed and moving name the same element");
  EXPECT_EQ(after("[0, 0, 2]", "[0, 0, 0]"),
            "t.json:2: /transition/paths/0/rotation/axis: expected an axis that is not zero");
  EXPECT_EQ(
      after("[5, -1]", "[5, 5]"),
      "t.json:2: /transition/paths/0: expected a rotation or a translation that changes along the path");
  EXPECT_EQ(after("\"push\"", "\"turn\""), "t.json:2: /transition/paths/1: path 'turn' is given twice");
  EXPECT_EQ(after("\"paths\"", "\"contacts\": [\"arc\", \"arc\"], \"paths\""),
            "t.json:2: /transition/contacts/1: 'arc' is given twice");
}

}  // namespace
}  // namespace hauberk::test
