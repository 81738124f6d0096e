#include "limit_cases.hpp"

namespace hauberk::brute {

std::vector<LimitResult> limits(const SceneSpec& scene, const std::vector<LimitTask>& tasks,
                                const LimitSettings& settings, double clearance, unsigned threads)
{
  const test::Sheet sheet(2);
  const Model m = make_model(scene, sheet, clearance);
  return compute_limits(m, scene, tasks, settings, threads);
}

LimitResult limit(const SceneSpec& scene, double direction, Sense sense, const LimitSettings& settings,
                  double clearance)
{
  return limits(scene, {{Direction::at_degrees(direction), sense}}, settings, clearance).front();
}

LimitSettings fast_settings()
{
  LimitSettings s;
  s.schedule.last = 1e-3;
  return s;
}

SceneSpec slack_chain(const std::array<double, 3>& first, const std::array<double, 3>& second)
{
  return test::chain(first, second, 0.95 * 2.0 * (first[0] + second[0] - first[1] - second[1]));
}

}  // namespace hauberk::brute
