#include "benchmarks.hpp"
#include "design/design_problem.hpp"
#include "measure.hpp"
#include "tasks/design/design_spec.hpp"

#include <hauberk/error.hpp>

namespace hauberk::bench {
namespace {

/// Change of every variable from one iterate to the next, alternating in sign, as a part of its bounds'
/// width.
constexpr double step_size = 0.01;

DesignProblem design_problem(const Scene& scene)
{
  const Prepared& p = scene.prepared();
  return DesignProblem({p.scene, *p.experiment.load_case, p.experiment.solver.clearance, p.settings,
                        design_spec(p.experiment), 1, [] { return true; }});
}

/// Throws if the design cannot be evaluated.
double evaluated(DesignProblem& problem, const std::vector<double>& x)
{
  const OptimizationProblem::Evaluation e = problem.evaluate(x, true);
  if (!e.ok) throw ComputationError("the design cannot be evaluated: " + e.why);
  return e.value;
}

/// The next design after the current one, as far on the way as nothing collides.
std::vector<double> next_design(DesignProblem& problem, const DesignSpec& design)
{
  std::vector<double> x = problem.current().x, d;
  d.reserve(x.size());
  double size = step_size;
  for (const DesignVariable& v : design.variables) {
    d.push_back(size * (v.upper - v.lower));
    size = -size;
  }
  const double safe = problem.largest_safe_step(x, d);
  if (!(safe > 0.0)) throw ComputationError("no step from the design is safe");
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += safe * d[k];
  return x;
}

/// Evaluates `x` again and again, each time in a problem that has not seen it.
template <class Prepare>
void measure_design(benchmark::State& state, const std::vector<double>& x, const Prepare& prepare)
{
  double objective = 0.0;
  long evaluations = 0;
  measure(state, [&] {
    return [&] {
      state.PauseTiming();
      DesignProblem problem = prepare();
      const long before = problem.evaluations();
      state.ResumeTiming();
      objective = evaluated(problem, x);
      evaluations = problem.evaluations() - before;
    };
  });
  state.counters[counter::evaluations] = static_cast<double>(evaluations);
  state.counters[counter::value] = objective;
}

/// From rest, as the start of a search is.
void measure_first(benchmark::State& state, const Scene& scene)
{
  measure_design(state, design_problem(scene).current().x, [&scene] { return design_problem(scene); });
}

/// From the states of the iterate before, as all others are.
void measure_next(benchmark::State& state, const Scene& scene)
{
  DesignProblem problem = design_problem(scene);
  const std::vector<double> first = problem.current().x;
  evaluated(problem, first);
  problem.accept(first);
  const std::vector<double> next = next_design(problem, design_spec(scene.prepared().experiment));
  measure_design(state, next, [&problem] { return problem; });
}

}  // namespace

void register_designs(Scenes& scenes)
{
  const auto add = [&scenes](const char* name, void (*measured)(benchmark::State&, const Scene&)) {
    enter(name, [&scenes, measured](benchmark::State& state) {
      try {
        measured(state, scenes.at({"share/experiments/paper/chainmail_d.json", {}}));
      } catch (const std::exception& error) {
        state.SkipWithError(error.what());
      }
    });
  };
  add("design/chainmail_d/first", measure_first);
  add("design/chainmail_d/next", measure_next);
}

}  // namespace hauberk::bench
