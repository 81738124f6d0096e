#include "mutations.hpp"

#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace hauberk::test {
namespace {

namespace json = boost::json;

constexpr double share = 1e-3;
/// Beside the largest number of the same list or object: what is smaller moves nothing that can be measured.
constexpr double share_of_neighbours = 1e-4;
/// Of the tolerances of the check, which are stated: a thousand times that of surface distances.
constexpr double least_change = 1e-6;

/// The pointer with * for indices, and for names of parameters below.
std::string pattern_of(const std::string& pointer)
{
  std::string out;
  for (std::size_t k = 0; k < pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', k + 1), pointer.size());
    const std::string token = pointer.substr(k + 1, end - k - 1);
    const bool index = std::isdigit(static_cast<unsigned char>(token[0])) != 0;
    out += '/' + (index ? "*" : token);
    k = end;
  }
  return out;
}

double largest_of(const json::value& v)
{
  double out = 0.0;
  if (v.is_number()) out = std::abs(v.to_number<double>());
  if (const json::array* list = v.if_array())
    for (const json::value& x : *list) out = std::max(out, largest_of(x));
  return out;
}

/// The largest force of the contacts that a force is one of.
double neighbours(const json::value& document, const std::string& pointer)
{
  const std::string parent = pointer.substr(0, pointer.rfind('/'));
  // Beside the load, which is 1; of what is not balanced ten times as much may be a reaction's.
  if (const std::size_t at = pointer.find("/reactions/"); at != std::string::npos) {
    const json::value& balance = document.at_pointer(pointer.substr(0, at) + "/force_balance");
    return std::max(1.0, 20.0 * largest_of(balance) / share_of_neighbours);
  }
  if (pointer.ends_with("/force")) {
    double largest = 0.0;
    for (const json::value& contact : document.at_pointer(parent.substr(0, parent.rfind('/'))).as_array())
      largest = std::max(largest, contact.at("force").to_number<double>());
    return largest;
  }
  return largest_of(document.at_pointer(parent));
}

/// True for changes that mean the same as before: an axis's length does not count, and one parameter alone is
/// not tied.
bool same_meaning(const json::value& document, const std::string& pointer)
{
  const std::size_t slash = pointer.rfind('/');
  const std::string parent = pointer.substr(0, slash), key = pointer.substr(slash + 1);
  if (key == "tied") {
    const json::value& names = document.at_pointer(parent + "/parameters");
    return names.is_string() || names.as_array().size() == 1;
  }
  if (!parent.ends_with("/axis")) return false;
  const json::array& axis = document.at_pointer(parent).as_array();
  for (std::size_t k = 0; k < axis.size(); ++k)
    if (std::to_string(k) != key && axis[k].to_number<double>() != 0.0) return false;
  return document.at_pointer(pointer).to_number<double>() != 0.0;
}

/// `most` of the indices below `count`, evenly.
std::vector<std::size_t> spread(std::size_t count, std::size_t most)
{
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < std::min(count, most); ++k) out.push_back(k * count / std::min(count, most));
  return out;
}

}  // namespace

json::value other(const json::value& v, double least)
{
  if (v.is_int64()) return v.get_int64() + 1;
  if (v.is_uint64()) return v.get_uint64() + 1;
  if (v.is_double()) return v.get_double() + std::max(share * std::abs(v.get_double()), least);
  if (v.is_bool()) return !v.get_bool();
  if (v.is_string()) return json::value(std::string(v.get_string()) + "x");
  return 1.0;
}

MutationCounts mutate(const json::value& document, std::size_t most, const VerifyShapes& shapes)
{
  MutationCounts counts;
  const VerifyReport whole = verify(document, {}, shapes);
  counts.fields = whole.fields.size();
  std::map<std::string, std::vector<const VerifyField*>> by_pattern;
  for (const VerifyField& field : whole.fields) {
    if (field.outcome == VerifyOutcome::failed) counts.pretended.push_back(field.pointer);
    if (document.at_pointer(field.pointer).is_structured()) continue;  // empty: there is nothing to change
    if (same_meaning(document, field.pointer)) continue;
    by_pattern[pattern_of(field.pointer)].push_back(&field);
  }
  json::value changed = document;
  for (const auto& [pattern, fields] : by_pattern) {
    for (const std::size_t k : spread(fields.size(), most)) {
      const VerifyField& field = *fields[k];
      json::value& place = changed.at_pointer(field.pointer);
      const json::value before = place;
      place =
          other(before, std::max(least_change, share_of_neighbours * neighbours(document, field.pointer)));
      ++counts.tried;
      if (!verify(changed, {}, shapes).ok)
        ++counts.caught;
      else if (field.outcome == VerifyOutcome::not_checked)
        ++counts.listed;
      else
        counts.missed.push_back(field.pointer);
      changed.at_pointer(field.pointer) = before;
    }
  }
  return counts;
}

}  // namespace hauberk::test
