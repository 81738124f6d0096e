#include "document/node_access.hpp"
#include "tasks/stability/stability_section.hpp"
#include "tasks/variants/variants.hpp"

namespace hauberk {

namespace {

void read_exact(const Node& section, Problems& problems, StabilityFamily& family)
{
  family.exact.assign(family.members.size(), std::nullopt);
  const Node* exact = find_typed(section, "exact", Node::Type::array);
  check_length(exact, family.members.size(), "exact values", "member", problems);
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
  Variants variants = read_variants(section, "member", problems);
  family.labels = std::move(variants.labels);
  family.members = std::move(variants.values);
  read_exact(section, problems, family);
  return family;
}

}  // namespace

std::shared_ptr<const TaskSection> read_stability(Node& section, SectionContext& context)
{
  Problems& problems = context.problems;
  auto stability = std::make_shared<ExperimentStability>();
  ExperimentStability& out = *stability;
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
  out.base = context.base;
  return stability;
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
