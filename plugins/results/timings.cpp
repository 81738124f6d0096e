#include "results/timings.hpp"

#include "document/json_text.hpp"
#include "document/jsonc.hpp"
#include "results/document.hpp"

#include <hauberk/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace hauberk {
namespace {

namespace json = boost::json;

/// Below these nothing is a time of the run: what was asked for, what was planned, and charts.
constexpr std::array<json::string_view, 4> timeless{"experiment", "provenance", "plan", "chart"};

/// Members of the provenance that depend on the run.
constexpr std::array<const char*, 2> of_the_run{"threads", "peak_memory_bytes"};

void take(json::value& from, const std::string& place, json::object& seconds)
{
  if (json::array* const items = from.if_array()) {
    for (std::size_t k = 0; k < items->size(); ++k)
      take((*items)[k], place + '/' + std::to_string(k), seconds);
    return;
  }
  json::object* const members = from.if_object();
  if (members == nullptr) return;
  if (const auto time = members->find("seconds"); time != members->end() && !time->value().is_structured()) {
    seconds[place] = time->value();
    members->stable_erase(time);
  }
  for (auto& [key, value] : *members) {
    if (value.is_structured()) take(value, place + '/' + pointer_token(key), seconds);
  }
}

bool is_amount(const json::value& value)
{
  return value.is_number() && std::isfinite(value.to_number<double>()) && value.to_number<double>() >= 0.0;
}

}  // namespace

json::object take_timings(json::object& results)
{
  json::object out{{"format", timings_format}};
  json::object& provenance = results.at("provenance").as_object();
  for (const char* key : of_the_run) {
    const auto member = provenance.find(key);
    if (member == provenance.end()) continue;
    out[key] = member->value();
    provenance.stable_erase(member);
  }
  json::object& seconds = out["seconds"].emplace_object();
  for (auto& [key, value] : results) {
    if (std::find(timeless.begin(), timeless.end(), key) == timeless.end())
      take(value, '/' + pointer_token(key), seconds);
  }
  return out;
}

void enter_timings(json::value& results, const json::value& timings)
{
  const json::object* const from = timings.if_object();
  json::object* const into = results.if_object();
  if (from == nullptr || into == nullptr) return;
  const json::value* const format = from->if_contains("format");
  if (format == nullptr || *format != timings_format) return;
  json::value* const provenance = into->if_contains("provenance");
  for (const char* key : of_the_run) {
    const json::value* const amount = from->if_contains(key);
    if (amount != nullptr && amount->is_int64() && is_amount(*amount) && provenance != nullptr &&
        provenance->is_object())
      provenance->as_object()[key] = *amount;
  }
  const json::value* const seconds = from->if_contains("seconds");
  if (seconds == nullptr || !seconds->is_object()) return;
  for (const auto& [place, time] : seconds->as_object()) {
    json::error_code none;
    json::value* const at = results.find_pointer(place, none);
    if (!none && at != nullptr && at->is_object() && (time.is_null() || is_amount(time)))
      at->as_object()["seconds"] = time;
  }
}

json::value read_timed_results(const std::filesystem::path& file,
                               const std::function<void(const std::string&)>& lost)
{
  json::value results = read_json_file(file.string());
  const std::filesystem::path timings = file.parent_path() / timings_file;
  std::error_code unknown;
  if (!std::filesystem::exists(timings, unknown)) return results;
  try {
    enter_timings(results, read_json_file(timings.string()));
  } catch (const InputError& error) {  // what is left of times is no reason to lose results
    lost(error.what());
  }
  return results;
}

}  // namespace hauberk
