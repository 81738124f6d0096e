#pragma once
/// Whether an isometry about the origin of elements carries the primitives of one to those of another.

#include "model/model.hpp"

namespace hauberk {

/// Lengths (scaled) and directions of axes in the element frame that differ by this much count as equal.
inline constexpr double same_geometry = 1e-8;

/// Whether S (orthogonal) maps the primitives of element i onto those of element j, both in their frames.
bool carries_bodies(const Model& model, int i, int j, const Mat3& S);

/// Per element a number from 0, equal for elements whose primitives have the same kinds, sizes and distances
/// from the origin, and whose neighbours lie around them in the same distances and angles: only such may be
/// carried to each other.
std::vector<int> element_kinds(const Model& model);

}  // namespace hauberk
