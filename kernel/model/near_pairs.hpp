#pragma once
/// Pairs of elements that contact may act between.

#include "model/model.hpp"

#include <functional>
#include <vector>

namespace hauberk {

/// Pair of elements that may come into contact: i of the cell, j of image.
struct ElementPair {
  int i = 0, j = 0;
  Image image{};
};

/// All element pairs whose bounding spheres are closer than `margin` in this state, in a fixed order.
/// Images are found by reach: every lattice translation that the strained cell can bring that near is
/// visited. Where `keep_going`, if given, says no, Interrupted is thrown: a wide margin has millions of them.
std::vector<ElementPair> near_pairs(const Model& model, const State& state, double margin,
                                    const std::function<bool()>* keep_going = nullptr);

}  // namespace hauberk
