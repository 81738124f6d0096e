#include "record.hpp"

#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <optional>
#include <string_view>

namespace hauberk::verification {
namespace {

namespace json = boost::json;

/// The entry of the nearest place at or above `pointer`; none.
template <class Find>
auto nearest(const std::string& pointer, const Find& find) -> decltype(find(pointer))
{
  std::string at = pointer;
  for (;;) {
    if (auto found = find(at)) return found;
    const auto slash = at.rfind('/');
    if (slash == std::string::npos) return {};
    at.resize(slash);
  }
}

/// A key as a token of a JSON pointer.
std::string token(std::string_view key)
{
  std::string out;
  for (const char c : key) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return out;
}

}  // namespace

void Record::done(VerifyPart part, const std::string& scope, bool passed)
{
  const auto [at, fresh] = done_.emplace(std::pair(part, scope), passed);
  if (!fresh) at->second = at->second && passed;
}

void Record::skip(const std::string& pointer, const std::string& why) { skipped_.emplace(pointer, why); }

void Record::failed(const std::string& pointer) { failed_[pointer] = true; }

VerifyField Record::outcome(const std::string& pointer) const
{
  const auto in = [](const auto& map) {
    return [&map](const auto& key) {
      const auto found = map.find(key);
      return found == map.end() ? std::nullopt : std::optional(found->second);
    };
  };
  if (nearest(pointer, in(failed_))) return {pointer, VerifyOutcome::failed, {}};
  const VerifyRule* rule = verify_rule(without_document(pointer));
  if (rule == nullptr) return {pointer, VerifyOutcome::not_checked, "unknown"};
  if (rule->parts.empty()) return {pointer, VerifyOutcome::not_checked, std::string(rule->how)};
  if (const auto why = nearest(pointer, in(skipped_))) return {pointer, VerifyOutcome::not_checked, *why};
  bool passed = false;
  for (const VerifyPart part : rule->parts.list()) {
    const auto found =
        nearest(pointer, [&](const std::string& at) { return in(done_)(std::pair(part, at)); });
    if (found && !*found) return {pointer, VerifyOutcome::failed, {}};
    passed = passed || found;
  }
  if (passed) return {pointer, VerifyOutcome::passed, {}};
  return {pointer, VerifyOutcome::not_checked, "nothing here to check it by"};
}

void Record::collect(const json::value& v, std::string& pointer, std::vector<VerifyField>& out) const
{
  const std::size_t size = pointer.size();
  if (const json::object* object = v.if_object(); object != nullptr && !object->empty()) {
    for (const auto& [key, value] : *object) {
      pointer += "/" + token(key);
      collect(value, pointer, out);
      pointer.resize(size);
    }
    return;
  }
  if (const json::array* list = v.if_array(); list != nullptr && !list->empty()) {
    for (std::size_t k = 0; k < list->size(); ++k) {
      pointer += "/" + std::to_string(k);
      collect((*list)[k], pointer, out);
      pointer.resize(size);
    }
    return;
  }
  out.push_back(outcome(pointer));
}

std::vector<VerifyField> Record::outcomes(const json::value& document) const
{
  std::vector<VerifyField> out;
  std::string pointer;
  collect(document, pointer, out);
  return out;
}

}  // namespace hauberk::verification
