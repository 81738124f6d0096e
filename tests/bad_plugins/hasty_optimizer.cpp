// An optimizer that returns its start after one evaluation, and swallows whatever the evaluation throws if
// its section says {"swallow": true}. With {"throw": true} it throws after the evaluation.
#include <hauberk/plugin.hpp>

#include <stdexcept>

namespace hauberk {
namespace {

class Hasty final : public Optimizer {
 public:
  Hasty(bool swallow, bool fail) : swallow_(swallow), fail_(fail) {}

 protected:
  OptimizerResult do_minimize(OptimizationProblem& problem, std::span<const double> start,
                              OptimizerObserver&) const override
  {
    OptimizerResult result;
    result.status = "converged";
    result.x.assign(start.begin(), start.end());
    try {
      result.value = problem.evaluate(start, false).value;
      // What it can see of the problem's residuals, for the tests of the guard.
      result.iterations = problem.residual_count();
      std::vector<double> r(result.iterations), J(r.size() * start.size());
      if (!r.empty() && problem.residuals(start, r, J)) result.message = std::to_string(r[0]);
    } catch (...) {
      if (!swallow_) throw;
    }
    if (fail_) throw std::runtime_error("out of patience");
    return result;
  }

 private:
  bool swallow_, fail_;
};

void fields(std::vector<Field>&) {}

std::unique_ptr<Optimizer> make(const Node& section, Problems&)
{
  return std::make_unique<Hasty>(section.at("swallow").boolean, section.at("throw").boolean);
}

}  // namespace
}  // namespace hauberk

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin{
    HAUBERK_HANDSHAKE, hauberk::PluginKind::optimizer,
    "hasty_optimizer", "1.0",
    "Evaluates once.", "none",
    hauberk::fields,   nullptr,
    nullptr,           hauberk::make};
