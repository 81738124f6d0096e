#include "ipopt_optimizer.hpp"
#include "nlp.hpp"

#include <hauberk/error.hpp>

#include <IpIpoptApplication.hpp>

#include <algorithm>
#include <string>

namespace hauberk {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Ipopt::ApplicationReturnStatus;

/// Ipopt asks for less than we do in the end, so that it does not stop a little too early.
constexpr double own_tolerance = 0.1;
/// Runs from the accepted point, a second one and then as long as each pays: kinks and walls spoil Ipopt's
/// Hessian, and a large barrier pushes it where nothing better is.
constexpr int most_runs = 20;
constexpr double worthwhile_violation = 0.5;
/// A run that begins where another ended stays close to the bounds, with a small barrier.
constexpr double later_push = 1e-6;
constexpr double later_barrier = 1e-4;
/// Parts of the push that are tried, each a quarter of the one before.
constexpr int most_pushes = 8;
/// Variables up to which a Hessian is put together from products.
constexpr Index most_products = 100;
/// Distance from the bounds that Ipopt itself insists on: none beyond ours.
constexpr double no_push = 1e-12;

const char* name(ApplicationReturnStatus status)
{
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return "optimal solution found";
    case Ipopt::Solved_To_Acceptable_Level:
      return "solved to acceptable level";
    case Ipopt::Infeasible_Problem_Detected:
      return "converged to a point of local infeasibility";
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return "search direction becomes too small";
    case Ipopt::Diverging_Iterates:
      return "iterates diverge";
    case Ipopt::User_Requested_Stop:
      return "iterates stay where they are";
    case Ipopt::Restoration_Failed:
      return "restoration failed";
    case Ipopt::Error_In_Step_Computation:
      return "error in step computation";
    case Ipopt::Not_Enough_Degrees_Of_Freedom:
      return "too few degrees of freedom";
    case Ipopt::Invalid_Number_Detected:
      return "a point that cannot be evaluated";
    default:
      return "internal error";
  }
}

void set_options(Ipopt::OptionsList& options, const IpoptSettings& settings, bool first, bool exact)
{
  options.SetIntegerValue("print_level", 0);
  options.SetStringValue("sb", "yes");  // no banner
  options.SetStringValue("hessian_approximation", exact ? "exact" : "limited-memory");
  options.SetIntegerValue("limited_memory_max_history", settings.memory);
  // With limited memory, Ipopt would choose an adaptive barrier, which leads into walls sooner.
  options.SetStringValue("mu_strategy", "monotone");
  options.SetNumericValue("mu_init", first ? settings.barrier : std::min(settings.barrier, later_barrier));
  options.SetNumericValue("tol", std::max(1e-12, own_tolerance * settings.walk.tolerance));
  options.SetNumericValue("constr_viol_tol", 0.5 * settings.walk.constraint_tolerance);
  options.SetIntegerValue("max_iter", 1000000);  // the walk counts
  options.SetIntegerValue("acceptable_iter", 0);
  // Bounds hold at every point that is evaluated, and the start has been moved off them.
  options.SetNumericValue("bound_relax_factor", 0.0);
  options.SetNumericValue("bound_push", no_push);
  options.SetNumericValue("bound_frac", no_push);
  // Both look at derivatives of points that are not kept.
  options.SetIntegerValue("max_soft_resto_iters", 0);
  options.SetIntegerValue("watchdog_shortened_iter_trigger", 0);
}

/// The scaled point next to the accepted one that keeps its distance from the bounds and can be reached, with
/// less distance where it must be; the accepted one where there is none.
VectorXd inside(Walk& walk, double push)
{
  const ScaledProblem& problem = walk.problem();
  const VectorXd z = problem.scaled(walk.accepted().x);
  const VectorXd lower = problem.scaled(problem.lower()), upper = problem.scaled(problem.upper());
  for (int k = 0; k < most_pushes; ++k, push *= 0.25) {
    VectorXd moved = z;
    for (Index i = 0; i < z.size(); ++i) {
      const double margin = push * std::min(1.0, upper[i] - lower[i]);
      moved[i] = std::clamp(z[i], lower[i] + margin, upper[i] - margin);
    }
    if (walk.look(problem.unscaled(moved), true).ok) return moved;
    if (walk.stopped() != Walk::Stop::none) throw IpoptNlp::Stopped();
  }
  return z;
}

/// What came of a run of Ipopt.
struct Ending {
  ApplicationReturnStatus status = Ipopt::Internal_Error;
  bool surprised = false;
  bool lost = false;  ///< the Hessian was not known any more
};

/// Whether the problem knows its Hessian, and there are few enough variables for a product with each of them.
bool knows_hessian(Walk& walk)
{
  Eigen::MatrixXd H;
  return walk.problem().size() <= most_products &&
         walk.hessian(1.0, VectorXd::Zero(walk.problem().constraint_count()), H);
}

Ending run_once(Walk& walk, const IpoptSettings& settings, bool first, bool exact)
{
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt = new Ipopt::IpoptApplication(false);  // no console
  ipopt->RethrowNonIpoptException(true);
  set_options(*ipopt->Options(), settings, first, exact);
  if (ipopt->Initialize("") != Ipopt::Solve_Succeeded)  // no file of options
    throw ComputationError("Ipopt does not accept its options");
  const VectorXd start = inside(walk, first ? settings.push : std::min(settings.push, later_push));
  const Ipopt::SmartPtr<IpoptNlp> nlp = new IpoptNlp(walk, start, settings, exact);
  Ending end;
  end.status = ipopt->OptimizeTNLP(GetRawPtr(nlp));
  end.surprised = nlp->surprised();
  end.lost = nlp->lost_hessian();
  return end;
}

bool any_free(const ScaledProblem& problem)
{
  return (problem.lower().array() < problem.upper().array()).any();
}

/// Runs Ipopt as long as each run pays, and says how the last one ended.
std::string search(Walk& walk, const IpoptSettings& settings)
{
  std::string why = "nothing to do";
  bool exact = knows_hessian(walk);
  for (int run = 0; run < most_runs && any_free(walk.problem()); ++run) {
    const int iterations = walk.iterations();
    const double value = walk.accepted().value;
    const double violation = largest_violation(walk.accepted().at);
    const Ending end = run_once(walk, settings, run == 0, exact);
    why = name(end.status);
    exact = exact && !end.lost;
    walk.restore();
    if (walk.critical() || walk.infeasible()) break;
    const bool lower = walk.accepted().value < value - settings.walk.tolerance * walk.unit();
    const bool nearer = largest_violation(walk.accepted().at) < worthwhile_violation * violation;
    const bool last = run > 0 || walk.iterations() == iterations;
    if (last && !lower && !nearer && !end.surprised && !end.lost) break;
    if (!lower && !nearer) walk.return_to_best();
  }
  return why;
}

}  // namespace

OptimizerResult IpoptOptimizer::do_minimize(OptimizationProblem& problem, std::span<const double> start,
                                            OptimizerObserver& observer) const
{
  Walk walk(problem, settings_.walk, observer, start);
  std::string why;
  if (!walk.begin(true, why)) return walk.finish("failed", "the start cannot be evaluated: " + why);
  if (walk.stopped() != Walk::Stop::none) return walk.finish_stopped();
  try {
    why = search(walk, settings_);
  } catch (const IpoptNlp::Stopped&) {
  }
  if (walk.stopped() != Walk::Stop::none) return walk.finish_stopped();
  if (walk.critical()) return walk.finish("converged", "the conditions of first order hold; Ipopt: " + why);
  if (walk.infeasible())
    return walk.finish("infeasible", "no small step reduces the violation of the constraints; Ipopt: " + why);
  return walk.finish("small_step", (walk.blocked() ? "the next step would pass through an intersection"
                                                   : "steps became too small to make progress") +
                                       ("; Ipopt: " + why));
}

}  // namespace hauberk
