#include "strip_roll.hpp"

#include <utility>

namespace hauberk {

void strip_roll_fields(std::vector<Field>& out)
{
  Field held;
  held.kind = Field::Kind::choice;
  held.doc = "places: every element stays where it is along the sheet.";
  held.choices = {"places"};
  Field hold;
  hold.name = "hold";
  hold.kind = Field::Kind::list;
  hold.doc = "What is held at a limit.";
  hold.default_json = "[]";
  hold.max_items = 1;
  hold.children = {std::move(held)};
  out.push_back(std::move(hold));

  Field height;
  height.kind = Field::Kind::number;
  height.doc = "Elements stay on the rolled sheet.";
  height.minimum = height.maximum = 0.0;
  Field free;
  free.kind = Field::Kind::choice;
  free.doc = "Nothing keeps elements on the rolled sheet, which is fitted to them.";
  free.choices = {"free"};
  Field out_of_plane;
  out_of_plane.name = "out_of_plane";
  out_of_plane.kind = Field::Kind::any_of;
  out_of_plane.doc =
      "Whether elements may leave the rolled sheet, which is fitted to them then (free), or stay on it (0).";
  out_of_plane.default_json = "0";
  out_of_plane.children = {std::move(height), std::move(free)};
  out.push_back(std::move(out_of_plane));
}

std::unique_ptr<LoadCase> make_strip_roll(const Node& section, double /*length*/, Problems& /*problems*/)
{
  return std::make_unique<StripRoll>(!section.at("hold").items.empty(),
                                     section.at("out_of_plane").is(Node::Type::string));
}

}  // namespace hauberk
