#pragma once
/// The designed scene as an experiment that runs by itself.

#include "model/scene.hpp"

#include <boost/json/object.hpp>

#include <string>

namespace hauberk {

/// Its name in a folder of results.
inline constexpr const char* designed_file = "designed.json";
/// That of the best design of a search that is not done.
inline constexpr const char* best_so_far_file = "best_so_far.json";

/// Rewrites the resolved experiment (strict JSON text) so that it describes `scene`, the final design at its
/// relaxed rest state: `elements` has an entry with all parameters for those of a type that are equal,
/// `<type>` where all of it are, else `<type>_<k>` with the first of them, k; `cell` becomes the supercell
/// with `repeat` [1, 1], or a patch of one cell, and one entry of `place` for each element; task is `limits`,
/// the name ends in "_designed", and `design`, `expect` and the sections of other tasks, which belong to the
/// file as it was, are left out. Everything else stays. Running it gives the limits reported for the design.
/// A weave must have been expanded (Experiment::expanded). Throws InputError when the text is malformed.
/// Thread safe.
boost::json::object designed_experiment(const std::string& experiment_json, const SceneSpec& scene);

}  // namespace hauberk
