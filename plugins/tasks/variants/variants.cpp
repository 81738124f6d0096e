#include "tasks/variants/variants.hpp"

#include "document/json_writer.hpp"
#include "document/jsonc.hpp"
#include "document/node_access.hpp"

#include <hauberk/experiment/task_format.hpp>

#include <algorithm>
#include <array>

namespace hauberk {

namespace {

/// A value as a label: short where it is a scalar, else the variant's number.
std::string label_of(const Node& value, std::size_t variant)
{
  if (value.is(Node::Type::number)) return format_number(value.number);
  if (value.is(Node::Type::string)) return value.string;
  if (value.is(Node::Type::boolean)) return value.boolean ? "true" : "false";
  return std::to_string(variant + 1);
}

std::vector<std::string> pointers_of(const Node& entry)
{
  std::vector<std::string> out;
  const Node* pointer = entry.find("pointer");
  if (pointer == nullptr) return out;
  if (pointer->is(Node::Type::string)) return {pointer->string};
  for (const Node& item : pointer->items) out.push_back(item.string);
  return out;
}

}  // namespace

std::vector<Assignment> read_set(const Node& section)
{
  std::vector<Assignment> out;
  if (const Node* set = find_typed(section, "set", Node::Type::object)) {
    for (const auto& [pointer, value] : set->members) out.push_back({pointer, value});
  }
  return out;
}

Variants read_variants(const Node& section, const std::string& each, Problems& problems)
{
  Variants out;
  const Node* vary = find_typed(section, "vary", Node::Type::array);
  if (vary == nullptr || vary->items.empty()) return out;
  const Node* first = find_typed(vary->items.front(), "values", Node::Type::array);
  if (first == nullptr) return out;
  out.values.assign(first->items.size(), read_set(section));
  for (std::size_t k = 0; k < first->items.size(); ++k) out.labels.push_back(label_of(first->items[k], k));
  for (const Node& entry : vary->items) {
    const Node* values = find_typed(entry, "values", Node::Type::array);
    if (values == nullptr) continue;
    check_length(values, out.values.size(), "values", each, problems);
    for (std::size_t k = 0; k < std::min(values->items.size(), out.values.size()); ++k) {
      for (const std::string& pointer : pointers_of(entry))
        out.values[k].push_back({pointer, values->items[k]});
    }
  }
  if (const Node* labels = find_typed(section, "labels", Node::Type::array)) {
    check_length(labels, out.values.size(), "labels", each, problems);
    for (std::size_t k = 0; k < std::min(labels->items.size(), out.labels.size()); ++k)
      out.labels[k] = labels->items[k].string;
  }
  return out;
}

void check_length(const Node* list, std::size_t count, const std::string& what, const std::string& each,
                  Problems& problems)
{
  if (list == nullptr || list->items.size() == count) return;
  problems.add(*list, "expected " + std::to_string(count) + " " + what + ", one per " + each + ", found " +
                          std::to_string(list->items.size()));
}

std::string place_without_effect(TaskFormats formats, const std::string& pointer, const std::string& variants,
                                 const std::string& verb)
{
  constexpr std::array own{"/name", "/task", "/expect"};
  const bool lacking = std::any_of(own.begin(), own.end(),
                                   [&](const char* place) { return pointer_within(pointer, place); }) ||
                       std::any_of(formats.begin(), formats.end(), [&](const TaskFormat& format) {
                         return pointer_within(pointer, "/" + std::string(format.name));
                       });
  if (!lacking) return "";
  return quote_json(pointer) + " has no effect: " + variants + " are limits experiments; " + verb +
         " something of elements, cell, load_case, solver or seed";
}

}  // namespace hauberk
