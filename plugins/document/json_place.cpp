#include "document/json_place.hpp"

#include <hauberk/error.hpp>

#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <string_view>

namespace hauberk::detail {
namespace {

namespace json = boost::json;

const char* kind_of(const json::value& v)
{
  if (v.is_null()) return "null";
  if (v.is_bool()) return "true or false";
  if (v.is_string()) return "a string";
  if (v.is_array()) return "an array";
  return v.is_object() ? "an object" : "a number";
}

}  // namespace

JsonPlace JsonPlace::below(const json::value& value, const std::string& key) const
{
  JsonPlace out = *this;
  out.value_ = &value;
  out.pointer_ += "/" + key;
  return out;
}

void JsonPlace::fail(const std::string& what) const
{
  throw InputError(*file_ + ": " + (pointer_.empty() ? "" : pointer_ + ": ") + what);
}

void JsonPlace::expected(const char* what) const
{
  fail(std::string("expected ") + what + ", found " + kind_of(*value_) +
       "; give a results.json as `hauberk run` wrote it");
}

std::optional<JsonPlace> JsonPlace::find(const char* key) const
{
  const json::object* object = value_->if_object();
  if (object == nullptr) expected("an object");
  const json::value* member = object->if_contains(key);
  if (member == nullptr || member->is_null()) return std::nullopt;
  return below(*member, key);
}

JsonPlace JsonPlace::at(const char* key) const
{
  if (const std::optional<JsonPlace> member = find(key)) return *member;
  fail(std::string("'") + key + "' is missing; give a results.json as `hauberk run` wrote it");
}

std::vector<JsonPlace> JsonPlace::items() const
{
  const json::array* array = value_->if_array();
  if (array == nullptr) expected("an array");
  std::vector<JsonPlace> out;
  out.reserve(array->size());
  for (const json::value& item : *array) out.push_back(below(item, std::to_string(out.size())));
  return out;
}

double JsonPlace::number() const
{
  if (!value_->is_number()) expected("a number");
  return value_->to_number<double>();
}

std::int64_t JsonPlace::integer() const
{
  json::error_code error;
  const auto out = value_->is_number() ? value_->to_number<std::int64_t>(error) : 0;
  if (!value_->is_number() || error) expected("an integer");
  return out;
}

std::string JsonPlace::text() const
{
  if (!value_->is_string()) expected("a string");
  return std::string(std::string_view(value_->get_string()));
}

bool JsonPlace::boolean() const
{
  if (!value_->is_bool()) expected("true or false");
  return value_->get_bool();
}

std::optional<double> JsonPlace::optional_number(const char* key) const
{
  const std::optional<JsonPlace> member = find(key);
  return member ? std::optional(member->number()) : std::nullopt;
}

}  // namespace hauberk::detail
