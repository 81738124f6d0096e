#pragma once
/// What will be modelled, and why: decided before anything is solved.

#include "limits/limits.hpp"

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace hauberk {

/// How the distance of two primitives is reduced to a search in few coordinates.
enum class Reduction {
  meshes,              ///< points and triangles, edges and edges
  two_curves,          ///< distance of two curves minus radii, both coordinates searched
  curve_and_torus,     ///< the curve's coordinate searched in the torus's field
  two_circles,         ///< one angle searched, the other in closed form
  circle_and_surface,  ///< one angle searched in the field of a revolved ellipse
  solids,              ///< the probe of one searched in the field of the other, at least one of them a solid
  two_surfaces         ///< two angles of one surface searched in the field of the other
};

/// How the pairs of two kinds of primitives are treated.
struct PairPlan {
  std::array<PrimitiveKind, 2> kinds;  ///< in the order of their names
  Reduction reduction;
  int pairs = 0;  ///< pairs of bodies (with images) within reach at rest
};

/// Sizes of the meshes that stand for primitives.
struct MeshPlan {
  std::size_t least_triangles = 0, most_triangles = 0, most_edges = 0;
};

/// A close pair at rest, file units.
struct TightPair {
  std::array<int, 2> elements{}, primitives{};
  Image image{};
  double distance = 0.0;  ///< surface distance
  bool linked = false;
};

struct Plan {
  double length = 0.0;  ///< characteristic length, file units
  int elements = 0, primitives = 0;
  int unknowns = 0;     ///< macro + coordinates + rotations
  int inert = 0;        ///< spins about a common axis of all of an element's primitives
  bool sparse = false;  ///< Hessians are (Model::sparse)
  bool height_fixed = false, circles_only = false;
  ContactChoice contact = ContactChoice::automatic;
  Schedule schedule;
  std::vector<PlannedStage> stages;  ///< of barriers; none of `constrained`
  std::optional<MeshPlan> mesh;      ///< of contact `mesh`
  std::size_t company = 0;           ///< limits that are solved with those asked for, which only teach
  double searches = 0.0;             ///< that stand alone (count_searches)
  std::vector<PairPlan> pairs;
  int image_pairs = 0;     ///< element pairs within reach at rest
  Image farthest_image{};  ///< largest image indices among them
  std::vector<int> links_per_element;
  std::vector<std::pair<LimitTask, Boundedness>> bounded;  ///< per task, by links alone
};

Plan make_plan(const Model& model, const std::vector<LimitTask>& tasks, const LimitSettings& settings);

/// The closest pairs of primitives at rest, each once, nearest first: up to ten of those nearer than the
/// clearance and 0.3 L. Costs a search of every pair's local minima, which a limit may cost less than, so
/// that a plan goes without it.
std::vector<TightPair> tightest_pairs(const Model& model);

}  // namespace hauberk
