#pragma once
/// Elements that are no one body.

#include "model/scene.hpp"

#include <string>
#include <vector>

namespace hauberk {

/// A line for every element type of which primitives hang together with none of the others: they move as one
/// all the same, which nothing that is made does. The line names the type, and a primitive of each body.
std::vector<std::string> loose_parts(const SceneSpec& scene);

}  // namespace hauberk
