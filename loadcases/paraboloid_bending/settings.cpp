#include "paraboloid_bending.hpp"

namespace hauberk {

void paraboloid_bending_fields(std::vector<Field>& /*out*/) {}

std::unique_ptr<LoadCase> make_paraboloid_bending(const Node& /*section*/, double /*length*/,
                                                  Problems& /*problems*/)
{
  return std::make_unique<ParaboloidBending>();
}

}  // namespace hauberk
