#include "strip_roll.hpp"

#include "common/fields.hpp"

namespace hauberk {

void strip_roll_fields(std::vector<Field>& out)
{
  out.push_back(hold_field({"places"}, "places: every element stays where it is along the sheet.",
                           "What is held at a limit.", "[]"));
  out.push_back(off_roll_field());
}

std::unique_ptr<LoadCase> make_strip_roll(const Node& section, double /*length*/, Problems& /*problems*/)
{
  return std::make_unique<StripRoll>(!section.at("hold").items.empty(),
                                     section.at("out_of_plane").is(Node::Type::string));
}

}  // namespace hauberk
