#pragma once
/// From the cell or the elements of an experiment to its scene.

#include "model/scene.hpp"

#include <hauberk/experiment/plugin_resolver.hpp>

namespace hauberk {

/// A scene, and which of its elements count as one where parameters vary "per element": those at equal places
/// of a patch's tiles; in a periodic cell each is its own.
struct ReadScene {
  SceneSpec spec;
  std::vector<int> tile_of;  ///< per element
};

/// Expands elements and cell of a checked experiment. Mistakes go to `problems`, and as much as can be is
/// built all the same, so that later sections can be checked too. Writes the values of all parameters into
/// elements/*/parameters of `root`.
ReadScene read_scene(Node& root, PluginResolver& plugins, Problems& problems);

}  // namespace hauberk
