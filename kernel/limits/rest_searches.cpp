#include "limits/rest_searches.hpp"

#include "limits/donors.hpp"
#include "model/links.hpp"
#include "numerics/decompositions.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// LimitSettings::fold_starts are divided by how often this many go into a cell's elements.
constexpr int cell_of_all_starts = 4;

/// LimitSettings::fold_starts that follow where those before do not agree, in cells of any size up to so many
/// elements: the more of them, the more folds there are. Of nine fourfold cells one of 24 comes to the
/// furthest state known, and none of the first four. In larger cells, of which each takes long, fewer.
constexpr int times_further = 2, cell_of_all_further = 64;

/// Tilted loads of a taut limit that elements bear which are not linked with each other. Of 24 that are
/// tilted by 40 degrees (further_searches.cpp) 18 or more come to the furthest state of a dragonscale in
/// which starts come to it once in 24 or not at all.
constexpr std::size_t tilts_of_jammed = 6;

/// Starts of a taut limit that begins again, at least, in cells of so many elements at most, which also have
/// the tilted loads: a large perturbation at times leads further than the small one of the first.
constexpr int taut_starts = 2, cell_of_taut_starts = 16;

/// LimitSettings::fold_starts, fewer in large cells, where each is expensive.
int fold_starts(const Model& model, const LimitSettings& settings)
{
  return std::max(1, settings.fold_starts / std::max(1, model.element_count() / cell_of_all_starts));
}

/// Whether links hold the lattice together in all of its directions. Otherwise a random load, too, may drive
/// the strain without end.
bool hangs_together(const Model& m)
{
  const std::vector<Vec3> cycles = cycle_translations(m);
  if (cycles.empty()) return false;
  Matrix translations(3, static_cast<Eigen::Index>(cycles.size()));
  for (std::size_t k = 0; k < cycles.size(); ++k) translations.col(k) = cycles[k];
  constexpr double some = 1e-6;  // of the longest: what is less is rounding
  const Vector lengths = singular_values(translations);
  return (lengths.array() > some * lengths.maxCoeff()).count() == static_cast<Eigen::Index>(m.lattice.size());
}

/// So many starts, and as many under random loads, where one is not all that a large cell is worth; and one
/// without the widest stage: a fabric with room folds one way under that stage and another way without it.
void fold(RestSearches& searches, const Model& model, int starts)
{
  const auto count = static_cast<std::size_t>(starts);
  searches.starts = count > 1 ? 2 * count + 1 : 2;
  searches.random_loads = count > 1 && hangs_together(model) ? count : 0;
  searches.narrow = true;
}

RestSearches asked_for(const Model& model, const LimitTask& task, const LimitSettings& settings)
{
  const auto at_most = [&settings](int count) {
    return settings.most_starts > 0 ? std::min(count, settings.most_starts) : count;
  };
  const int starts = at_most(std::max(1, settings.starts));
  RestSearches out{task, static_cast<std::size_t>(starts)};
  if (!settings.lessons) return out;
  if (is_taut(model, task) && begins_again(model, task, settings.contact) &&
      model.element_count() <= cell_of_taut_starts && starts < taut_starts) {
    out.starts = taut_starts;
    out.sparing_from = static_cast<std::size_t>(starts);
  }
  const bool folds = may_fold(model, task);
  const int starts_of_folds = fold_starts(model, settings);
  if (folds) fold(out, model, at_most(std::max(starts, starts_of_folds)));
  if (settings.most_starts > 0) return out;
  if (folds && settings.fold_starts > 1) {
    const int n = std::max(cell_of_all_further, model.element_count());
    out.further_starts =
        static_cast<std::size_t>(times_further * settings.fold_starts * cell_of_all_further / n);
    out.refolds = static_cast<std::size_t>(times_further * starts_of_folds);
  }
  if (is_taut(model, task) && begins_again(model, task, settings.contact) &&
      model.element_count() <= cell_of_taut_starts)
    out.further_starts = tilts_of_jammed;
  return out;
}

RestSearches beside(const Model& model, const LimitTask& task, const LimitSettings& settings)
{
  const int starts = fold_starts(model, settings) / share_of_unreported;
  if (starts < 1 || !may_fold(model, task)) return {task};
  RestSearches out{task};
  fold(out, model, starts);
  return out;
}

/// Of the evaluations from rest, what another search of a taut limit may have, and what any may.
constexpr long allowed = 4, always_allowed = 500'000;

/// Whether another of the tasks is within |by| degrees on the side that `by` is on. Directions are lines.
bool has_company(const LimitTask& task, const std::vector<LimitTask>& tasks, double by)
{
  return std::any_of(tasks.begin(), tasks.end(), [&](const LimitTask& o) {
    if (!o.direction.is_angle() || o.sense != task.sense) return false;
    const double to = std::remainder(o.direction.degrees() - task.direction.degrees(), 180.0);
    return to * by > 0.0 && std::abs(to) <= std::abs(by) + 1e-9;
  });
}

/// `entry` behind those that are there, unless its limit is among them or links do not bound it.
void add(std::vector<RestSearches>& searches, const Model& model, const RestSearches& entry)
{
  const LimitTask& task = entry.task;
  const bool there = std::any_of(searches.begin(), searches.end(), [&](const RestSearches& s) {
    return s.task.sense == task.sense && on_one_line(s.task.direction, task.direction);
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
    const bool one_axis = model.load->bends() && model.load->periodic();
    return one_axis || !task.direction.is_angle() || bounded_by_links(model, task) != Boundedness::attained;
  };
  const auto add_beside = [&](const LimitTask& task, double by, bool sparing) {
    for (const double angle : {-by, by}) {
      if (has_company(task, tasks, angle)) continue;
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
