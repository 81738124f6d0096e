/// Checks of what optimizers declare (OptimizerTraits), and of batches and Hessians that they may ask for.

#include "checks.hpp"
#include "judge.hpp"
#include "trace.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk::conformance {
namespace {

/// What a run asked for and gave, number by number.
std::vector<double> numbers(const Object& object, KnownProblem k)
{
  const OptimizerResult r = watched(*object.optimizer, k.problem, k.start).result;
  std::vector<double> out;
  for (const VectorXd& x : k.problem.evaluated) out.insert(out.end(), x.begin(), x.end());
  out.insert(out.end(), r.x.begin(), r.x.end());
  out.push_back(r.value);
  return out;
}

/// Points of a batch are evaluated in an order of the problem's own.
void batches(Trial& trial)
{
  const Object object = trial.make();
  for (const char* name : {"rosenbrock_bound", "kinked", "circle"}) {
    std::vector<std::vector<double>> results;
    for (const bool backwards : {false, true}) {
      KnownProblem k = known_problem(name);
      k.problem.backwards = backwards;
      OptimizerResult r;
      try {
        r = watched(*object.optimizer, k.problem, k.start).result;
      } catch (const Skip&) {
        break;  // it takes no constraints
      }
      results.push_back(r.x);
      results.back().push_back(r.value);
    }
    if (results.size() < 2) continue;
    require(same_bits(results[0], results[1]),
            "of '{}', the result depends on the order in which the points of a batch are evaluated: {}", name,
            first_difference(results[0], results[1]));
  }
}

/// The section with this seed.
Object with_seed(Trial& trial, double seed)
{
  Node values = trial.section.values;
  const auto found = std::find_if(values.members.begin(), values.members.end(),
                                  [](const auto& member) { return member.first == "seed"; });
  require(found != values.members.end() && found->second.type == Node::Type::number,
          "it declares itself stochastic and has no field 'seed' that is a number");
  found->second.number = seed;
  Problems problems;
  Object object = trial.make(values, problems);
  require(problems.empty(), "seed = {} is refused", seed);
  return object;
}

KnownProblem with_stream(std::uint64_t stream)
{
  KnownProblem k = known_problem("rosenbrock_bound");
  k.problem.stream_number = stream;
  return k;
}

void seeds(Trial& trial)
{
  constexpr double seed = 7.0;
  if (!trial.make().optimizer->traits().stochastic) skip("it does not declare itself stochastic");
  const std::vector<double> first = numbers(with_seed(trial, seed), with_stream(0));
  const std::vector<double> again = numbers(with_seed(trial, seed), with_stream(0));
  require(same_bits(first, again), "two runs with the same seed differ: {}", first_difference(first, again));
  // One other seed may be so lucky as to give the same run; not all of them.
  bool any = false;
  for (const double other : {8.0, 9.0, 10.0})
    any = any || !same_bits(first, numbers(with_seed(trial, other), with_stream(0)));
  require(any, "it declares itself stochastic, and runs with four seeds are the same");
  const std::vector<double> stream = numbers(with_seed(trial, seed), with_stream(1));
  const std::vector<double> same = numbers(with_seed(trial, seed), with_stream(1));
  require(same_bits(stream, same), "two runs with the same seed and stream differ: {}",
          first_difference(stream, same));
  require(!same_bits(first, stream), "it draws the same numbers for another start (stream 1)");
}

/// Known solutions, with products of the exact Hessian and without.
void hessians(Trial& trial)
{
  constexpr double allowed = 1e-3;
  const Object object = trial.make();
  const bool equalities = object.optimizer->traits().equalities;
  bool any = false;
  for (const char* name : {"quadratic", "rosenbrock", "rosenbrock_bound", "hs71", "hs76", "circle", "hs7",
                           "hs48", "hs71_equation"}) {
    const KnownProblem k = known_problem(name);
    if (k.problem.equality_number > 0 && !equalities) continue;
    OptimizerResult without, with;
    KnownProblem plain = k, offered = k;
    offered.problem.hessian_offered = true;
    try {
      without = watched(*object.optimizer, plain.problem, k.start).result;
      with = watched(*object.optimizer, offered.problem, k.start).result;
    } catch (const Skip&) {
      continue;  // it takes no constraints
    }
    any = any || offered.problem.products > 0;
    if (without.status != "converged") continue;  // what it does not solve is no measure
    for (std::size_t i = 0; i < k.solution.size(); ++i)
      require(std::abs(with.x[i] - without.x[i]) <= allowed * (1.0 + std::abs(without.x[i])),
              "of '{}', x[{}] = {:.9g} without a Hessian, and with one '{}' at {:.9g} ({})", name, i,
              without.x[i], with.status, with.x[i], with.message);
  }
  if (!any) skip("it asks for no products of a Hessian");
}

}  // namespace

void add_declared_checks(std::vector<Check>& out)
{
  const auto add = [&](const char* name, const char* about, void (*function)(Trial&)) {
    out.push_back(of_trial(name, PluginKind::optimizer, about, function));
  };
  add("optimizer.batches", "the order in which the points of a batch are evaluated changes nothing", batches);
  add("optimizer.seeds", "a stochastic one depends on its seed and the problem's stream, and on nothing else",
      seeds);
  add("optimizer.hessians", "products of the exact Hessian lead to the same solution as none", hessians);
}

}  // namespace hauberk::conformance
