#pragma once
/// Fields of settings that several load cases have.

#include <hauberk/section.hpp>

#include <string>
#include <utility>
#include <vector>

namespace hauberk {

/// `hold`: a list out of `names`, each of which `about_names` explains.
inline Field hold_field(std::vector<std::string> names, std::string about_names, std::string about,
                        std::string default_json)
{
  Field name;
  name.kind = Field::Kind::choice;
  name.doc = std::move(about_names);
  name.choices = std::move(names);
  Field hold;
  hold.name = "hold";
  hold.kind = Field::Kind::list;
  hold.doc = std::move(about);
  hold.default_json = std::move(default_json);
  hold.max_items = name.choices.size();
  hold.children = {std::move(name)};
  return hold;
}

/// `out_of_plane`: a height, 0 by default, or "free".
inline Field out_of_plane_field(Field height, std::string about_free, std::string about)
{
  height.kind = Field::Kind::number;
  height.minimum = 0.0;
  Field free;
  free.kind = Field::Kind::choice;
  free.doc = std::move(about_free);
  free.choices = {"free"};
  Field out;
  out.name = "out_of_plane";
  out.kind = Field::Kind::any_of;
  out.doc = std::move(about);
  out.default_json = "0";
  out.children = {std::move(height), std::move(free)};
  return out;
}

/// The same of a rolled sheet: 0 or "free".
inline Field off_roll_field()
{
  Field height;
  height.doc = "Elements stay on the rolled sheet.";
  height.maximum = 0.0;
  return out_of_plane_field(
      std::move(height), "Nothing keeps elements on the rolled sheet, which is fitted to them.",
      "Whether elements may leave the rolled sheet, which is fitted to them then (free), or stay on it (0).");
}

}  // namespace hauberk
