#include "maximise.hpp"

#include <utility>

namespace hauberk::conformance {

std::vector<double> maximise(const std::function<double(const std::vector<double>&)>& f,
                             std::vector<double> x, std::vector<double> step, int sweeps)
{
  double best = f(x);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    bool gained = false;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double before = x[k];
      for (const double moved : {before + step[k], before - step[k]}) {
        x[k] = moved;
        const double value = f(x);
        if (value > best || (best != best && value == value)) {
          best = value;
          gained = true;
          break;
        }
        x[k] = before;
      }
    }
    if (gained) continue;
    for (double& s : step) s *= 0.5;
  }
  return x;
}

}  // namespace hauberk::conformance
