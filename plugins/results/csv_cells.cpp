#include "results/csv_cells.hpp"

#include "document/json_text.hpp"

namespace hauberk::detail {

std::string text_cell(const std::string& text)
{
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string number_cell(const std::optional<double>& x)
{
  if (!x) return {};
  const std::string text = number_text(*x);
  return text == "null" ? std::string() : text;
}

std::string direction_cell(const Direction& direction)
{
  if (direction.is_angle()) return number_cell(direction.degrees());
  std::string out;
  for (const double x : direction.components()) out += (out.empty() ? "(" : " ") + number_text(x);
  return out + ')';
}

std::string csv_line(const std::vector<std::string>& cells)
{
  std::string out;
  for (std::size_t i = 0; i < cells.size(); ++i) out += (i == 0 ? "" : ",") + cells[i];
  return out + '\n';
}

}  // namespace hauberk::detail
