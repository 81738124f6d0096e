/// Nelder and Mead's simplex search, in one file that needs nothing but the installed headers: an example of
/// an optimizer from outside, and a check of the others that uses no derivatives.

#include <hauberk/kit/fields.hpp>
#include <hauberk/kit/plugin_table.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace {

using Point = std::vector<double>;

struct Settings {
  int max_iterations, max_evaluations;
  double initial_step, min_step, constraint_tolerance;
};

/// A corner of the simplex. Feasible ones come before others, then the lower value or the smaller violation
/// counts (Deb 2000).
struct Corner {
  Point x;
  double value = std::numeric_limits<double>::infinity();
  double violation = std::numeric_limits<double>::infinity();

  bool operator<(const Corner& o) const
  {
    return violation != o.violation ? violation < o.violation : value < o.value;
  }
};

class Search {
 public:
  Search(hauberk::OptimizationProblem& problem, const Settings& settings,
         hauberk::OptimizerObserver& observer, std::span<const double> start)
      : problem_(problem), settings_(settings), observer_(observer), accepted_{{start.begin(), start.end()}}
  {
    for (std::size_t i = 0; i < start.size(); ++i) {
      const double lower = problem.lower()[i], upper = problem.upper()[i];
      if (lower == upper) continue;
      free_.push_back(i);
      const double range = upper - lower;
      widths_.push_back(std::isfinite(range) ? range : std::max(1.0, std::abs(start[i])));
    }
  }

  hauberk::OptimizerResult run()
  {
    Corner start = evaluate(accepted_.x);
    if (!std::isfinite(start.value)) return result("failed", "the start cannot be evaluated");
    accept(start);
    if (!observed(0.0)) return result("stopped", "stopped by the observer");
    if (settings_.max_iterations == 0) return result("iteration_limit", "ended by max_iterations");
    double step = settings_.initial_step;
    // Again from where it ended, until that gains nothing: a simplex may collapse on a bound.
    for (;;) {
      const Corner before = accepted_;
      if (!descend(step)) return result(status_, message_);
      const double gain = before.value - accepted_.value;
      if (before.violation <= accepted_.violation && gain <= 1e-9 * (1.0 + std::abs(accepted_.value))) break;
      step = std::max(0.1 * step, 1e3 * settings_.min_step);
    }
    return result("small_step", "the simplex is small, and another one from there found nothing better");
  }

 private:
  /// One simplex of this size until it is small; false: stopped, or a budget is used up.
  bool descend(double step)
  {
    const std::size_t n = free_.size();
    std::vector<Corner> simplex(n + 1, accepted_);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = free_[k];
      const double by = step * widths_[k];
      double& x = simplex[k + 1].x[i];
      x += x + by <= problem_.upper()[i] ? by : -by;
    }
    if (!try_all_but_the_first(simplex)) return false;
    for (;;) {
      std::stable_sort(simplex.begin(), simplex.end());
      while (simplex.front() < accepted_) {
        if (iterations_ >= settings_.max_iterations) return over("iteration_limit", "max_iterations");
        const bool taken = accept(simplex.front());
        std::stable_sort(simplex.begin(), simplex.end());
        if (!taken && !budget()) return false;
        if (!taken) continue;
        ++iterations_;
        if (!observed(size(simplex))) return over("stopped", "the observer");
        break;
      }
      if (size(simplex) < settings_.min_step) return true;
      if (!improve(simplex)) return false;
    }
  }

  /// Reflection, expansion, contraction or shrinkage; false when the budget is used up.
  bool improve(std::vector<Corner>& simplex)
  {
    Corner& worst = simplex.back();
    const Corner &best = simplex.front(), &second = simplex.size() > 1 ? simplex[simplex.size() - 2] : best;
    Point centre(worst.x.size(), 0.0);
    const double share = 1.0 / std::max<double>(1.0, static_cast<double>(simplex.size()) - 1.0);
    for (std::size_t c = 0; c + 1 < simplex.size(); ++c)
      for (std::size_t i = 0; i < centre.size(); ++i) centre[i] += share * simplex[c].x[i];
    const auto along = [&](double t) {
      Point x = centre;
      for (const std::size_t i : free_) x[i] += t * (worst.x[i] - centre[i]);
      return tried(x);
    };
    if (!budget()) return false;
    const Corner reflected = along(-1.0);
    if (reflected < best) {
      if (!budget()) return false;
      const Corner expanded = along(-2.0);
      worst = expanded < reflected ? expanded : reflected;
      return true;
    }
    if (reflected < second) {
      worst = reflected;
      return true;
    }
    if (!budget()) return false;
    const bool outside = reflected < worst;
    const Corner contracted = along(outside ? -0.5 : 0.5);
    if (contracted < (outside ? reflected : worst)) {
      worst = contracted;
      return true;
    }
    for (std::size_t c = 1; c < simplex.size(); ++c)
      for (const std::size_t i : free_) simplex[c].x[i] = 0.5 * (simplex[c].x[i] + simplex[0].x[i]);
    return try_all_but_the_first(simplex);
  }

  /// What `tried` says of all corners but the first, which do not depend on each other; false when the budget
  /// does not suffice for all.
  bool try_all_but_the_first(std::vector<Corner>& simplex)
  {
    std::vector<Corner*> asked;
    std::vector<double> rows;
    for (std::size_t c = 1; c < simplex.size(); ++c) {
      Corner& corner = simplex[c];
      corner = {within(corner.x)};
      if (corner.x == accepted_.x) {
        corner = accepted_;
      } else if (reachable(corner.x)) {
        asked.push_back(&corner);
        rows.insert(rows.end(), corner.x.begin(), corner.x.end());
      }
    }
    const std::size_t all = asked.size();
    asked.resize(std::min(all, static_cast<std::size_t>(settings_.max_evaluations - evaluations_)));
    rows.resize(asked.size() * accepted_.x.size());
    if (asked.empty()) return all == 0 || budget();
    evaluations_ += static_cast<int>(asked.size());
    const auto found = problem_.evaluate_batch(asked.size(), rows, false);
    last_.clear();
    for (std::size_t k = 0; k < asked.size(); ++k) {
      last_.push_back(asked[k]->x);
      *asked[k] = corner_of(asked[k]->x, found[k]);
    }
    return asked.size() == all || budget();
  }

  /// A point within the bounds, evaluated if the straight way to it from the last iterate is free; else worse
  /// than all others.
  Corner tried(const Point& anywhere)
  {
    const Point x = within(anywhere);
    if (x == accepted_.x) return accepted_;
    return reachable(x) ? evaluate(x) : Corner{x};
  }

  Point within(Point x) const
  {
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = std::clamp(x[i], problem_.lower()[i], problem_.upper()[i]);
    return x;
  }

  bool reachable(const Point& x)
  {
    Point way(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) way[i] = x[i] - accepted_.x[i];
    return problem_.largest_safe_step(accepted_.x, way) >= 1.0;
  }

  bool latest(const Point& x) const { return std::find(last_.begin(), last_.end(), x) != last_.end(); }

  Corner evaluate(const Point& x)
  {
    if (last_ != std::vector<Point>{x}) ++evaluations_;  // asking again costs nothing
    last_ = {x};
    return corner_of(x, problem_.evaluate(x, false));
  }

  Corner corner_of(const Point& x, const hauberk::OptimizationProblem::Evaluation& evaluation)
  {
    if (!evaluation.ok || !std::isfinite(evaluation.value)) return {x};
    return {x, evaluation.value, violation(x)};
  }

  double violation(const Point& x)
  {
    if (problem_.constraint_count() == 0) return 0.0;
    std::vector<double> c(problem_.constraint_count());
    problem_.constraints(x, c, {});
    double worst = 0.0;
    for (const double value : c) worst = std::max(worst, -value);
    return worst <= settings_.constraint_tolerance ? 0.0 : worst;
  }

  /// Makes it the iterate. A problem takes only what it evaluated last, one point or a batch; its value may
  /// change when it is looked at more closely, so it is asked for again.
  /// False where it cannot be: the budget is used up, or the way to it from the iterate is no longer free.
  bool accept(Corner& corner)
  {
    if (!latest(corner.x)) {
      if (!budget()) return false;
      const Corner again = tried(corner.x);
      if (!std::isfinite(again.value)) {
        corner = again;
        return false;
      }
    }
    problem_.accept(corner.x);
    last_ = {corner.x};
    accepted_ = corner;
    if (!budget()) return true;
    const Corner again = evaluate(corner.x);
    if (std::isfinite(again.value)) accepted_ = corner = again;
    return true;
  }

  /// Largest distance of a corner from the best one, in widths.
  double size(const std::vector<Corner>& simplex) const
  {
    double most = 0.0;
    for (const Corner& corner : simplex)
      for (std::size_t k = 0; k < free_.size(); ++k)
        most = std::max(most, std::abs(corner.x[free_[k]] - simplex.front().x[free_[k]]) / widths_[k]);
    return most;
  }

  bool budget()
  {
    if (evaluations_ < settings_.max_evaluations) return true;
    return over("iteration_limit", "max_evaluations");
  }

  bool over(const char* status, const char* what)
  {
    status_ = status;
    message_ = std::string("ended by ") + what;
    return false;
  }

  bool observed(double step)
  {
    return observer_.on_iterate({iterations_, accepted_.value, step, accepted_.violation, 0.0, accepted_.x});
  }

  hauberk::OptimizerResult result(std::string status, std::string message) const
  {
    if (accepted_.violation > 0.0 && status == "small_step")
      message += "; constraints are violated by " + std::to_string(accepted_.violation);
    return {std::move(status), std::move(message), accepted_.x, accepted_.value, iterations_, evaluations_};
  }

  hauberk::OptimizationProblem& problem_;
  Settings settings_;
  hauberk::OptimizerObserver& observer_;
  Corner accepted_;
  std::vector<Point> last_;        ///< evaluated last: one, or a batch
  std::vector<std::size_t> free_;  ///< variables whose bounds differ
  std::vector<double> widths_;     ///< of these
  int iterations_ = 0, evaluations_ = 0;
  const char* status_ = "";
  std::string message_;
};

class NelderMead final : public hauberk::Optimizer {
 public:
  explicit NelderMead(const Settings& settings) : settings_(settings) {}
  hauberk::OptimizerTraits traits() const override
  {
    hauberk::OptimizerTraits traits;
    traits.thread_safe = true;
    return traits;
  }

 protected:
  hauberk::OptimizerResult do_minimize(hauberk::OptimizationProblem& problem, std::span<const double> start,
                                       hauberk::OptimizerObserver& observer) const override
  {
    return Search(problem, settings_, observer, start).run();
  }

 private:
  Settings settings_;
};

void fields(std::vector<hauberk::Field>& out)
{
  using hauberk::kit::integer_field, hauberk::kit::number_field;
  out = {
      integer_field("max_iterations", "5000", 0, 1e9, "Better points after which to stop."),
      integer_field("max_evaluations", "10000", 1, 1e9, "Evaluations of the objective after which to stop."),
      number_field("initial_step", "0.1", 1e-6, 1, "Size of the first simplex, in parts of the bounds."),
      number_field("min_step", "1e-8", 1e-15, 1, "Size of a simplex that is small."),
      number_field("constraint_tolerance", "1e-8", 0, 1, "Violation of a constraint that counts as none.")};
}

std::unique_ptr<hauberk::Optimizer> make(const hauberk::Node& section, hauberk::Problems&)
{
  using hauberk::kit::integer;
  const auto number = [&section](const char* name) { return section.at(name).number; };
  return std::make_unique<NelderMead>(Settings{integer(section, "max_iterations"),
                                               integer(section, "max_evaluations"), number("initial_step"),
                                               number("min_step"), number("constraint_tolerance")});
}

}  // namespace

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = hauberk::kit::optimizer_table(
    {"nelder_mead", "0.1.0", "Simplex search without derivatives, for few variables.",
     "Nelder and Mead, The Computer Journal 7 (1965); feasible points first: Deb 2000"},
    fields, make);
