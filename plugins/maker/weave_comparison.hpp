#pragma once
/// What all weaves come to, made of the same rings.

#include "maker/weave_sheet.hpp"

#include <boost/json/array.hpp>

#include <optional>
#include <string>
#include <vector>

namespace hauberk::maker {

/// One weave of these rings: its answers, or why there are none.
struct Compared {
  Weave weave;
  std::optional<Sheet> sheet;
  std::string why_not;
};

/// A table with a line per way of every weave, those with answers first, and a line for each of the others.
std::string comparison_text(const std::vector<Compared>& all, const Question& question);
/// A document per weave: that of sheet_json, or `weave`, `smallest_ratio` and `why_not`.
boost::json::array comparison_json(const std::vector<Compared>& all);

}  // namespace hauberk::maker
