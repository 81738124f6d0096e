#include "results/direction_json.hpp"

#include "results/json_parts.hpp"

#include <vector>

namespace hauberk {

namespace json = boost::json;

void enter_direction(json::object& entry, const Direction& direction)
{
  if (direction.is_angle()) {
    entry["direction_deg"] = detail::number(direction.degrees());
    return;
  }
  entry["direction_deg"] = nullptr;
  json::array& components = entry["direction"].emplace_array();
  for (const double x : direction.components()) components.push_back(detail::number(x));
}

Direction entered_direction(const json::object& entry)
{
  const json::value* components = entry.if_contains("direction");
  if (components == nullptr) return Direction::at_degrees(entry.at("direction_deg").to_number<double>());
  std::vector<double> d;
  for (const json::value& x : components->as_array()) d.push_back(x.to_number<double>());
  return Direction::along(d);
}

}  // namespace hauberk
