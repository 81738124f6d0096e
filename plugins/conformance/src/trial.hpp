#pragma once
/// What a check works with: a section, objects made from it, admissible arguments.

#include "random.hpp"
#include "sections.hpp"
#include "verdict.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hauberk::conformance {

/// Ends a check: no parameters were found that a shape accepts.
class NoParameters : public Failure {
 public:
  using Failure::Failure;
};

/// A plugin's object, behind the guard of the program: what it throws and what it does to the floating-point
/// mode becomes a PluginError that says so.
struct Object {
  std::unique_ptr<Shape> shape;
  std::unique_ptr<LoadCase> load_case;
  std::unique_ptr<Optimizer> optimizer;
};

/// One run of a check. Everything in it follows from its arguments.
class Trial {
 public:
  Trial(const PluginTable& plugin_table, Section at, std::uint64_t seed)
      : table(plugin_table), section(std::move(at)), random(seed)
  {
  }

  const PluginTable& table;
  Section section;
  Random random;
  bool switched = false;  ///< a switch of the section is set otherwise than the setup has it
  std::string looked_at;  ///< the parameters looked at last, for messages: "R = 1.2, r = 0.25"
  /// Says what is looked at.
  void look_at(const Shape& shape, const std::vector<double>& p);

  /// The object of a section; its members are null, and `problems` says why, where the plugin refuses it.
  Object make(const Node& values, Problems& problems, double length = 1.0) const;
  /// The object of the section at hand; a Failure where it is refused.
  Object make() const;
};

// ----- shapes -----

/// The numbers of a primitive that the rows of its Jacobian belong to: position, size, then harmonics or the
/// sizes of a solid. Those that the kernel sets are 0.
std::vector<double> quantities(const Primitive& primitive);
/// Their names.
std::string quantity_name(const Primitive& primitive, std::size_t row);

/// Parameters that the shape accepts, also when each of them is moved by +-margin[k]: around the defaults, or
/// around the parameters of the setup. `margin` is 0.05 of the range that is drawn from. A Failure that tells
/// the last refusal when none are found.
///
/// A Failure, too, where the parameters of the setup are no numbers of parameters of the shape within their
/// bounds, or, if all are known, where the shape refuses them.
struct Point {
  std::vector<double> p, margin;
};
Point draw_point(const Shape& shape, Trial& trial);
/// The same with one of the parameters, or all where the shape accepts that, drawn from their whole bounds;
/// from three decades to both sides of the default where those are wider.
Point draw_far_point(const Shape& shape, Trial& trial);
/// Where a parameter is drawn from then.
std::pair<double, double> whole_range(const ParameterInfo& info);
/// The primitives of p. A failure that is no refusal is told of p.
std::vector<Primitive> primitives_at(const Shape& shape, const std::vector<double>& p, Trial& trial);
/// Message of the refusal of p; null where the shape accepts it. Another failure is told of p.
std::optional<std::string> refused(const Shape& shape, const std::vector<double>& p, Trial& trial);

// ----- load cases -----

/// Macroscopic unknowns that are admissible, of size up to `size`.
std::vector<double> draw_macro(const LoadCase& load_case, Random& random, double size = 0.4);
/// Whether the load case moves things along z: only then are lattice translations spatial.
bool spatial(const LoadCase& load_case, Random& random);
/// A translation of the lattice of a periodic load case; zero for others.
Vec3 draw_translation(const LoadCase& load_case, Random& random);
/// `count` angles in [0, pi), the axes among them.
std::vector<double> angles(Random& random, int count);

}  // namespace hauberk::conformance
