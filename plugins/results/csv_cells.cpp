#include "results/csv_cells.hpp"

#include "document/json_text.hpp"
#include "document/plain_text.hpp"

#include <charconv>
#include <string_view>

namespace hauberk::detail {

namespace {

/// Whether a spreadsheet would compute a cell.
bool is_formula(const std::string& text)
{
  if (text.empty() || std::string_view("=+-@\t\r").find(text.front()) == std::string_view::npos) return false;
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error != std::errc() || end != text.data() + text.size();
}

}  // namespace

std::string text_cell(const std::string& text)
{
  const bool formula = is_formula(text);
  const std::string shown = (formula ? "'" : "") + plain_text(text, LineBreaks::kept);
  if (shown.find_first_of(",\"\r\n") == std::string::npos) return shown;
  std::string out = "\"";
  for (const char c : shown) out += c == '"' ? std::string("\"\"") : std::string(1, c);
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
