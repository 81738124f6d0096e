#pragma once
/// Whether convex hulls of elements lie apart, so that nothing can hold them together.

#include "model/model.hpp"

namespace hauberk {

/// True if a plane is found between the convex hulls of every two elements, images included, in the state.
/// Then nothing is entangled: moved apart by any factor, convex bodies that are disjoint stay so. False: not
/// found, which proves nothing.
bool hulls_apart(const Model& model, const State& state);

}  // namespace hauberk
