/// One run of an algorithm of NLopt. Its C code calls back into ours; no exception may pass through it.

#include "adapter.hpp"

#include <hauberk/error.hpp>

#include <nlopt.h>
#include <string>

namespace hauberk {
namespace {

/// NLopt's own limit of a decrease, as part of ours: it looks at one step, not at what is left to gain.
constexpr double own_tolerance = 0.1;
/// Runs from the best point, as long as each pays: walls mislead line searches and models.
constexpr int most_runs = 20;
constexpr double worthwhile_violation = 0.5;

class Handle {
 public:
  Handle(nlopt_algorithm algorithm, unsigned n) : opt_(nlopt_create(algorithm, n))
  {
    if (opt_ == nullptr) throw ComputationError("NLopt: out of memory");
  }
  ~Handle() { nlopt_destroy(opt_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  nlopt_opt get() const { return opt_; }
  void check(nlopt_result result) const
  {
    if (result >= 0) return;
    const char* why = nlopt_get_errmsg(opt_);
    throw ComputationError(std::string("NLopt: ") + (why != nullptr ? why : nlopt_result_to_string(result)));
  }

 private:
  nlopt_opt opt_;
};

/// What callbacks get.
struct Call {
  NloptAdapter* adapter;
  nlopt_opt opt;
  int asked = 0;  ///< values of the objective

  void stop_if_wanted() const
  {
    if (adapter->ended()) nlopt_force_stop(opt);
  }
};

double objective(unsigned /*n*/, const double* z, double* gradient, void* data) noexcept
{
  Call& call = *static_cast<Call*>(data);
  ++call.asked;
  double value = 0.0;
  try {
    value = call.adapter->objective(z, gradient);
  } catch (...) {
    call.adapter->fail(std::current_exception());
  }
  call.stop_if_wanted();
  return value;
}

void constraints_from(Eigen::Index first, unsigned count, const Call& call, const double* z, double* values,
                      double* jacobian) noexcept
{
  try {
    call.adapter->constraints(z, first, count, values, jacobian);
  } catch (...) {
    call.adapter->fail(std::current_exception());
  }
  call.stop_if_wanted();
}

void equations(unsigned m, double* values, unsigned /*n*/, const double* z, double* jacobian,
               void* data) noexcept
{
  constraints_from(0, m, *static_cast<const Call*>(data), z, values, jacobian);
}

void inequalities(unsigned m, double* values, unsigned /*n*/, const double* z, double* jacobian,
                  void* data) noexcept
{
  const Call& call = *static_cast<const Call*>(data);
  constraints_from(call.adapter->equality_count(), m, call, z, values, jacobian);
}

nlopt_algorithm algorithm_of(NloptAlgorithm algorithm, bool constrained)
{
  switch (algorithm) {
    case NloptAlgorithm::slsqp:
      return NLOPT_LD_SLSQP;
    case NloptAlgorithm::mma:
      return NLOPT_LD_MMA;
    case NloptAlgorithm::ccsaq:
      return NLOPT_LD_CCSAQ;
    case NloptAlgorithm::lbfgs:
      return constrained ? NLOPT_AUGLAG : NLOPT_LD_LBFGS;
    case NloptAlgorithm::cobyla:
      return NLOPT_LN_COBYLA;
  }
  return NLOPT_LD_SLSQP;
}

void set_tolerances(const Handle& opt, const NloptSettings& settings)
{
  opt.check(nlopt_set_ftol_abs(opt.get(), own_tolerance * settings.walk.tolerance));
  opt.check(nlopt_set_xtol_abs1(opt.get(), settings.min_step));
  opt.check(nlopt_set_vector_storage(opt.get(), settings.memory));
}

/// How NLopt ended.
struct Ending {
  std::string why = "nothing to do";
  bool failed = false;  ///< it did not even search
};

/// Ends that are none of a search. A method that gives up (line searches at kinks and walls) calls that a
/// failure, too, after more points than its first.
bool is_failure(nlopt_result result, int asked)
{
  return result == NLOPT_INVALID_ARGS || result == NLOPT_OUT_OF_MEMORY ||
         (result == NLOPT_FAILURE && asked < 2);
}

void add_constraints(const Handle& opt, NloptAdapter& adapter, Call& call, double tolerance)
{
  const auto equal = static_cast<unsigned>(adapter.equality_count());
  const auto unequal = static_cast<unsigned>(adapter.constraint_count()) - equal;
  const std::vector<double> tolerances(equal + unequal, tolerance);
  if (equal > 0)
    opt.check(nlopt_add_equality_mconstraint(opt.get(), equal, equations, &call, tolerances.data()));
  if (unequal > 0)
    opt.check(nlopt_add_inequality_mconstraint(opt.get(), unequal, inequalities, &call, tolerances.data()));
}

/// From the accepted point until NLopt ends.
Ending run_once(NloptAdapter& adapter, const NloptSettings& settings)
{
  const auto n = static_cast<unsigned>(adapter.size());
  const auto m = static_cast<unsigned>(adapter.constraint_count());
  const Handle opt(algorithm_of(settings.algorithm, m > 0), n);
  const Handle inner(NLOPT_LD_LBFGS, n);
  Call call{&adapter, opt.get(), 0};
  const Eigen::VectorXd lower = adapter.lower(), upper = adapter.upper();
  opt.check(nlopt_set_lower_bounds(opt.get(), lower.data()));
  opt.check(nlopt_set_upper_bounds(opt.get(), upper.data()));
  opt.check(nlopt_set_min_objective(opt.get(), objective, &call));
  set_tolerances(opt, settings);
  add_constraints(opt, adapter, call, settings.walk.constraint_tolerance);
  if (settings.algorithm == NloptAlgorithm::lbfgs && m > 0) {
    set_tolerances(inner, settings);
    opt.check(nlopt_set_local_optimizer(opt.get(), inner.get()));
  }
  if (settings.algorithm == NloptAlgorithm::cobyla)
    opt.check(nlopt_set_initial_step1(opt.get(), settings.initial_step));
  Eigen::VectorXd z = adapter.position().cwiseMax(lower).cwiseMin(upper);
  double value = 0.0;
  const nlopt_result result = nlopt_optimize(opt.get(), z.data(), &value);
  Ending end{nlopt_result_to_string(result), is_failure(result, call.asked)};
  const char* details = nlopt_get_errmsg(opt.get());
  if (result < 0 && details != nullptr) end.why += std::string(", ") + details;
  return end;
}

}  // namespace

OptimizerTraits NloptOptimizer::traits() const
{
  OptimizerTraits traits;
  traits.thread_safe = true;
  traits.equalities =
      settings_.algorithm != NloptAlgorithm::mma && settings_.algorithm != NloptAlgorithm::ccsaq;
  return traits;
}

OptimizerResult NloptOptimizer::do_minimize(OptimizationProblem& problem, std::span<const double> start,
                                            OptimizerObserver& observer) const
{
  NloptAdapter adapter(problem, settings_, observer, start);
  const Walk& walk = adapter.walk();
  std::string why;
  if (!adapter.begin(why)) return walk.finish("failed", "the start cannot be evaluated: " + why);
  Ending end;
  for (int run = 0; run < most_runs && !adapter.stopped(); ++run) {
    const double before = adapter.merit();
    const double violation = adapter.violation();
    if (adapter.size() > 0) end = run_once(adapter, settings_);
    adapter.rethrow();
    if (adapter.leave_walls()) end.why = "it only asked for points that cannot be reached";
    adapter.restore();
    adapter.differentiate();
    if (end.failed || walk.critical() || walk.infeasible()) break;
    const bool lower = adapter.merit() < before - settings_.walk.tolerance * adapter.unit();
    if (!lower && !(adapter.violation() < worthwhile_violation * violation)) break;
  }
  if (adapter.stopped()) return walk.finish_stopped();
  if (walk.critical())
    return walk.finish("converged", "the conditions of first order hold; NLopt: " + end.why);
  if (end.failed) return walk.finish("failed", "NLopt failed: " + end.why);
  if (walk.infeasible())
    return walk.finish("infeasible",
                       "no small step reduces the violation of the constraints; NLopt: " + end.why);
  return walk.finish("small_step", (walk.blocked() ? "the next step would pass through an intersection"
                                                   : "steps became too small to make progress") +
                                       ("; NLopt: " + end.why));
}

}  // namespace hauberk
