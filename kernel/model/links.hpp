#pragma once
/// Links between elements, and what follows from them.

#include "model/near_pairs.hpp"

#include <vector>

namespace hauberk {

/// Links of the model in a state (all pairs of cycles within reach), in a fixed order: every body's core and
/// every loop of a spine with all of another element's. A cycle of primitives that each have a link has one,
/// too, if it runs along them.
std::vector<Link> find_links(const Model& model, const State& state);

/// Element that a cycle of a Link belongs to.
int element_of_cycle(const Model& model, int cycle);

/// Indices (within their element) of the primitives that a cycle of a Link follows.
std::vector<int> primitives_of_cycle(const Model& model, int cycle);

/// What links two elements: so many pairs of their primitives, and so many more independent loops (rank of
/// the matrix of linking numbers beyond that of its primitives' part), which no choice of cycles changes.
struct ElementLink {
  ElementPair pair;
  int primitives = 0, together = 0;
};

/// Those of the model's links, in the order of their first links.
std::vector<ElementLink> element_links(const Model& model);

/// True if loops of several primitives, where elements have any, are the same in two models of the same
/// primitives, so that a Link of one means the same in the other. Such loops come and go where parameters
/// make primitives of an element meet or part.
bool same_loops(const Model& a, const Model& b);

/// True if the links in `state` are those at rest.
bool links_kept(const Model& model, const State& state);

/// Translations (at rest) of independent cycles of the link graph.
std::vector<Vec3> cycle_translations(const Model& model);

}  // namespace hauberk
