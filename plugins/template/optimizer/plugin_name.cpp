/// Spectral projected gradients (Birgin, Martinez and Raydan, SIAM J. Optim. 10, 2000): steps along the
/// gradient whose length is that of the secant equation, projected onto the bounds. Trials that violate a
/// constraint are treated like those that cannot be evaluated, so it needs a start that satisfies them, and
/// stops where it meets one.

#include <hauberk/plugin.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>

namespace {

using namespace hauberk;
using Vector = std::vector<double>;

struct Settings {
  int max_iterations, max_evaluations;
  double tolerance;
};

double dot(const Vector& a, const Vector& b)
{
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

double largest(const Vector& a)
{
  return std::accumulate(a.begin(), a.end(), 0.0,
                         [](double m, double v) { return std::max(m, std::abs(v)); });
}

/// One run.
class Search {
 public:
  Search(OptimizationProblem& problem, const Settings& settings, OptimizerObserver& observer)
      : problem_(problem), settings_(settings), observer_(observer)
  {
  }

  OptimizerResult run(Vector start)
  {
    x_ = best_ = std::move(start);
    if (violation(x_) > feasible)
      return end("failed", "the start violates the constraints, and this method begins where they hold");
    OptimizationProblem::Evaluation here = evaluate(x_);
    if (!here.ok) return end("failed", "the start cannot be evaluated: " + here.why);
    best_value_ = here.value;
    if (!take(here, 0.0)) return end("stopped", "stopped by the observer");

    double scale = 0.1 / std::max(largest(gradient_), 1e-300);
    while (true) {
      if (optimality() <= settings_.tolerance * (1.0 + std::abs(value_)))
        return end("converged", "the projected gradient is small");
      if (iterations_ >= settings_.max_iterations)
        return end("iteration_limit", fmt::format("stopped after {} iterations", iterations_));
      const Vector from = x_, slope = gradient_, d = step(scale);
      const std::string obstacle = search(d);
      if (!obstacle.empty())
        return end(obstacle == "stopped" || obstacle == "iteration_limit" ? obstacle : "small_step",
                   obstacle);
      Vector s(d.size()), y(d.size());
      for (std::size_t i = 0; i < d.size(); ++i) {
        s[i] = x_[i] - from[i];
        y[i] = gradient_[i] - slope[i];
      }
      scale = dot(s, y) > 0.0 ? dot(s, s) / dot(s, y) : 10.0 * scale;
      scale = std::clamp(scale, 1e-12, 1e12);
    }
  }

 private:
  static constexpr double feasible = 1e-8, armijo = 1e-4, shortest = 1e-12;
  static constexpr std::size_t memory = 8;  ///< values that the next one must be below one of

  double violation(const Vector& x)
  {
    if (problem_.constraint_count() == 0) return 0.0;
    Vector c(static_cast<std::size_t>(problem_.constraint_count()));
    problem_.constraints(x, c, {});
    return std::max(0.0, -*std::min_element(c.begin(), c.end()));
  }

  OptimizationProblem::Evaluation evaluate(const Vector& x)
  {
    ++evaluations_;
    OptimizationProblem::Evaluation e = problem_.evaluate(x, true);
    const auto finite = [](double v) { return std::isfinite(v); };
    if (e.ok && !(finite(e.value) && std::all_of(e.gradient.begin(), e.gradient.end(), finite))) {
      e.ok = false;
      e.why = "it is not finite";
    }
    return e;
  }

  /// Makes x_ the iterate; false when the observer stops.
  bool take(OptimizationProblem::Evaluation here, double length)
  {
    problem_.accept(x_);
    OptimizationProblem::Evaluation seen = problem_.evaluate(x_, true);  // may have changed; costs nothing
    if (seen.ok && std::isfinite(seen.value)) here = std::move(seen);
    value_ = here.value;
    gradient_ = std::move(here.gradient);
    if (value_ <= best_value_) {
      best_ = x_;
      best_value_ = value_;
    }
    recent_.push_back(value_);
    if (recent_.size() > memory) recent_.pop_front();
    return observer_.on_iterate({iterations_, value_, length, 0.0, optimality(), x_});
  }

  /// P(x - scale gradient) - x
  Vector step(double scale) const
  {
    Vector d(x_.size());
    for (std::size_t i = 0; i < d.size(); ++i)
      d[i] = std::clamp(x_[i] - scale * gradient_[i], problem_.lower()[i], problem_.upper()[i]) - x_[i];
    return d;
  }
  double optimality() const { return largest(step(1.0)); }

  /// Moves x_ along d to a point that is good enough. Returns what was in the way, nothing when it moved.
  std::string search(const Vector& d)
  {
    // Nothing may be evaluated beyond what is safe; 0 and not-a-number end the run.
    double alpha = problem_.largest_safe_step(x_, d);
    const double bar = *std::max_element(recent_.begin(), recent_.end());
    while (alpha * largest(d) > shortest * (1.0 + largest(x_))) {
      Vector x(d.size());
      for (std::size_t i = 0; i < d.size(); ++i)
        x[i] = std::clamp(x_[i] + alpha * d[i], problem_.lower()[i], problem_.upper()[i]);
      if (violation(x) <= feasible) {
        if (evaluations_ >= settings_.max_evaluations) return "iteration_limit";
        const OptimizationProblem::Evaluation there = evaluate(x);
        if (there.ok && there.value <= bar + armijo * alpha * dot(gradient_, d)) {
          x_ = x;
          ++iterations_;
          return take(there, alpha) ? "" : "stopped";
        }
      }
      alpha *= 0.4;
    }
    return "no step that is safe, allowed and better was found";
  }

  OptimizerResult end(const std::string& status, const std::string& message) const
  {
    return {status, message, best_, best_value_, iterations_, evaluations_};
  }

  OptimizationProblem& problem_;
  Settings settings_;
  OptimizerObserver& observer_;
  Vector x_, gradient_, best_;
  double value_ = 0.0, best_value_ = 0.0;
  std::deque<double> recent_;
  int iterations_ = 0, evaluations_ = 0;
};

class PluginName final : public Optimizer {
 public:
  explicit PluginName(const Settings& settings) : settings_(settings) {}

 protected:
  OptimizerResult do_minimize(OptimizationProblem& problem, std::span<const double> start,
                              OptimizerObserver& observer) const override
  {
    return Search(problem, settings_, observer).run({start.begin(), start.end()});
  }

 private:
  Settings settings_;
};

Field number(std::string name, Field::Kind kind, double minimum, std::string default_json, std::string doc)
{
  Field field;
  field.name = std::move(name);
  field.kind = kind;
  field.minimum = minimum;
  field.maximum = 1e6;
  field.default_json = std::move(default_json);
  field.doc = std::move(doc);
  return field;
}

void fields(std::vector<Field>& out)
{
  const auto integer = Field::Kind::integer;
  out.push_back(number("max_iterations", integer, 0, "1000", "Accepted steps after which to stop."));
  out.push_back(number("max_evaluations", integer, 1, "10000", "Evaluations after which to stop."));
  out.push_back(number("tolerance", Field::Kind::number, 0, "1e-6",
                       "Largest component of the projected gradient at which to stop, over 1 + |value|."));
}

std::unique_ptr<Optimizer> make(const Node& section, Problems& /*problems*/)
{
  return std::make_unique<PluginName>(Settings{static_cast<int>(section.at("max_iterations").number),
                                               static_cast<int>(section.at("max_evaluations").number),
                                               section.at("tolerance").number});
}

}  // namespace

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::optimizer,
    "plugin_name",
    "0.1.0",
    "Spectral projected gradients.",
    "Birgin, Martinez and Raydan, SIAM J. Optim. 10 (2000) 1196",
    fields,
    nullptr,
    nullptr,
    make,
};
