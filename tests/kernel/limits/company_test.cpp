/// Searches from rest: limits in company, what their searches may cost, and random loads.

#include "limits/donors.hpp"
#include "limits/limit_report.hpp"
#include "limits/rest_searches.hpp"
#include "loadcases/in_plane_periodic/in_plane_periodic.hpp"
#include "model/held_model.hpp"
#include "model/links.hpp"
#include "symmetric_scenes.hpp"
#include "thin_sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace hauberk::test {
namespace {

using Hold = InPlanePeriodic::Hold;
using Out = InPlanePeriodic::OutOfPlane;

constexpr Hold held_nothing{false, false}, held_shear{true, false};

/// A scene under an in-plane load, with neighbours at 20 degrees.
struct Fabric {
  InPlanePeriodic load;
  SceneSpec scene;
  Model model;
  LimitSettings settings;

  Fabric(SceneSpec spec, Hold hold) : load(StrainMeasure::tensor, Out{}, hold), scene(std::move(spec))
  {
    model = make_model(scene, load, 0.0);
    settings.neighbours = 20.0;
  }
  /// Direction, sense (+-) and starts of each, and how many of these may cost what they want.
  std::vector<std::string> searches(const std::vector<LimitTask>& tasks) const
  {
    std::vector<std::string> out;
    for (const RestSearches& s : rest_searches(model, tasks, settings)) {
      out.push_back(s.task.direction.text() + (s.task.sense == Sense::positive ? ", +, " : ", -, ") +
                    std::to_string(s.starts) +
                    (s.sparing_from < s.starts ? ", sparing from " + std::to_string(s.sparing_from) : ""));
    }
    return out;
  }
};

LimitTask at(double degrees, Sense sense) { return {Direction::at_degrees(degrees), sense}; }

using Texts = std::vector<std::string>;

TEST(Company, StretchesOfSheetsHaveItBesideAndAcross)
{
  const Texts lone{"10 degrees, +, 2, sparing from 1", "-10 degrees, +, 1, sparing from 0",
                   "30 degrees, +, 1, sparing from 0", "-80 degrees, -, 1, sparing from 0"};
  EXPECT_EQ(Fabric(japanese(false), held_shear).searches({at(10.0, Sense::positive)}), lone);
  EXPECT_EQ(Fabric(japanese(false), held_nothing).searches({at(10.0, Sense::positive)}), lone);
  // Of two within 20 degrees each has the other on that side; 100 degrees pushed together is asked for with
  // all its starts.
  const Texts three =
      Fabric(japanese(false), held_shear)
          .searches({at(10.0, Sense::positive), at(25.0, Sense::positive), at(100.0, Sense::negative)});
  EXPECT_EQ(three, (Texts{"10 degrees, +, 2, sparing from 1", "25 degrees, +, 2, sparing from 1",
                          "100 degrees, -, 25", "90 degrees, -, 7", "110 degrees, -, 7", "80 degrees, -, 7",
                          "120 degrees, -, 7", "-10 degrees, +, 1, sparing from 0",
                          "45 degrees, +, 1, sparing from 0", "-65 degrees, -, 1, sparing from 0"}));
  // Compressions that are 15 degrees apart have others between them. Directions are lines: 165 degrees are 15
  // from 0.
  const Texts pushed =
      Fabric(japanese(false), held_shear)
          .searches({at(100.0, Sense::negative), at(115.0, Sense::negative), at(125.0, Sense::negative)});
  EXPECT_EQ(pushed, (Texts{"100 degrees, -, 25", "115 degrees, -, 25", "125 degrees, -, 25",
                           "90 degrees, -, 7", "110 degrees, -, 7", "80 degrees, -, 7", "105 degrees, -, 7",
                           "135 degrees, -, 7", "145 degrees, -, 7"}));
  EXPECT_EQ(
      Fabric(japanese(false), held_shear).searches({at(0.0, Sense::positive), at(165.0, Sense::positive)}),
      (Texts{"0 degrees, +, 2, sparing from 1", "165 degrees, +, 2, sparing from 1",
             "20 degrees, +, 1, sparing from 0", "90 degrees, -, 1, sparing from 0",
             "145 degrees, +, 1, sparing from 0", "75 degrees, -, 1, sparing from 0"}));
  // In large cells what is held is broken by states of other directions.
  EXPECT_EQ(Fabric(repeated(japanese(false), 3, 2), held_shear).searches({at(10.0, Sense::positive)}),
            (Texts{"10 degrees, +, 1", "-80 degrees, -, 1, sparing from 0"}));
  Texts large = lone;
  large[0] = "10 degrees, +, 1";
  EXPECT_EQ(Fabric(repeated(japanese(false), 3, 2), held_nothing).searches({at(10.0, Sense::positive)}),
            large);
}

TEST(Company, StartsThatAreAskedForMayCostWhatTheyWant)
{
  Fabric sheet(japanese(false), held_shear);
  for (const int starts : {2, 3}) {
    sheet.settings.starts = starts;
    EXPECT_EQ(sheet.searches({at(10.0, Sense::positive)})[0], "10 degrees, +, " + std::to_string(starts));
  }
}

TEST(Company, OthersHaveNone)
{
  // A chain: links hold nothing together across it.
  const Fabric row(chain({5.0, 0.5, 0.5}, {5.0, 0.5, 0.5}, 12.0), held_shear);
  EXPECT_EQ(row.searches({at(0.0, Sense::positive)}), Texts{"0 degrees, +, 1"});
  Fabric sheet(japanese(false), held_shear);
  sheet.settings.contact = ContactChoice::constrained;
  EXPECT_EQ(sheet.searches({at(10.0, Sense::positive)}), Texts{"10 degrees, +, 1"});
  sheet.settings.contact = ContactChoice::automatic;
  sheet.settings.neighbours = 0.0;
  EXPECT_EQ(sheet.searches({at(10.0, Sense::positive)}), Texts{"10 degrees, +, 2, sparing from 1"});
  sheet.settings.neighbours = 20.0;
  sheet.settings.lessons = false;
  EXPECT_EQ(sheet.searches({at(10.0, Sense::positive)}), Texts{"10 degrees, +, 1"});
}

/// A random load leads where the shear is not zero, from where a tether brings the fabric back; ribbons of
/// these tubes do not see all that is in its way.
TEST(RandomLoads, OfTallTubesComeBackToWhatIsHeld)
{
  const InPlanePeriodic load(StrainMeasure::tensor, Out{}, held_shear);
  const Model model = make_model(tall_tubes(), load, 0.098);
  LimitSettings settings;
  settings.schedule.last = 1e-3;
  for (int number = 12; number < 18; ++number) {
    const Locked found =
        limit_from_random_load(model, at(45.0, Sense::negative), settings, number, uninterrupted);
    EXPECT_EQ(found.status, LockStatus::locked) << number << ": " << found.message;
  }
}

/// A search ends at the first step past what it may have, wherever that is, and is no locked state.
TEST(Allowance, EndsASearchAndIsKept)
{
  const Fabric fabric(japanese(true), held_shear);
  const LimitTask task = at(10.0, Sense::negative);
  const Locked whole = limit_from_start(fabric.model, task, fabric.settings, 0, uninterrupted);
  ASSERT_EQ(whole.status, LockStatus::locked);
  LimitSettings settings = fabric.settings;
  settings.schedule.most_evaluations = whole.evaluations;
  const Locked same = limit_from_start(fabric.model, task, settings, 0, uninterrupted);
  ASSERT_EQ(same.status, LockStatus::locked);
  EXPECT_EQ(same.state.macro, whole.state.macro);
  long last = 0;
  for (const double part : {0.02, 0.3, 0.6, 0.9}) {
    settings.schedule.most_evaluations = static_cast<long>(part * static_cast<double>(whole.evaluations));
    const Locked ended = limit_from_start(fabric.model, task, settings, 0, uninterrupted);
    EXPECT_EQ(ended.status, LockStatus::stalled) << part;
    EXPECT_GT(ended.evaluations, settings.schedule.most_evaluations);
    EXPECT_LT(ended.evaluations, whole.evaluations) << part;
    EXPECT_GT(ended.evaluations, last);
    last = ended.evaluations;
  }
}

TEST(Allowance, OfCheapSearchesIsHalfAMillion)
{
  EXPECT_EQ(allowance(0), 500'000);
  EXPECT_EQ(allowance(125'000), 500'000);
  EXPECT_EQ(allowance(1'000'000), 4'000'000);
}

/// One in three random loads folds this sheet a way that leads further than any of 40 starts from rest.
TEST(RandomLoads, LeadToFoldsThatStartsDoNotComeTo)
{
  const ThinSheet s;
  double from_rest = 0.0, folded = 0.0;
  for (int k = 0; k < 40; ++k) {
    const Locked start = limit_from_start(s.model, s.task, s.settings, k, uninterrupted);
    if (start.status == LockStatus::locked) from_rest = std::max(from_rest, s.pushed(start));
  }
  for (int k = 0; k < 12; ++k) {
    const Locked found = limit_from_random_load(s.model, s.task, s.settings, k, uninterrupted);
    if (found.status != LockStatus::locked) continue;
    folded = std::max(folded, s.pushed(found));
    EXPECT_TRUE(links_kept(s.model, found.state)) << k;
    EXPECT_TRUE(keeps(macro_load(s.model, s.task.direction, s.task.sense).held, found.state.macro)) << k;
  }
  EXPECT_NEAR(folded, 0.62667, 1e-4);
  EXPECT_LT(from_rest, 0.61);
}

/// The same number is the same search, and all of its work is told.
TEST(RandomLoads, AreRepeatableAndCounted)
{
  const ThinSheet s;
  const Locked one = limit_from_random_load(s.model, s.task, s.settings, 5, uninterrupted);
  const Locked same = limit_from_random_load(s.model, s.task, s.settings, 5, uninterrupted);
  EXPECT_EQ(one.state.e, same.state.e);
  EXPECT_EQ(one.evaluations, same.evaluations);
  int finished = 0;
  for (const StageRecord& stage : one.stages) finished += stage.iterations;
  EXPECT_GT(one.iterations, finished) << "the random load's own steps too";
  long calls = 0;
  limit_from_random_load(s.model, s.task, s.settings, 5, [&calls] { return ++calls > 0; });
  for (const long last : {1L, calls / 4, calls / 2, calls - 1}) {
    long left = last;
    EXPECT_EQ(limit_from_random_load(s.model, s.task, s.settings, 5, [&left] { return left-- > 0; }).status,
              LockStatus::interrupted)
        << last << " of " << calls;
  }
}

/// Across a chain nothing stops a load, and a random one drives it without end: there are none, and where one
/// is asked for all the same the search is a start like others.
TEST(RandomLoads, OfWhatNothingHoldsTogetherAreStarts)
{
  const Fabric row(chain({5.0, 0.5, 0.5}, {5.0, 0.5, 0.5}, 12.0), held_shear);
  const LimitTask task = at(0.0, Sense::negative);
  EXPECT_EQ(rest_searches(row.model, {task}, row.settings)[0].random_loads, 0U);
  const Fabric sheet(japanese(false), held_shear);
  EXPECT_EQ(rest_searches(sheet.model, {task}, sheet.settings)[0].random_loads, 12U);
  const Locked found = limit_from_random_load(row.model, task, row.settings, 1, uninterrupted);
  const Locked start = limit_from_start(row.model, task, row.settings, 1, uninterrupted);
  EXPECT_EQ(found.status, LockStatus::locked);
  EXPECT_EQ(found.state.macro, start.state.macro);
  EXPECT_GT(found.evaluations, start.evaluations);
}

/// Where searches do not agree large cells, which have more folds, have as many more starts as small ones, up
/// to 64 elements; random loads from locked states are of those that begin under them.
TEST(FurtherStarts, DoNotDwindleWithTheCellUntilItIsLarge)
{
  const auto searches = [](int n, int fold_starts) {
    const Fabric sheet(repeated(fourfold(), n, n), held_shear);
    EXPECT_EQ(sheet.model.element_count(), 3 * n * n);
    LimitSettings settings = sheet.settings;
    settings.fold_starts = fold_starts;
    return rest_searches(sheet.model, {at(0.0, Sense::negative)}, settings)[0];
  };
  EXPECT_EQ(searches(1, 12).further_starts, 24U);
  EXPECT_EQ(searches(1, 12).refolds, 24U);
  EXPECT_EQ(searches(3, 12).starts, 5U);
  EXPECT_EQ(searches(3, 12).further_starts, 24U);
  EXPECT_EQ(searches(3, 12).refolds, 4U);
  EXPECT_EQ(searches(6, 12).further_starts, 14U);  // 24 x 64/108
  EXPECT_EQ(searches(3, 1).further_starts, 0U);
}

}  // namespace
}  // namespace hauberk::test
