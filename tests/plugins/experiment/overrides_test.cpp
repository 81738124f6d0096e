/// --set on the command line.

#include "document/jsonc.hpp"
#include "fake_plugins.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

std::string with_set(const std::vector<std::string>& overrides)
{
  return problems_of(valid_text(), overrides);
}

TEST(Overrides, ReplaceCreateAndAppend)
{
  const Experiment e =
      read_ok(valid_text(), {"/solver/preset=paper", "/seed=7", "/load_case/directions_deg=[10]",
                             "/load_case/directions_deg/-=20", "/load_case/directions_deg/0=15",
                             "/elements/link/parameters/ring.R=5.5", "/description=a = b",
                             "/cell/repeat=[2, 2]", "/name=\"5\""});
  EXPECT_EQ(e.solver.preset, "paper");
  EXPECT_EQ(e.seed, 7u);
  EXPECT_EQ(e.directions_deg, (std::vector<double>{15, 20}));
  EXPECT_EQ(e.scene.elements.size(), 8u);
  EXPECT_EQ(e.scene.elements[7].parameters[0], 5.5);
  EXPECT_EQ(e.resolved.at("description").string, "a = b");
  EXPECT_EQ(e.name, "5");
}

TEST(Overrides, CreatesSectionsOnTheWay)
{
  const std::string text = with(valid_text(), "\"solver\": { \"tolerance\": 1e-3 },", "");
  EXPECT_EQ(read_ok(text, {"/solver/tolerance=1e-3"}).solver.tolerance, 1e-3);
}

TEST(Overrides, AreCheckedLikeTheFile)
{
  EXPECT_EQ(with_set({"/solver/preset=papr"}),
            "command line: /solver/preset: expected one of accurate, paper, found \"papr\"; did you "
            "mean 'paper'?");
  EXPECT_EQ(with_set({"/sovler/preset=fast"}),
            "command line: /sovler: unknown key 'sovler'; did you mean 'solver'?");
  EXPECT_EQ(with_set({"/elements/link/parameters/ring.R=-1"}),
            "command line: /elements/link/parameters/ring.R: expected a number in [0, 1000000], found -1");
  EXPECT_EQ(with_set({"/load_case/directions_deg=[0,180]"}),
            "command line: /load_case/directions_deg/1: direction 180 is the same as 0: directions count "
            "modulo 180 degrees");
  // Problems of the file keep their lines beside those of the command line.
  EXPECT_EQ(problems_of(with(valid_text(), "\"pair\"", "5"), {"/seed=x"}),
            "t.json:2: /name: expected a string, found 5\n"
            "command line: /seed: expected an integer >= 0, found \"x\"");
}

TEST(Overrides, RefusesWhatCannotBeApplied)
{
  EXPECT_EQ(
      with_set({"solver.preset=fast"}),
      "command line: --set expects POINTER=VALUE, as in /solver/tolerance=1e-3; found 'solver.preset=fast'");
  EXPECT_EQ(with_set({"/solver"}),
            "command line: --set expects POINTER=VALUE, as in /solver/tolerance=1e-3; found '/solver'");
  EXPECT_EQ(with_set({""}),
            "command line: --set expects POINTER=VALUE, as in /solver/tolerance=1e-3; found ''");
  EXPECT_EQ(with_set({"/cell/place/5/element=x"}),
            "command line: /cell/place: --set cannot reach '5': expected an index from 0 to 2");
  EXPECT_EQ(with_set({"/cell/place/first=1"}),
            "command line: /cell/place: --set cannot reach 'first': expected an index from 0 to 2");
  EXPECT_EQ(with_set({"/name/x=1"}),
            "command line: /name: --set cannot reach 'x': there is no object or array here");
}

}  // namespace
}  // namespace hauberk::test
