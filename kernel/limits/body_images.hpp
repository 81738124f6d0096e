#pragma once
/// Whether an isometry about the origin of elements carries the primitives of one to those of another.

#include "model/model.hpp"

#include <string>
#include <vector>

namespace hauberk {

/// Lengths (scaled) and directions of axes in the element frame that differ by this much count as equal.
inline constexpr double same_geometry = 1e-8;

/// What was found of isometries about the origin of solids: few different ones are asked for in a scene, and
/// each takes a hundred distances. Not thread safe.
class SolidTurns {
 public:
  /// Whether `turn` carries a body's solid to itself, as far as points of its surface tell.
  bool carry_to_itself(const Body& body, const Mat3& turn);

 private:
  struct Known {
    std::string kind;
    std::vector<double> sizes;
    Mat3 turn;
    bool carries;
  };
  std::vector<Known> known_;
};

/// Whether S (orthogonal) maps the primitives of element i onto those of element j, both in their frames.
bool carries_bodies(const Model& model, int i, int j, const Mat3& S, SolidTurns& turns);

/// Per element a number from 0, equal for elements whose primitives have the same kinds, sizes and distances
/// from the origin, and whose neighbours lie around them in the same distances and angles: only such may be
/// carried to each other.
std::vector<int> element_kinds(const Model& model);

}  // namespace hauberk
