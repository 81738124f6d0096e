#pragma once
/// One planted defect, chosen by the section: {"defect": "name"}; "none" is the reference, which conforms.

#include <hauberk/plugin.hpp>

#include <atomic>
#include <cfenv>
#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

namespace hauberk::mutants {

inline void add_defect_field(std::vector<Field>& out)
{
  Field defect;
  defect.name = "defect";
  defect.kind = Field::Kind::string;
  defect.doc = "What is wrong with it.";
  defect.default_json = "\"none\"";
  out.push_back(defect);
}

/// A section without the field, as the reference expects it.
inline Node without_defect(Node section)
{
  std::erase_if(section.members, [](const auto& member) { return member.first == "defect"; });
  return section;
}

inline std::string defect_of(const Node& section) { return section.at("defect").string; }

/// Every defect that plugins of any kind can have.
[[noreturn]] inline void crash()
{
  std::raise(SIGSEGV);
  std::abort();
}

inline void hang()
{
  std::atomic<bool> forever{true};
  while (forever.load()) {
  }
}

}  // namespace hauberk::mutants
