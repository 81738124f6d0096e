/// Spectral projected gradients (Birgin, Martinez and Raydan, SIAM J. Optim. 10, 2000): steps along the
/// gradient whose length is that of the secant equation, projected onto the bounds.

#include <hauberk/kit/feasible_walk.hpp>
#include <hauberk/kit/fields.hpp>
#include <hauberk/kit/plugin_table.hpp>

namespace {

using namespace hauberk;

class PluginName final : public Optimizer {
 public:
  PluginName(const kit::FeasibleWalk::Limits& limits, double tolerance)
      : limits_(limits), tolerance_(tolerance)
  {
  }

  OptimizerTraits traits() const override
  {
    OptimizerTraits traits;
    traits.thread_safe = true;  // runs share nothing
    return traits;
  }

 protected:
  OptimizerResult do_minimize(OptimizationProblem& problem, std::span<const double> start,
                              OptimizerObserver& observer) const override
  {
    kit::FeasibleWalk walk(problem, start, observer, limits_);
    double scale = 0.1 / std::max(kit::largest(walk.gradient()), 1e-300);
    while (walk.going()) {
      if (walk.optimality() <= tolerance_ * (1.0 + std::abs(walk.value())))
        return walk.end("converged", "the projected gradient is small");
      std::vector<double> s = walk.x(), y = walk.gradient();
      if (!walk.move(walk.step(scale))) break;
      for (std::size_t i = 0; i < s.size(); ++i) {
        s[i] = walk.x()[i] - s[i];
        y[i] = walk.gradient()[i] - y[i];
      }
      const double sy = kit::dot(s, y);
      scale = std::clamp(sy > 0.0 ? kit::dot(s, s) / sy : 10.0 * scale, 1e-12, 1e12);
    }
    return walk.end();
  }

 private:
  kit::FeasibleWalk::Limits limits_;
  double tolerance_;
};

void fields(std::vector<Field>& out)
{
  out = {kit::integer_field("max_iterations", "1000", 0, 1e6, "Accepted steps after which to stop."),
         kit::integer_field("max_evaluations", "10000", 1, 1e6, "Evaluations after which to stop."),
         kit::number_field("tolerance", "1e-6", 0, 1, "Projected gradient to stop at, over 1 + |value|.")};
}

std::unique_ptr<Optimizer> make(const Node& section, Problems& /*problems*/)
{
  const kit::FeasibleWalk::Limits limits{kit::integer(section, "max_iterations"),
                                         kit::integer(section, "max_evaluations")};
  return std::make_unique<PluginName>(limits, section.at("tolerance").number);
}

}  // namespace

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin =
    hauberk::kit::optimizer_table({"plugin_name", "0.1.0", "Spectral projected gradients.",
                                   "Birgin, Martinez and Raydan, SIAM J. Optim. 10 (2000) 1196"},
                                  fields, make);
