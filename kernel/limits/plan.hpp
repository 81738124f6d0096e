#pragma once
/// What will be modelled, and why: decided before anything is solved.

#include "limits/limits.hpp"

#include <string>

namespace hauberk {

/// How the pairs of two kinds of primitives are treated.
struct PairPlan {
  std::string kinds;     ///< "circle_tube / revolved_ellipse"
  std::string distance;  ///< the reduction used, in words
  int pairs = 0;         ///< pairs of bodies (with images) within reach at rest
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
  int unknowns = 0;  ///< macro + coordinates + rotations
  int inert = 0;     ///< spins about a common axis of all of an element's primitives
  std::string linear_solver;
  std::vector<PairPlan> pairs;
  int image_pairs = 0;     ///< element pairs within reach at rest
  Image farthest_image{};  ///< largest image indices among them
  std::vector<int> links_per_element;
  std::vector<TightPair> tightest;     ///< up to ten, nearest first
  std::vector<std::string> decisions;  ///< sentences: what was left out, and why it is exact
  std::vector<std::pair<LimitTask, std::string>>
      bounded;  ///< per task: "attained", "unbounded", "not attained"
};

Plan make_plan(const Model& model, const std::vector<LimitTask>& tasks, const LimitSettings& settings);

}  // namespace hauberk
