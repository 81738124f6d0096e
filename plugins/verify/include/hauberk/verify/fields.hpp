#pragma once
/// How every field of a results file is checked, or why it is not: the one place that says so. The check
/// itself, its last line and the table of share/doc/results.md are made from it.

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hauberk {

/// The parts of the check. One part is done once for each thing that it is about (a limit, a scene, a point
/// of a chart), and passes or fails there as a whole.
enum class VerifyPart : unsigned char {
  format,       ///< the document is one of the known format
  scene,        ///< the scene is that of the stored experiment
  asked,        ///< limits are those that the experiment asks for
  values,       ///< value and companions follow from the macroscopic unknowns, these from the state
  gap,          ///< smallest separation by exhaustive search
  links,        ///< linking numbers
  contacts,     ///< listed contacts lie on the surfaces
  balance,      ///< forces and reactions balance the load
  held,         ///< what is held is zero, and reactions are what the forces leave
  witness,      ///< an answer without a locked state rests on a motion
  sensitivity,  ///< derivatives follow from forces and gaps
  profiles,
  boundary,
  design,
  sweep,
  chart,
  stability,
};

/// A set of parts.
class VerifyParts {
 public:
  constexpr VerifyParts() = default;
  constexpr VerifyParts(std::initializer_list<VerifyPart> parts)
  {
    for (const VerifyPart part : parts) bits_ |= 1U << static_cast<unsigned>(part);
  }
  constexpr bool empty() const { return bits_ == 0; }
  /// In the order of the enumeration.
  std::vector<VerifyPart> list() const
  {
    std::vector<VerifyPart> out;
    for (unsigned k = 0; bits_ >> k != 0; ++k)
      if ((bits_ >> k & 1U) != 0) out.push_back(static_cast<VerifyPart>(k));
    return out;
  }

 private:
  unsigned bits_ = 0;
};

/// What is known about the fields whose JSON pointers match a pattern.
struct VerifyRule {
  /// A pointer in which * stands for any one token, and ** at the end for all that follow. Rows of a sweep
  /// hold whole documents and the initial design a scene and limits: below these, pointers begin anew.
  std::string_view pattern;
  VerifyParts parts;     ///< all that look at the field; none: it is not checked
  std::string_view how;  ///< how it is checked, or why it is not
};

/// All rules; of those that match a pointer the first counts.
std::span<const VerifyRule> verify_rules();

/// The rule of a pointer without prefix; null when no rule knows it.
const VerifyRule* verify_rule(std::string_view pointer);

/// The pointer without the prefix of a nested document, so that rules apply:
/// `/sweep/rows/3/result/scene/length` is
/// `/scene/length`.
std::string_view without_document(std::string_view pointer);

/// The rules as a table in Markdown, for share/doc/results.md.
std::string verify_rules_markdown();

}  // namespace hauberk
