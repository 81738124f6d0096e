#include "paraboloid_bending.hpp"

#include "common/fields.hpp"

namespace hauberk {

void paraboloid_bending_fields(std::vector<Field>& out)
{
  out.push_back(hold_field(
      {"places", "twist", "transverse"},
      "places: every element's x and y stay at rest; twist, transverse: n^T H m, m^T H m of the curvature H "
      "are zero.",
      "What is held at a limit; n is along the load, m across it. places hold along components, too, the "
      "others along angles only.",
      "[]"));
}

std::unique_ptr<LoadCase> make_paraboloid_bending(const Node& section, double /*length*/,
                                                  Problems& /*problems*/)
{
  ParaboloidBending::Hold hold;
  for (const Node& name : section.at("hold").items) {
    (name.string == "places" ? hold.places : name.string == "twist" ? hold.twist : hold.transverse) = true;
  }
  return std::make_unique<ParaboloidBending>(hold);
}

}  // namespace hauberk
