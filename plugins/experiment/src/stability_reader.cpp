#include "node_access.hpp"
#include "sections.hpp"

#include <hauberk/experiment/json_writer.hpp>

#include <algorithm>

namespace hauberk {

namespace {

std::vector<Assignment> read_set(const Node& section)
{
  std::vector<Assignment> out;
  if (const Node* set = find_typed(section, "set", Node::Type::object)) {
    for (const auto& [pointer, value] : set->members) out.push_back({pointer, value});
  }
  return out;
}

/// A value as a label: short where it is a scalar, else the member's number.
std::string label_of(const Node& value, std::size_t member)
{
  if (value.is(Node::Type::number)) return format_number(value.number);
  if (value.is(Node::Type::string)) return value.string;
  if (value.is(Node::Type::boolean)) return value.boolean ? "true" : "false";
  return std::to_string(member + 1);
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

/// Lists that say something about every member must be as long as there are members.
void check_length(const Node* list, std::size_t members, const char* what, Problems& problems)
{
  if (list == nullptr || list->items.size() == members) return;
  problems.add(*list, "expected " + std::to_string(members) + " " + what + ", one per member, found " +
                          std::to_string(list->items.size()));
}

void read_members(const Node& section, Problems& problems, StabilityFamily& family)
{
  const Node* vary = find_typed(section, "vary", Node::Type::array);
  if (vary == nullptr || vary->items.empty()) return;
  const Node* first = find_typed(vary->items.front(), "values", Node::Type::array);
  if (first == nullptr) return;
  family.members.assign(first->items.size(), read_set(section));
  for (std::size_t k = 0; k < first->items.size(); ++k) family.labels.push_back(label_of(first->items[k], k));
  for (const Node& entry : vary->items) {
    const Node* values = find_typed(entry, "values", Node::Type::array);
    if (values == nullptr) continue;
    check_length(values, family.members.size(), "values", problems);
    for (std::size_t k = 0; k < std::min(values->items.size(), family.members.size()); ++k) {
      for (const std::string& pointer : pointers_of(entry))
        family.members[k].push_back({pointer, values->items[k]});
    }
  }
}

void read_exact(const Node& section, Problems& problems, StabilityFamily& family)
{
  family.exact.assign(family.members.size(), std::nullopt);
  const Node* exact = find_typed(section, "exact", Node::Type::array);
  check_length(exact, family.members.size(), "exact values", problems);
  if (exact == nullptr) return;
  for (std::size_t k = 0; k < exact->items.size(); ++k) {
    const Node& item = exact->items[k];
    if (!item.is(Node::Type::number) && !item.is(Node::Type::null))
      problems.add(item, "expected a number or null");
    else if (item.is(Node::Type::number) && k < family.exact.size())
      family.exact[k] = item.number;
  }
}

StabilityFamily read_family(const Node& section, Problems& problems)
{
  StabilityFamily family;
  family.name = string_or(section, "name", "");
  family.why = string_or(section, "why", "");
  family.solvable = boolean_or(section, "solvable", true);
  read_members(section, problems, family);
  read_exact(section, problems, family);
  if (const Node* labels = find_typed(section, "labels", Node::Type::array)) {
    check_length(labels, family.members.size(), "labels", problems);
    for (std::size_t k = 0; k < std::min(labels->items.size(), family.labels.size()); ++k)
      family.labels[k] = labels->items[k].string;
  }
  return family;
}

template <class Named>
void check_names(const Node& list, const std::vector<Named>& entries, const char* what, Problems& problems)
{
  for (std::size_t k = 0; k < entries.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      if (entries[j].name == entries[k].name)
        problems.add(list.items[k], std::string(what) + " '" + entries[k].name + "' is given twice");
    }
  }
}

}  // namespace

ExperimentStability read_stability(const Node& section, VariantBase base, Problems& problems)
{
  ExperimentStability out;
  out.tolerance = number_or(section, "tolerance", 1e-6);
  if (const Node* methods = find_typed(section, "methods", Node::Type::array)) {
    for (const Node& item : methods->items)
      out.methods.push_back({string_or(item, "name", ""), read_set(item)});
    check_names(*methods, out.methods, "method", problems);
  }
  if (const Node* families = find_typed(section, "families", Node::Type::array)) {
    for (const Node& item : families->items) out.families.push_back(read_family(item, problems));
    check_names(*families, out.families, "family", problems);
  }
  out.base = std::move(base);
  return out;
}

VariantReading read_stability_member(const ExperimentStability& stability, std::size_t family,
                                     std::size_t member, std::size_t method, const PluginLookup& lookup,
                                     Diagnostics& diagnostics)
{
  const StabilityFamily& from = stability.families[family];
  const StabilityMethod& by = stability.methods[method];
  std::vector<Assignment> values = from.members[member];
  values.insert(values.end(), by.set.begin(), by.set.end());
  return read_variant(
      stability.base, values, from.name + ", " + from.labels[member] + ", " + by.name,
      "family '" + from.name + "', member '" + from.labels[member] + "', method '" + by.name + "': ", lookup,
      diagnostics);
}

}  // namespace hauberk
