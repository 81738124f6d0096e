#include "cylinder_roll.hpp"

#include "common/fields.hpp"

namespace hauberk {

void cylinder_roll_fields(std::vector<Field>& out)
{
  out.push_back(hold_field(
      {"places", "twist", "transverse"},
      "places: every element stays where it is along the sheet; twist, transverse: n^T K m, m^T K m of the "
      "curvature K are zero.",
      "What is held at a limit; n is along the load, m across it. With twist and transverse the patch is on a "
      "cylinder. places hold along components, too, the others along angles only.",
      "[\"twist\", \"transverse\"]"));
  out.push_back(off_roll_field());
}

std::unique_ptr<LoadCase> make_cylinder_roll(const Node& section, double /*length*/, Problems& /*problems*/)
{
  CylinderRoll::Hold hold{false, false, false};
  for (const Node& name : section.at("hold").items) {
    (name.string == "places" ? hold.places : name.string == "twist" ? hold.twist : hold.transverse) = true;
  }
  return std::make_unique<CylinderRoll>(hold, section.at("out_of_plane").is(Node::Type::string));
}

}  // namespace hauberk
