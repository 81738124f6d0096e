#include "design/rest_path.hpp"

#include "equilibrium/relaxation.hpp"
#include "motion/advancement.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace hauberk {
namespace {

constexpr double smallest_part = 1e-3;
/// Rest states are followed in at most so many parts, each of this share of what is safe.
constexpr int most_rest_parts = 24;
constexpr double most_of_safe = 0.9;
/// Gaps beyond the required ones (L) that the states between keep if they can: the next part is then longer.
constexpr double rest_room = 0.01;
constexpr int rest_iterations = 12;

}  // namespace

const RestPath::End& RestPath::follow(const std::shared_ptr<DesignPoint>& from, const DesignPoint& to)
{
  if (from_ != from || to_ != to.x) {
    end_ = end_of_way(*from, to);
    from_ = from;
    to_ = to.x;
  }
  return end_;
}

RestPath::End RestPath::end_of_way(const DesignPoint& from, const DesignPoint& to) const
{
  const std::vector<DesignVariable>& variables = scene_->design.variables;
  DesignPoint at;
  at.model = from.model;
  at.rest = from.rest;
  at.rest_gaps = from.rest_gaps;
  const Vector change = change_of_variables(from, to);
  End way{0.0, at.rest};
  double longest = 1.0;
  for (int parts = 0; parts < most_rest_parts && way.share < 1.0; ++parts) {
    // Predicted along the response as far as nothing collides, then relaxed.
    const Matrix response = rest_response(at, variables);
    double part = std::min(1.0 - way.share, longest);
    double end = 1.0;
    std::optional<Model> next;
    Vector dy;
    for (double safe = 0.0; safe < 1.0;) {
      if (part < smallest_part) return way;
      end = part < 1.0 - way.share ? way.share + part : 1.0;
      next = intermediate(from, to, variables, end);
      dy = response * (part * change);
      safe = next ? safe_parameter_step(at.model, *next, at.rest, dy, scene_->keep_going) : 0.5;
      if (safe < 1.0) part *= most_of_safe * safe;
    }
    const State predicted = advanced(at.model, at.rest, dy, 1.0);
    longest = 2.0 * part;
    way.share = end;
    const Relaxed r = way.share < 1.0 ? relax(*next, predicted, scene_->rest_target(*next) + rest_room,
                                              Cell::fixed, rest_iterations, scene_->keep_going)
                                      : relax(*next, predicted, scene_->rest_target(*next), Cell::fixed,
                                              most_relaxations, scene_->keep_going);
    const Vector back = difference(*next, predicted, r.state);
    const bool passes = r.moved && largest_safe_step(*next, predicted, back, 0.02).alpha < 1.0;
    at.rest = passes ? predicted : r.state;
    at.model = std::move(*next);
    at.rest_gaps = find_gaps(at.model, at.rest, scene_->rest_target(at.model) + response_range, true);
    way.rest = at.rest;
  }
  return way;
}

}  // namespace hauberk
