#include "in_plane_periodic.hpp"

#include <utility>

namespace hauberk {

void in_plane_periodic_fields(std::vector<Field>& out)
{
  Field measure;
  measure.name = "measure";
  measure.kind = Field::Kind::choice;
  measure.doc =
      "Reported value: tensor is n^T eps n; equation_12 is (d . eps)/(d . d) with d = (c^2, s^2, c s), "
      "equation (12) of the paper read literally, which goes with hold [].";
  measure.default_json = "\"tensor\"";
  measure.choices = {"tensor", "equation_12"};
  out.push_back(std::move(measure));

  Field held;
  held.kind = Field::Kind::choice;
  held.doc = "shear: n^T eps m = 0, so that principal axes stay at the load; lateral: m^T eps m = 0.";
  held.choices = {"shear", "lateral"};
  Field hold;
  hold.name = "hold";
  hold.kind = Field::Kind::list;
  hold.doc =
      "Strains that are zero at the limits of directions_deg; n is along the load, m across it. Limits along "
      "components (directions) hold nothing.";
  hold.default_json = "[\"shear\"]";
  hold.max_items = 2;
  hold.children = {std::move(held)};
  out.push_back(std::move(hold));

  Field height;
  height.kind = Field::Kind::number;
  height.doc = "Half-height of the layer around their height at rest that elements may not leave.";
  height.unit = "length";
  height.minimum = 0.0;
  Field free;
  free.kind = Field::Kind::choice;
  free.doc = "Nothing keeps elements in the plane.";
  free.choices = {"free"};
  Field out_of_plane;
  out_of_plane.name = "out_of_plane";
  out_of_plane.kind = Field::Kind::any_of;
  out_of_plane.doc = "How far elements may leave the plane, after removing the mean; 0 fixes z.";
  out_of_plane.default_json = "0";
  out_of_plane.children = {std::move(height), std::move(free)};
  out.push_back(std::move(out_of_plane));
}

std::unique_ptr<LoadCase> make_in_plane_periodic(const Node& section, double length, Problems& /*problems*/)
{
  const StrainMeasure measure =
      section.at("measure").string == "equation_12" ? StrainMeasure::equation_12 : StrainMeasure::tensor;
  const Node& height = section.at("out_of_plane");
  InPlanePeriodic::OutOfPlane out_of_plane;
  out_of_plane.free = height.is(Node::Type::string);
  if (!out_of_plane.free) out_of_plane.half_height = height.number / length;
  InPlanePeriodic::Hold hold{false, false};
  for (const Node& name : section.at("hold").items)
    (name.string == "shear" ? hold.shear : hold.lateral) = true;
  return std::make_unique<InPlanePeriodic>(measure, out_of_plane, hold);
}

}  // namespace hauberk
