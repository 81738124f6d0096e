/// Limits in company: which are solved beside those that are asked for, and what their searches may cost.

#include "limits/donors.hpp"
#include "limits/rest_searches.hpp"
#include "loadcases/in_plane_periodic/in_plane_periodic.hpp"
#include "symmetric_scenes.hpp"

#include <gtest/gtest.h>

#include <string>

namespace hauberk::test {
namespace {

using Hold = InPlanePeriodic::Hold;
using Out = InPlanePeriodic::OutOfPlane;

constexpr Hold held_nothing{false, false}, held_shear{true, false}, held_both{true, true};
const KeepGoing uninterrupted = [] { return true; };

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
  // Of two within 20 degrees each has the other; 100 degrees pushed together is asked for with all its
  // starts.
  const Texts three =
      Fabric(japanese(false), held_shear)
          .searches({at(10.0, Sense::positive), at(25.0, Sense::positive), at(100.0, Sense::negative)});
  EXPECT_EQ(three, (Texts{"10 degrees, +, 2, sparing from 1", "25 degrees, +, 2, sparing from 1",
                          "100 degrees, -, 17", "90 degrees, -, 9", "110 degrees, -, 9", "80 degrees, -, 9",
                          "120 degrees, -, 9", "-65 degrees, -, 1, sparing from 0"}));
  // Compressions that are 15 degrees apart have others between them.
  const Texts pushed =
      Fabric(japanese(false), held_shear)
          .searches({at(100.0, Sense::negative), at(115.0, Sense::negative), at(125.0, Sense::negative)});
  EXPECT_EQ(pushed, (Texts{"100 degrees, -, 17", "115 degrees, -, 17", "125 degrees, -, 17",
                           "90 degrees, -, 9", "110 degrees, -, 9"}));
  // What begins again from where more is held has half the starts of what does not.
  EXPECT_EQ(Fabric(japanese(false), held_both).searches({at(100.0, Sense::negative)})[0],
            "100 degrees, -, 33");
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

}  // namespace
}  // namespace hauberk::test
