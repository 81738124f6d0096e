#include "results/aim_json.hpp"

namespace hauberk {

Aim read_aim(const detail::JsonPlace& target)
{
  const auto name = target.find("aim");
  if (!name) return Aim::reach;
  if (const auto aim = aim_named(name->text())) return *aim;
  name->fail("expected reach, no_further or no_nearer");
}

}  // namespace hauberk
