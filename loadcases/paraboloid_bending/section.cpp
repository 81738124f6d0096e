#include "paraboloid_bending.hpp"

#include <utility>

namespace hauberk {

void paraboloid_bending_fields(std::vector<Field>& out)
{
  Field held;
  held.kind = Field::Kind::choice;
  held.doc =
      "places: every element's x and y stay at rest; twist, transverse: n^T H m, m^T H m of the curvature H "
      "are zero.";
  held.choices = {"places", "twist", "transverse"};
  Field hold;
  hold.name = "hold";
  hold.kind = Field::Kind::list;
  hold.doc =
      "What is held at a limit; n is along the load, m across it. places hold along components, too, the "
      "others along angles only.";
  hold.default_json = "[]";
  hold.max_items = 3;
  hold.children = {std::move(held)};
  out.push_back(std::move(hold));
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
