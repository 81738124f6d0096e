/// The template's optimizer with a defect: it stands between the optimizer and what it works with.

#include "defect.hpp"

#include <hauberk/kit/fields.hpp>
#include <hauberk/optimizer.hpp>

#include <random>

#define hauberk_plugin reference_plugin
#include "../../../plugins/template/optimizer/plugin_name.cpp"  // NOLINT(bugprone-suspicious-include)
#undef hauberk_plugin

namespace hauberk::mutants {
namespace {

int shared_runs = 0;
std::atomic<double> shared_scratch = 0.0;
std::atomic<unsigned> shared_draws = 0;

/// A number in [0, 1) from a seed.
double drawn(std::uint64_t seed) { return static_cast<double>(std::mt19937_64(seed)() >> 11U) * 0x1.0p-53; }

/// The problem as a defective optimizer uses it.
class Misused final : public OptimizationProblem {
 public:
  Misused(OptimizationProblem& problem, const std::string& defect, std::uint64_t seed)
      : problem_(problem), defect_(defect), seed_(seed)
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
  int equality_count() const override { return is("ignores_equalities") ? 0 : problem_.equality_count(); }
  Evaluation evaluate(std::span<const double> x, bool want_gradient) override
  {
    shared_scratch = x[0];
    // Threads meet here, however busy the machine is.
    if (is("shares_scratch") || is("remembers_the_last")) std::this_thread::yield();
    const double scratch = shared_scratch;
    if (is("miscounts_batches")) return in_a_batch(x, want_gradient, 2);
    if (is("residuals_of_a_batch") && problem_.residual_count() > 0) return with_residuals(x, want_gradient);
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
      if (is("shares_scratch") && scratch != x[0]) slope *= 1.0 + 1e-9;
      if (is("draws_without_a_seed")) slope *= 1.0 + 1e-6 * drawn(shared_draws++);
      if (is("forgets_the_stream")) slope *= 1.0 + 1e-6 * drawn(seed_);
      if (is("misled_by_hessians") && knows_hessian(x)) slope *= 1e-5;
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
    accepted_.assign(x.begin(), x.end());
  }

 private:
  bool is(const char* defect) const { return defect_ == defect; }
  /// The point `count` times; a batch is taken for one evaluation.
  Evaluation in_a_batch(std::span<const double> x, bool want_gradient, std::size_t count)
  {
    std::vector<double> rows;
    for (std::size_t k = 0; k < count; ++k) rows.insert(rows.end(), x.begin(), x.end());
    return problem_.evaluate_batch(count, rows, want_gradient).front();
  }
  /// Takes the last point of a batch for the one evaluated last.
  Evaluation with_residuals(std::span<const double> x, bool want_gradient)
  {
    Evaluation e = in_a_batch(x, want_gradient, 2);
    std::vector<double> r(problem_.residual_count()), J(r.size() * x.size());
    problem_.residuals(x, r, J);
    return e;
  }
  bool knows_hessian(std::span<const double> x)
  {
    if (x.size() != accepted_.size() || !std::equal(x.begin(), x.end(), accepted_.begin())) return false;
    const std::vector<double> multipliers(problem_.constraint_count(), 0.0), v(x.size(), 1.0);
    std::vector<double> out(x.size());
    return problem_.hessian_product(x, 1.0, multipliers, v, out);
  }
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
  std::uint64_t seed_;
  std::vector<double> lower_, upper_, accepted_;
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
  Mutant(std::unique_ptr<Optimizer> inner, std::string defect, std::uint64_t seed)
      : inner_(std::move(inner)), defect_(std::move(defect)), seed_(seed)
  {
  }

  OptimizerTraits traits() const override
  {
    OptimizerTraits traits = inner_->traits();
    traits.equalities = is("ignores_equalities");
    traits.stochastic = is("draws_without_a_seed") || is("ignores_its_seed") || is("forgets_the_stream");
    return traits;
  }

 protected:
  OptimizerResult do_minimize(OptimizationProblem& problem, std::span<const double> start,
                              OptimizerObserver& observer) const override
  {
    Misused misused(problem, defect_, seed_);
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
  std::uint64_t seed_;
};

void fields(std::vector<Field>& out)
{
  reference_plugin.fields(out);
  add_defect_field(out);
  out.push_back(kit::integer_field("seed", "1", 0.0, 1e6, "Seed of all draws."));
}

std::unique_ptr<Optimizer> make(const Node& section, Problems& problems)
{
  Node values = without_defect(section);
  const auto seed = static_cast<std::uint64_t>(section.at("seed").number);
  std::erase_if(values.members, [](const auto& member) { return member.first == "seed"; });
  const std::string defect = defect_of(section);
  for (auto& [key, value] : values.members) {
    if (defect == "twice_the_" + key) value.number = 2.0 * value.number + 1.0;
  }
  return std::make_unique<Mutant>(reference_plugin.make_optimizer(values, problems), defect, seed);
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
