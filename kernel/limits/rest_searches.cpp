#include "limits/rest_searches.hpp"

#include "limits/donors.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Elements of the largest cell that has all LimitSettings::fold_starts.
constexpr int cell_of_all_starts = 4;

/// Starts of a taut limit that begins again, at least, in cells of so many elements at most: a large
/// perturbation at times leads further than the small one of the first.
constexpr int taut_starts = 2, cell_of_taut_starts = 16;

/// Of the starts of a limit that inherits nothing, what one has that begins again where scenes within lock.
constexpr int share_where_inherited = 2;

/// Of the starts of a limit that is asked for, what one beside it has.
constexpr int share_beside = 4;

/// LimitSettings::fold_starts, fewer in large cells, where each is expensive.
int fold_starts(const Model& model, const LimitSettings& settings)
{
  return std::max(1, settings.fold_starts / std::max(1, model.element_count() / cell_of_all_starts));
}

/// Whether another load case that holds more asks something else of a limit, which then inherits from it.
bool holds_more_within(const Model& model, const LimitTask& task)
{
  const LoadCase& load = *model.load;
  const std::vector<StricterLoadCase> stricter = load.stricter();
  return std::any_of(stricter.begin(), stricter.end(), [&](const StricterLoadCase& s) {
    return s.load->coordinate_count() != load.coordinate_count() ||
           s.load->conditions(task.direction).size() != load.conditions(task.direction).size();
  });
}

RestSearches asked_for(const Model& model, const LimitTask& task, const LimitSettings& settings)
{
  const int starts = std::max(1, settings.starts);
  RestSearches out{task, static_cast<std::size_t>(starts), false};
  if (!settings.lessons) return out;
  if (is_taut(model, task) && begins_again(model, task, settings.contact) &&
      model.element_count() <= cell_of_taut_starts && starts < taut_starts) {
    out.starts = taut_starts;
    out.sparing_from = static_cast<std::size_t>(starts);
  }
  if (!may_fold(model, task)) return out;
  // A fabric with room folds one way under the widest stage and another way without it.
  const int share = holds_more_within(model, task) ? share_where_inherited : 1;
  out.starts = static_cast<std::size_t>(std::max(starts, fold_starts(model, settings) / share)) + 1;
  out.narrow = true;
  return out;
}

RestSearches beside(const Model& model, const LimitTask& task, const LimitSettings& settings)
{
  const int starts = fold_starts(model, settings) / share_beside;
  if (starts < 1 || !may_fold(model, task)) return {task, 1, false};
  return {task, static_cast<std::size_t>(starts) + 1, true};
}

/// Of the evaluations from rest, what another search of a taut limit may have, and what any may.
constexpr long allowed = 4, always_allowed = 500'000;

/// Directions and their opposites are one.
bool on_one_line(const LimitTask& a, const LimitTask& b)
{
  return a.direction.is_angle() && b.direction.is_angle() &&
         std::abs(std::remainder(a.direction.degrees() - b.direction.degrees(), 180.0)) < 1e-9;
}

/// Whether another of the tasks is within `apart` degrees.
bool has_company(const LimitTask& task, const std::vector<LimitTask>& tasks, double apart)
{
  return std::any_of(tasks.begin(), tasks.end(), [&](const LimitTask& o) {
    if (!o.direction.is_angle() || o.sense != task.sense) return false;
    const double to = std::abs(o.direction.degrees() - task.direction.degrees());
    return to > 0.0 && to <= apart + 1e-9;
  });
}

/// `entry` behind those that are there, unless its limit is among them or links do not bound it.
void add(std::vector<RestSearches>& searches, const Model& model, const RestSearches& entry)
{
  const LimitTask& task = entry.task;
  const bool there = std::any_of(searches.begin(), searches.end(), [&](const RestSearches& s) {
    return s.task.sense == task.sense && on_one_line(s.task, task);
  });
  if (!there && bounded_by_links(model, task) == Boundedness::attained) searches.push_back(entry);
}

}  // namespace

long allowance(long evaluations) { return std::max(always_allowed, allowed * evaluations); }

std::vector<RestSearches> rest_searches(const Model& model, const std::vector<LimitTask>& tasks,
                                        const LimitSettings& settings)
{
  std::vector<RestSearches> out;
  out.reserve(tasks.size());
  for (const LimitTask& task : tasks) out.push_back(asked_for(model, task, settings));
  const double apart = settings.neighbours;
  if (!settings.lessons || apart <= 0.0) return out;
  const auto has_none = [&](const LimitTask& task) {
    return !task.direction.is_angle() || bounded_by_links(model, task) != Boundedness::attained;
  };
  const auto add_beside = [&](const LimitTask& task, double by, bool sparing) {
    if (has_company(task, tasks, by)) return;
    for (const double angle : {-by, by}) {
      RestSearches searches =
          beside(model, {Direction::at_degrees(task.direction.degrees() + angle), task.sense}, settings);
      if (sparing) searches.sparing_from = 0;
      add(out, model, searches);
    }
  };
  for (const LimitTask& task : tasks) {
    if (has_none(task)) continue;
    const bool folds = may_fold(model, task);
    if (folds) add_beside(task, 0.5 * apart, false);
    if (folds || !model.load->periodic()) add_beside(task, apart, false);
  }
  for (const LimitTask& task : tasks) {
    if (!is_taut(model, task) || !begins_again(model, task, settings.contact)) continue;
    if (learns_beside(model, task)) add_beside(task, apart, true);
    RestSearches across;
    across.task = {Direction::at_degrees(std::remainder(task.direction.degrees() + 90.0, 180.0)),
                   Sense::negative};
    across.sparing_from = 0;
    add(out, model, across);
  }
  return out;
}

}  // namespace hauberk
