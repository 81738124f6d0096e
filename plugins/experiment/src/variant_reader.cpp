#include "document/node_access.hpp"
#include "sections.hpp"

#include <hauberk/experiment/overrides.hpp>

#include <algorithm>

namespace hauberk {

namespace {

void set_member(Node& root, const std::string& key, Node value)
{
  std::erase_if(root.members, [&](const auto& member) { return member.first == key; });
  root.members.emplace_back(key, std::move(value));
}

}  // namespace

VariantBase variant_base(const Node& file, const Lookups& lookups)
{
  VariantBase base{file, lookups.formats, lookups.weaves, lookups.folder, lookups.files};
  std::erase_if(base.file.members, [&lookups](const auto& member) {
    return member.first == "expect" ||
           std::any_of(lookups.formats.begin(), lookups.formats.end(),
                       [&member](const TaskFormat& format) { return format.name == member.first; });
  });
  set_member(base.file, "task", string_node("limits"));
  return base;
}

VariantReading read_variant(const VariantBase& base, const std::vector<Assignment>& values,
                            const std::string& name, const std::string& place, const PluginLookup& lookup,
                            Diagnostics& diagnostics)
{
  Node root = base.file;
  Diagnostics found;
  for (const Assignment& a : values) {
    const std::string problem = set_value(root, a.pointer, a.value);
    if (!problem.empty()) found.problems.add({a.value.pointer, a.value.line, problem});
  }
  set_member(root, "name", string_node(name));
  bool well_formed = false;
  VariantReading out;
  if (found.empty())
    out.experiment = read_tree(std::move(root), {lookup, base.weaves, base.folder, base.files, base.formats},
                               found, &well_formed);
  for (const Problem& problem : found.problems.list()) {
    if (!well_formed) {
      diagnostics.problems.add({problem.pointer, problem.line, place + problem.message});
    } else {
      if (!out.refusal.empty()) out.refusal += "; ";
      out.refusal += (problem.pointer.empty() ? "" : problem.pointer + ": ") + problem.message;
    }
  }
  return out;
}

}  // namespace hauberk
