/// The template's optimizer with a defect: it stands between the optimizer and what it works with.

#include "defect.hpp"

#include <hauberk/optimizer.hpp>

#define hauberk_plugin reference_plugin
#include "../../../plugins/template/optimizer/plugin_name.cpp"  // NOLINT(bugprone-suspicious-include)
#undef hauberk_plugin

namespace hauberk::mutants {
namespace {

int shared_runs = 0;

/// The problem as a defective optimizer uses it.
class Misused final : public OptimizationProblem {
 public:
  Misused(OptimizationProblem& problem, const std::string& defect) : problem_(problem), defect_(defect)
  {
    lower_.assign(problem.lower().begin(), problem.lower().end());
    upper_.assign(problem.upper().begin(), problem.upper().end());
    ++shared_runs;
    if (!is("leaves_the_bounds")) return;
    for (double& bound : lower_) bound -= 0.5;
    for (double& bound : upper_) bound += 0.5;
  }

  std::span<const double> lower() const override { return lower_; }
  std::span<const double> upper() const override { return upper_; }
  int constraint_count() const override
  {
    return is("ignores_constraints") ? 0 : problem_.constraint_count();
  }
  Evaluation evaluate(std::span<const double> x, bool want_gradient) override
  {
    if (is("looks_again") && evaluations_++ > 3) problem_.evaluate(x, want_gradient);
    Evaluation e =
        is("swallows_exceptions") ? swallowed(x, want_gradient) : problem_.evaluate(x, want_gradient);
    if (is("takes_failures_for_zero") && !e.ok) return {true, -1.0, std::vector<double>(x.size(), 0.0), ""};
    const double whimsical = whim(defect_, this, x[0]);
    if (is("slow")) wait(0.02);
    for (double& slope : e.gradient) {
      slope *= 1.0 + whimsical;
      if (is("stops_early")) slope *= 1e-5;
      if (is("climbs")) slope *= -1.0;
      if (is("remembers_runs")) slope *= 1.0 + 1e-10 * shared_runs;
    }
    return e;
  }
  int residual_count() const override { return problem_.residual_count(); }
  bool residuals(std::span<const double> x, std::span<double> r, std::span<double> jacobian) override
  {
    return problem_.residuals(x, r, jacobian);
  }
  void constraints(std::span<const double> x, std::span<double> c, std::span<double> jacobian) override
  {
    problem_.constraints(x, c, jacobian);
  }
  double largest_safe_step(std::span<const double> x, std::span<const double> d) override
  {
    const double alpha = problem_.largest_safe_step(x, d);
    if (is("ignores_the_safe_step")) return 1.0;
    return is("goes_a_little_too_far") && alpha < 1.0 ? alpha * 1.001 : alpha;
  }
  void accept(std::span<const double> x) override
  {
    if (!is("forgets_to_accept")) problem_.accept(x);
  }

 private:
  bool is(const char* defect) const { return defect_ == defect; }
  Evaluation swallowed(std::span<const double> x, bool want_gradient)
  {
    try {
      return problem_.evaluate(x, want_gradient);
    } catch (...) {
      return {};
    }
  }

  OptimizationProblem& problem_;
  const std::string& defect_;
  std::vector<double> lower_, upper_;
  int evaluations_ = 0;
};

/// Hears nothing.
class Deaf final : public OptimizerObserver {
 public:
  explicit Deaf(OptimizerObserver& observer) : observer_(observer) {}
  bool on_iterate(const OptimizerIterate& iterate) override
  {
    observer_.on_iterate(iterate);
    return true;
  }

 private:
  OptimizerObserver& observer_;
};

class Mutant final : public Optimizer {
 public:
  Mutant(std::unique_ptr<Optimizer> inner, std::string defect)
      : inner_(std::move(inner)), defect_(std::move(defect))
  {
  }

 protected:
  OptimizerResult do_minimize(OptimizationProblem& problem, std::span<const double> start,
                              OptimizerObserver& observer) const override
  {
    Misused misused(problem, defect_);
    Deaf deaf(observer);
    const int rounding = std::fegetround();
    if (is("rounds_up_meanwhile")) std::fesetround(FE_UPWARD);
    OptimizerResult r = inner_->minimize(misused, start, is("deaf") ? deaf : observer);
    if (is("rounds_up_meanwhile")) std::fesetround(rounding);
    if (is("wrong_value")) r.value -= 1e-3;
    if (is("miscounts")) --r.evaluations;
    if (is("returns_the_start")) r.x.assign(start.begin(), start.end());
    if (is("says_converged")) r.status = "converged";
    if (is("says_infeasible") && problem.constraint_count() > 0) r.status = "infeasible";
    if (is("says_nothing")) r.message.clear();
    if (is("unknown_status")) r.status = "great";
    if (is("result_outside_bounds")) r.x[0] = problem.upper()[0] + 1.0;
    if (is("returns_too_few")) r.x.pop_back();
    return r;
  }

 private:
  bool is(const char* defect) const { return defect_ == defect; }

  std::unique_ptr<Optimizer> inner_;
  std::string defect_;
};

void fields(std::vector<Field>& out)
{
  reference_plugin.fields(out);
  add_defect_field(out);
}

std::unique_ptr<Optimizer> make(const Node& section, Problems& problems)
{
  Node values = without_defect(section);
  const std::string defect = defect_of(section);
  for (auto& [key, value] : values.members) {
    if (defect == "twice_the_" + key) value.number = 2.0 * value.number + 1.0;
  }
  return std::make_unique<Mutant>(reference_plugin.make_optimizer(values, problems), defect);
}

}  // namespace
}  // namespace hauberk::mutants

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::optimizer,
    "mutant_optimizer",
    "1.0",
    "An optimizer with a defect.",
    "none",
    hauberk::mutants::fields,
    nullptr,
    nullptr,
    hauberk::mutants::make};
