#pragma once
/// Elements that are no one body.

#include "model/scene.hpp"

#include <string>
#include <vector>

namespace hauberk {

/// A line for every element type whose primitives are several bodies that nothing joins: they move as one all
/// the same, which nothing that is made does. The line names the type, and a primitive of each of the first
/// four bodies.
std::vector<std::string> loose_parts(const SceneSpec& scene);

}  // namespace hauberk
