// An optimizer that returns its start after one evaluation, and swallows whatever the evaluation throws if
// its section says {"swallow": true}. With {"throw": true} it throws after the evaluation, with
// {"thread_safe": true} it says that it is that.
#include <hauberk/plugin.hpp>

#include <fmt/format.h>

#include <stdexcept>

namespace hauberk {
namespace {

class Hasty final : public Optimizer {
 public:
  Hasty(bool swallow, bool fail, bool thread_safe) : swallow_(swallow), fail_(fail), thread_safe_(thread_safe)
  {
  }

  OptimizerTraits traits() const override { return {thread_safe_, true, false}; }

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
      // And of what a problem need not have.
      std::vector<double> product(start.size());
      if (problem.hessian_product(start, 1.0, {}, start, product))
        result.message = fmt::format("{} {} {} {}", problem.evaluate_batch(1, start, false)[0].value,
                                     problem.equality_count(), problem.stream(), product[0]);
    } catch (...) {
      if (!swallow_) throw;
    }
    if (fail_) throw std::runtime_error("out of patience");
    return result;
  }

 private:
  bool swallow_, fail_, thread_safe_;
};

void fields(std::vector<Field>&) {}

std::unique_ptr<Optimizer> make(const Node& section, Problems&)
{
  return std::make_unique<Hasty>(section.at("swallow").boolean, section.at("throw").boolean,
                                 section.at("thread_safe").boolean);
}

}  // namespace
}  // namespace hauberk

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin{
    HAUBERK_HANDSHAKE, hauberk::PluginKind::optimizer,
    "hasty_optimizer", "1.0",
    "Evaluates once.", "none",
    hauberk::fields,   nullptr,
    nullptr,           hauberk::make};
