#include "option_numbers.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace hauberk::command {

std::vector<double> numbers_in(const std::string& text)
{
  std::vector<double> out;
  const char *at = text.data(), *end = at + text.size();
  while (at != end) {
    double x = 0.0;
    const auto read = std::from_chars(at, end, x);
    if (read.ec != std::errc{} || !std::isfinite(x)) return {};
    out.push_back(x);
    if (read.ptr == end) return out;
    if (*read.ptr != ',') return {};
    at = read.ptr + 1;
  }
  return {};
}

std::vector<int> counts_of(const Options& options, const char* name, int most, const char* example)
{
  const auto& text = options.get<std::string>(name);
  std::vector<int> out;
  for (const double x : numbers_in(text)) {
    if (x < 1.0 || x > most || x != std::floor(x)) break;
    out.push_back(static_cast<int>(x));
  }
  if (out.size() != numbers_in(text).size() || out.empty())
    throw UsageError(
        fmt::format("--{} {}: expected whole numbers from 1 to {}, as {}", name, text, most, example),
        options.usage());
  return out;
}

double positive(const Options& options, const char* name)
{
  if (!options.has(name)) return 0.0;
  const double value = options.get<double>(name);
  if (!(value > 0.0) || !std::isfinite(value))
    throw UsageError(fmt::format("--{} {:g}: expected a number above 0", name, value), options.usage());
  return value;
}

}  // namespace hauberk::command
