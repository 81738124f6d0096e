#include "maker/wire_length.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

namespace hauberk::maker {
namespace {

constexpr double inch = 25.4;

/// Thousandths of an inch of the gauges 0 to 30.
constexpr std::array<double, 31> standard_wire{324, 300, 276, 252, 232, 212,  192,  176,  160, 144, 128,
                                               116, 104, 92,  80,  72,  64,   56,   48,   40,  36,  32,
                                               28,  24,  22,  20,  18,  16.4, 14.8, 13.6, 12.4};
/// Of 2/0 to 7/0.
constexpr std::array<double, 6> thick_standard_wire{348, 372, 400, 432, 464, 500};

std::optional<double> number_in(const std::string& text)
{
  double x = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), x);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size() || !std::isfinite(x))
    return std::nullopt;
  return x;
}

/// "1.5", or "5/16" as a fraction.
std::optional<double> quantity_in(const std::string& text)
{
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return number_in(text);
  const auto above = number_in(text.substr(0, slash)), below = number_in(text.substr(slash + 1));
  if (!above || !below || !(*below > 0.0)) return std::nullopt;
  return *above / *below;
}

/// The number of a gauge: 0 of "0", -1 of "00" and "2/0".
std::optional<int> gauge_in(const std::string& text)
{
  if (!text.empty() && text.find_first_not_of('0') == std::string::npos)
    return 1 - static_cast<int>(text.size());
  const std::size_t slash = text.find('/');
  const auto n = number_in(slash == std::string::npos ? text : text.substr(0, slash));
  if (!n || *n != std::floor(*n) || *n < 0.0 || *n > 60.0) return std::nullopt;
  if (slash == std::string::npos) return static_cast<int>(*n);
  return text.substr(slash) == "/0" && *n >= 1.0 ? std::optional(1 - static_cast<int>(*n)) : std::nullopt;
}

std::optional<double> standard_gauge(int n)
{
  if (n >= 0 && n < static_cast<int>(standard_wire.size())) return 1e-3 * inch * standard_wire[n];
  const int thick = -n - 1;  // 2/0 is -1
  if (thick >= 0 && thick < static_cast<int>(thick_standard_wire.size()))
    return 1e-3 * inch * thick_standard_wire[thick];
  return std::nullopt;
}

std::optional<double> american_gauge(int n)
{
  if (n < -3 || n > 40) return std::nullopt;
  return 0.127 * std::pow(92.0, (36.0 - n) / 39.0);
}

std::optional<double> read(const std::string& quantity, const std::string& unit)
{
  if (unit == "awg" || unit == "swg") {
    const std::optional<int> gauge = gauge_in(quantity);
    if (!gauge) return std::nullopt;
    return unit == "awg" ? american_gauge(*gauge) : standard_gauge(*gauge);
  }
  const double factor = unit == "mm"                                     ? 1.0
                        : unit == "cm"                                   ? 10.0
                        : unit == "m"                                    ? 1e3
                        : unit == "in" || unit == "inch" || unit == "\"" ? inch
                                                                         : 0.0;
  const std::optional<double> x = quantity_in(quantity);
  if (!x || factor == 0.0) return std::nullopt;
  return *x * factor;
}

}  // namespace

double millimetres(const std::string& text, const std::string& option)
{
  std::string plain;
  for (const char c : text)
    if (c != ' ') plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::size_t end = plain.find_last_of("0123456789./");
  const std::size_t split = end == std::string::npos ? 0 : end + 1;
  const std::optional<double> x = read(plain.substr(0, split), plain.substr(split));
  if (x && *x > 0.0 && std::isfinite(*x)) return *x;
  const char* why = split == plain.size() && split > 0 ? "the unit is missing" : "this is no length";
  throw InputError(
      fmt::format("{} {}: {}; write it as 8mm, 0.8cm, 5/16in, 0.25in, 18awg or 18swg", option, text, why));
}

}  // namespace hauberk::maker
