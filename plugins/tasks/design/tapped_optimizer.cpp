#include "tasks/design/tapped_optimizer.hpp"

#include "run/interrupt.hpp"

#include <algorithm>
#include <utility>

namespace hauberk {
namespace {

/// An evaluation that was given up ends the minimisation, whatever an optimizer makes of exceptions that it
/// knows.
template <class Question>
auto asked(const Question& question)
{
  try {
    return question();
  } catch (const Interrupted&) {
    throw SearchInterrupted{};
  }
}

void stop_if_interrupted()
{
  if (interrupted()) throw SearchInterrupted{};
}

/// The problem itself, asked only as long as nobody has interrupted.
class InterruptibleProblem final : public OptimizationProblem {
 public:
  explicit InterruptibleProblem(OptimizationProblem& problem) : problem_(problem) {}

  std::span<const double> lower() const override { return problem_.lower(); }
  std::span<const double> upper() const override { return problem_.upper(); }
  int constraint_count() const override { return problem_.constraint_count(); }
  int equality_count() const override { return problem_.equality_count(); }
  Evaluation evaluate(std::span<const double> x, bool want_gradient) override
  {
    stop_if_interrupted();
    return asked([&] { return problem_.evaluate(x, want_gradient); });
  }
  std::vector<Evaluation> evaluate_batch(std::size_t count, std::span<const double> points,
                                         bool want_gradient) override
  {
    // In parts: what one of them has found is kept when the next is not begun any more.
    constexpr std::size_t part = 16;
    const std::size_t n = lower().size();
    if (points.size() != count * n) return problem_.evaluate_batch(count, points, want_gradient);  // refused
    std::vector<Evaluation> found;
    for (std::size_t k = 0; k < count; k += part) {
      stop_if_interrupted();
      const std::size_t here = std::min(part, count - k);
      for (Evaluation& e : asked(
               [&] { return problem_.evaluate_batch(here, points.subspan(k * n, here * n), want_gradient); }))
        found.push_back(std::move(e));
    }
    return found;
  }
  int residual_count() const override { return problem_.residual_count(); }
  bool residuals(std::span<const double> x, std::span<double> r, std::span<double> jacobian) override
  {
    return asked([&] { return problem_.residuals(x, r, jacobian); });
  }
  void constraints(std::span<const double> x, std::span<double> c, std::span<double> jacobian) override
  {
    stop_if_interrupted();
    asked([&] { problem_.constraints(x, c, jacobian); });
  }
  bool hessian_product(std::span<const double> x, double weight, std::span<const double> multipliers,
                       std::span<const double> v, std::span<double> out) override
  {
    stop_if_interrupted();
    return asked([&] { return problem_.hessian_product(x, weight, multipliers, v, out); });
  }
  double largest_safe_step(std::span<const double> x, std::span<const double> d) override
  {
    stop_if_interrupted();
    return asked([&] { return problem_.largest_safe_step(x, d); });
  }
  void accept(std::span<const double> x) override
  {
    asked([&] { problem_.accept(x); });
  }
  std::uint64_t stream() const override { return problem_.stream(); }

 private:
  OptimizationProblem& problem_;
};

class Tap final : public OptimizerObserver {
 public:
  Tap(const DesignProblem* problem, OptimizerObserver& observer, std::optional<int> most_iterations,
      const TappedOptimizer::Seen& seen)
      : problem_(problem), observer_(observer), most_iterations_(most_iterations), seen_(seen)
  {
  }

  bool on_iterate(const OptimizerIterate& iterate) override
  {
    if (problem_ != nullptr) seen_(problem_->current());
    const bool wanted = observer_.on_iterate(iterate);
    reached_ = wanted && most_iterations_ && iterate.iteration >= *most_iterations_;
    return wanted && !reached_;
  }

  bool reached() const { return reached_; }

 private:
  const DesignProblem* problem_;
  OptimizerObserver& observer_;
  std::optional<int> most_iterations_;
  const TappedOptimizer::Seen& seen_;
  bool reached_ = false;
};

}  // namespace

OptimizerResult TappedOptimizer::do_minimize(OptimizationProblem& problem, std::span<const double> start,
                                             OptimizerObserver& observer) const
{
  Tap tap(dynamic_cast<const DesignProblem*>(&problem), observer, most_iterations_, seen_);
  InterruptibleProblem interruptible(problem);
  OptimizerResult result = inner_.minimize(interruptible, start, tap);
  if (tap.reached()) {
    result.status = "iteration_limit";
    result.message = "design.max_iterations was reached";
  }
  return result;
}

}  // namespace hauberk
