#include "in_plane_periodic.hpp"

#include "common/fields.hpp"

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
  for (const StrainMeasure m : strain_measures) measure.choices.emplace_back(name_of(m));
  out.push_back(std::move(measure));

  out.push_back(hold_field(
      {"shear", "lateral"},
      "shear: n^T eps m = 0, so that principal axes stay at the load; lateral: m^T eps m = 0.",
      "Strains that are zero at the limits of directions_deg; n is along the load, m across it. Limits along "
      "components (directions) hold nothing.",
      "[\"shear\"]"));

  Field height;
  height.doc = "Half-height of the layer around their height at rest that elements may not leave.";
  height.unit = "length";
  out.push_back(
      out_of_plane_field(std::move(height), "Nothing keeps elements in the plane.",
                         "How far elements may leave the plane, after removing the mean; 0 fixes z."));
}

std::unique_ptr<LoadCase> make_in_plane_periodic(const Node& section, double length, Problems& /*problems*/)
{
  StrainMeasure measure = strain_measures.front();
  for (const StrainMeasure m : strain_measures)
    if (section.at("measure").string == name_of(m)) measure = m;
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
