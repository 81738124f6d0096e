/// Searches beyond the first, of limits whose searches from rest do not agree.

#include "limits/further_searches.hpp"

#include "limits/confidence.hpp"
#include "limits/search_memory.hpp"
#include "model/links.hpp"
#include "thin_sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace hauberk::test {
namespace {

/// The word for searches that all ended at one value, in so many states.
std::string word_of(const std::vector<int>& counts)
{
  const ThinSheet s;
  std::vector<FoundState> found;
  std::vector<LockedState> states;
  for (const int count : counts) {
    LockedState state;
    state.count = count;
    states.push_back(state);
    FoundState one;
    one.locked.status = LockStatus::locked;
    one.locked.state = rest_state(s.model);
    found.insert(found.end(), static_cast<std::size_t>(count), one);
  }
  Confidence out;
  enter_searches(out, s.model, s.task, s.settings, found, 0, states);
  EXPECT_EQ(out.seen_once, std::count(counts.begin(), counts.end(), 1));
  return out.word;
}

TEST(Confidence, IsUnsettledWhereManySearchesEndInStatesOfTheirOwn)
{
  EXPECT_EQ(word_of({22}), "confirmed");
  EXPECT_EQ(word_of({20, 1, 1}), "confirmed");
  EXPECT_EQ(word_of({17, 1, 1}), "unsettled") << "two of nineteen";
  EXPECT_EQ(word_of({3, 1, 1, 1}), "confirmed") << "too few to tell";
  EXPECT_EQ(word_of({8, 1}), "confirmed") << "one search that went astray";
  EXPECT_EQ(word_of({8, 1, 1}), "unsettled");
  EXPECT_EQ(word_of({1}), "single");
}

/// A result of searches that ended so often in each of some states, the furthest first.
LimitResult ended(const std::vector<int>& counts, int failed = 0)
{
  LimitResult out;
  out.status = LimitStatus::locked;
  out.value = -0.5;
  for (const int count : counts) {
    LockedState state;
    state.count = count;
    out.starts.push_back(state);
    out.confidence.searches += count;
    out.confidence.seen_once += count == 1 ? 1 : 0;
  }
  out.confidence.ended_here = counts.front();
  out.confidence.searches += failed;
  out.confidence.failed_searches.resize(static_cast<std::size_t>(failed));
  return out;
}

TEST(SearchesAgree, WhereNoStateWasSeenOnceAndTheFurthestOften)
{
  EXPECT_TRUE(searches_agree(ended({25})));
  EXPECT_TRUE(searches_agree(ended({7, 18})));
  EXPECT_FALSE(searches_agree(ended({6, 19}))) << "less than a quarter";
  EXPECT_FALSE(searches_agree(ended({24, 1}))) << "a state that one search alone came to";
  EXPECT_FALSE(searches_agree(ended({1})));
  EXPECT_FALSE(searches_agree(ended({24}, 1))) << "what a failed search would have come to is not known";
  LimitResult none = ended({25});
  none.status = LimitStatus::unbounded;
  EXPECT_FALSE(searches_agree(none));
}

/// What agrees is left, until others lead it further; what does not has starts of new numbers once, and
/// random loads, of new seeds, from every state that it comes to.
TEST(FurtherSearches, AreOfLimitsThatDoNotAgree)
{
  const ThinSheet s;
  LimitSettings settings = s.settings;
  const LimitsObserver observer;
  TaskSearches searches(s.model, s.scene, {s.task}, settings, observer);
  ASSERT_EQ(searches.of(0).starts.size(), 25U);

  FurtherSearches settled(s.model, searches);
  std::vector<LimitResult> results{ended({25})};
  EXPECT_TRUE(settled.undecided(results).empty());
  EXPECT_TRUE(settled.unfolded(results).empty());
  results[0].value = -0.6;
  EXPECT_EQ(settled.unfolded(results), std::vector<std::size_t>{0});

  FurtherSearches open(s.model, searches);
  results[0] = ended({20, 4, 1});
  ASSERT_EQ(open.undecided(results), std::vector<std::size_t>{0});
  std::set<std::size_t> numbers;
  for (const FurtherSearch& search : open.from_rest({0})) {
    EXPECT_EQ(search.from, nullptr);
    numbers.insert(search.number);
  }
  EXPECT_EQ(numbers.size(), 24U);
  EXPECT_EQ(*numbers.begin(), 25U) << "the first numbers are those of the starts before";

  FurtherSearches endless(s.model, searches);
  std::vector<LimitResult> unbounded = results;
  unbounded[0].status = LimitStatus::unbounded;
  EXPECT_TRUE(endless.undecided(unbounded).empty()) << "nothing stops it, whatever else is searched";
  EXPECT_TRUE(endless.unfolded(unbounded).empty());

  Attempt found;
  found.locked.emplace();
  found.locked->status = LockStatus::locked;
  found.locked->state = rest_state(s.model);
  searches.enter(0, 25, found);
  for (const int round : {1, 2}) {
    ASSERT_EQ(open.unfolded(results), std::vector<std::size_t>{0});
    const std::vector<FurtherSearch> loads = open.refolds({0});
    EXPECT_EQ(loads.size(), 24U);
    for (const FurtherSearch& load : loads) {
      ASSERT_NE(load.from, nullptr);
      EXPECT_TRUE(numbers.insert(load.number).second) << "round " << round << " repeats " << load.number;
    }
    results[0].value = -open.refolded_from(0);
    EXPECT_TRUE(open.unfolded(results).empty()) << "nothing further is known";
    results[0].value = -0.6;
  }
}

/// Names of searches, with how far each came.
class Names final : public SearchMemory {
 public:
  std::optional<KnownSearch> recall(const std::string&) override { return std::nullopt; }
  void record(const std::string& name, const Locked& locked, double) override { found[name] = locked; }
  std::map<std::string, Locked> found;
};

/// From where starts end most of this sheet's random loads lead further, as they do from rest; all of their
/// work is told, and a search that is interrupted says so.
TEST(Refolding, LeadsOnFromALockedState)
{
  const ThinSheet s;
  const Locked start = limit_from_start(s.model, s.task, s.settings, 0, uninterrupted);
  ASSERT_EQ(start.status, LockStatus::locked);
  double furthest = 0.0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Locked found = limit_refolded(s.model, s.task, s.settings, start.state, seed, uninterrupted);
    if (found.status != LockStatus::locked) continue;
    furthest = std::max(furthest, s.pushed(found));
    int finished = 0;
    for (const StageRecord& stage : found.stages) finished += stage.iterations;
    EXPECT_GT(found.iterations, finished) << "the random load's own steps too";
  }
  EXPECT_LT(s.pushed(start), 0.61);
  EXPECT_NEAR(furthest, 0.62667, 1e-4);
  long left = 20;
  EXPECT_EQ(
      limit_refolded(s.model, s.task, s.settings, start.state, 1, [&left] { return left-- > 0; }).status,
      LockStatus::interrupted);
}

/// A limit that is asked for goes on where its searches do not agree, and its result counts them.
TEST(Refolding, IsPartOfALimit)
{
  const ThinSheet s;
  Names names;
  LimitsObserver observer;
  observer.memory = &names;
  const LimitResult r = compute_limits(s.model, s.scene, {s.task}, s.settings, 1, observer)[0];
  const auto named = [&names](const std::string& part) {
    return std::count_if(names.found.begin(), names.found.end(), [&part](const auto& search) {
      return search.first.starts_with("limit 0") && search.first.find(part) != std::string::npos;
    });
  };
  EXPECT_EQ(named(" start "), 12 + 24);
  EXPECT_EQ(named(" random load ") % 24, 12) << "from rest, and from every furthest state";
  EXPECT_GT(named(" from "), 0);
  EXPECT_GE(r.confidence.searches, 25 + 24);
  for (const auto& [name, locked] : names.found) {
    const bool from_rest = name.starts_with("limit 0") && name.find(" from ") == std::string::npos;
    if (from_rest && locked.status == LockStatus::locked) {
      EXPECT_LE(s.pushed(locked), -*r.value + 1e-6) << name;
    }
  }
}

/// A stretch whose contacts bear so much between elements that are linked, and between others.
LimitResult borne(const Model& m, double linked, double unlinked)
{
  LimitResult out = ended({5});
  out.value = 0.5;
  const Link& link = m.links.front();
  ContactForce force;
  force.force = linked;
  // As it is seen from the second element.
  force.elements = {element_of_cycle(m, link.b), element_of_cycle(m, link.a)};
  force.image = {-link.image[0], -link.image[1], -link.image[2]};
  out.contacts.push_back(force);
  force.force = unlinked;
  force.image = {7, 0, 0};
  out.contacts.push_back(force);
  force.wall = "floor";
  force.force = 100.0;
  out.contacts.push_back(force);
  return out;
}

/// A stretch that links bear is done with its searches from rest; one that is borne by others has tilted
/// loads.
TEST(FurtherSearches, OfStretchesAreTiltedLoadsWhereElementsClasp)
{
  const ThinSheet s;
  const LimitsObserver observer;
  TaskSearches searches(s.model, s.scene, {{s.task.direction, Sense::positive}}, s.settings, observer);
  EXPECT_FALSE(is_jammed(s.model, borne(s.model, 0.71, 0.29)));
  EXPECT_TRUE(is_jammed(s.model, borne(s.model, 0.69, 0.31)));
  EXPECT_FALSE(is_jammed(s.model, ended({5}))) << "no forces are known";

  FurtherSearches further(s.model, searches);
  EXPECT_TRUE(further.undecided({borne(s.model, 0.71, 0.29)}).empty());
  ASSERT_EQ(further.undecided({borne(s.model, 0.69, 0.31)}), std::vector<std::size_t>{0});
  std::set<std::size_t> numbers;
  for (const FurtherSearch& search : further.from_rest({0})) {
    EXPECT_EQ(search.tilt, 40.0);
    EXPECT_EQ(search.from, nullptr);
    numbers.insert(search.number);
  }
  EXPECT_EQ(numbers, (std::set<std::size_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_TRUE(further.unfolded({borne(s.model, 0.69, 0.31)}).empty()) << "random loads are for what folds";

  LimitSettings few = s.settings;
  few.most_starts = 1;
  TaskSearches looks(s.model, s.scene, {{s.task.direction, Sense::positive}}, few, observer);
  EXPECT_TRUE(FurtherSearches(s.model, looks).undecided({borne(s.model, 0.69, 0.31)}).empty());
}

/// A search whose allowance was spent in a state that is further than all that locked is made once more.
TEST(TaskSearches, TellWhatGaveUpFurther)
{
  const ThinSheet s;
  const LimitsObserver observer;
  const LimitTask task{s.task.direction, Sense::positive};
  TaskSearches searches(s.model, s.scene, {task}, s.settings, observer);
  FoundState found;
  found.locked.status = LockStatus::stalled;
  found.locked.state = rest_state(s.model);
  found.locked.state.macro[0] = 0.01;
  EXPECT_FALSE(searches.gave_up_further(0, found)) << "nothing locked";

  Attempt locked;
  locked.locked = limit_from_start(s.model, task, s.settings, 0, uninterrupted);
  ASSERT_EQ(locked.locked->status, LockStatus::locked);
  searches.enter(0, 0, locked);
  EXPECT_FALSE(searches.gave_up_further(0, found)) << "it is not as far";
  found.locked.state.macro[0] = locked.locked->state.macro[0] + 0.01;
  EXPECT_TRUE(searches.gave_up_further(0, found));
  found.locked.status = LockStatus::locked;
  EXPECT_FALSE(searches.gave_up_further(0, found));
}

/// Dragonscale (share/weaves) of rings of 8 and 5.4 mm, wire of 0.9 mm: along its scales these clasp each
/// other.
SceneSpec clasping()
{
  constexpr double R = 4.45, small = 3.15, r = 0.45;
  SceneSpec scene = chainmail(1, 1);
  scene.elements.clear();
  scene.lattice = {Vec3(0.8916130388 * R, 0.0, 0.0), Vec3(0.0, 2.298096566 * R, 0.0)};
  for (const Vec3& at : {Vec3(0.0, 0.0, 0.0), Vec3(0.4458065194 * R, 1.149048283 * R, 0.0)}) {
    scene.elements.push_back({0, {R, r, r}, {at, rotation_exp(Vec3(0.0, -50.39400203 * degree, 0.0))}});
    scene.elements.push_back({0, {small, r, r}, {at, rotation_exp(Vec3(0.0, 41.96434558 * degree, 0.0))}});
  }
  return scene;
}

/// A stretch that is resumed from a result without forces, which files do not keep, is searched like one that
/// was never stopped.
TEST(FurtherSearches, OfClaspedStretchesAreMadeAlsoAfterAnInterrupt)
{
  const InPlanePeriodic load(StrainMeasure::tensor, {}, InPlanePeriodic::Hold{true, false});
  const SceneSpec scene = clasping();
  const Model m = make_model(scene, load, 0.0);
  const std::vector<LimitTask> tasks{{Direction::at_degrees(0.0), Sense::positive}};
  LimitSettings settings;
  settings.neighbours = 20.0;
  const std::vector<LimitResult> whole = compute_limits(m, scene, tasks, settings, 2);
  EXPECT_NEAR(*whole[0].value, 0.68404935, 1e-7);
  LimitsObserver enough;
  enough.is_enough = [](const auto&) { return true; };
  std::vector<LimitResult> first = compute_limits(m, scene, tasks, settings, 2, enough);
  ASSERT_NEAR(*first[0].value, 0.66787200, 1e-7) << "its own searches clasp";
  first[0].confidence.word = "alone";
  first[0].resumed = true;
  for (ContactForce& force : first[0].contacts) force.force = 0.0;
  const std::vector<LimitResult> resumed = compute_limits(m, scene, tasks, settings, 2, {}, {first[0]});
  EXPECT_EQ(resumed[0].value, whole[0].value);
  EXPECT_EQ(resumed[0].confidence.searches, whole[0].confidence.searches);
  EXPECT_EQ(resumed[0].confidence.confirmed_by, whole[0].confidence.confirmed_by);
}

/// Whoever wants to know whether a limit is further than something needs no search beyond the first that
/// shows it; the first searches from rest are made in any case, so that this depends on nothing else.
TEST(FurtherSearches, AreNotMadeWhereWhatWasFoundIsEnough)
{
  const ThinSheet s;
  Names names;
  LimitsObserver observer;
  observer.memory = &names;
  std::vector<double> seen;
  std::optional<State> furthest;
  observer.on_states = [&furthest](const auto& states) { furthest = states.at(0); };
  observer.is_enough = [&seen](const std::vector<LimitResult>& found) {
    seen.push_back(*found.at(0).value);
    return true;
  };
  const LimitResult r = compute_limits(s.model, s.scene, {s.task}, s.settings, 1, observer)[0];
  EXPECT_EQ(seen, std::vector<double>{*r.value});
  ASSERT_TRUE(furthest);
  EXPECT_NEAR(reached(s.model, s.task, *furthest), -*r.value, 1e-9);
  EXPECT_EQ(r.confidence.searches, 25);
  for (const auto& [name, locked] : names.found) EXPECT_EQ(name.find(" from "), std::string::npos) << name;

  // Asked again before every kind of search that follows, it may say so later.
  const std::size_t from_rest = names.found.size();
  seen.clear();
  observer.is_enough = [&seen](const std::vector<LimitResult>& found) {
    seen.push_back(*found.at(0).value);
    return seen.size() == 2;
  };
  const LimitResult further = compute_limits(s.model, s.scene, {s.task}, s.settings, 1, observer)[0];
  EXPECT_EQ(seen, (std::vector<double>{*r.value, *further.value}));
  EXPECT_EQ(names.found.size(), from_rest + 24);
}

}  // namespace
}  // namespace hauberk::test
