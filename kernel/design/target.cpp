#include "design/target.hpp"

#include <cmath>

namespace hauberk {

std::string to_string(Aim aim)
{
  switch (aim) {
    case Aim::reach:
      break;
    case Aim::no_further:
      return "no_further";
    case Aim::no_nearer:
      return "no_nearer";
  }
  return "reach";
}

std::optional<Aim> aim_named(const std::string& name)
{
  for (const Aim aim : {Aim::reach, Aim::no_further, Aim::no_nearer})
    if (name == to_string(aim)) return aim;
  return std::nullopt;
}

double miss(Aim aim, double target, double value)
{
  const double difference = value - target;
  const double beyond = target < 0.0 ? -difference : difference;  // positive: further than the target
  const bool kept = (aim == Aim::no_further && beyond <= 0.0) || (aim == Aim::no_nearer && beyond >= 0.0);
  return kept ? 0.0 : difference;  // not a number stays what it is
}

double met_share(Aim aim)
{
  constexpr double reached = 0.05, kept = 1e-3;
  return aim == Aim::reach ? reached : kept;
}

bool is_within(double share, Aim aim, double target, double value)
{
  return std::abs(miss(aim, target, value)) <= share * std::abs(target);
}

}  // namespace hauberk
