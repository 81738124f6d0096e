#pragma once
/// The designed scene as an experiment that runs by itself.

#include "model/scene.hpp"

#include <boost/json/object.hpp>

#include <optional>
#include <string>

namespace hauberk {

/// Its name in a folder of results.
inline constexpr const char* designed_file = "designed.json";
/// That of the best design of a search that is not done.
inline constexpr const char* best_so_far_file = "best_so_far.json";

/// The experiment of a design with what was designed in it, as it was laid out.
inline constexpr const char* designed_fabric_file = "designed_fabric.json";

/// Rewrites the resolved experiment (strict JSON text) so that it describes `scene`, the final design at its
/// relaxed rest state: `elements` has an entry with all parameters for those of a type that are equal,
/// `<type>` where all of it are, else `<type>_<k>` with the first of them, k; `cell` becomes the supercell
/// with `repeat` [1, 1], or a patch of one cell, and one entry of `place` for each element; task is `limits`,
/// the name ends in "_designed", and `design`, `expect` and the sections of other tasks, which belong to the
/// file as it was, are left out. Everything else stays. Running it gives the limits reported for the design.
/// A weave must have been expanded (Experiment::expanded). Throws InputError when the text is malformed.
/// Thread safe.
boost::json::object designed_experiment(const std::string& experiment_json, const SceneSpec& scene);

/// The same with the cell as the experiment lays it out (repeat, patch, strip), where the elements of every
/// type are equal: what another load, or a fabric of another size, goes on from. Its rest is relaxed from the
/// places of the experiment. Null where elements of a type differ, or where a placement has parameters of its
/// own.
std::optional<boost::json::object> designed_fabric(const std::string& experiment_json,
                                                   const SceneSpec& scene);

}  // namespace hauberk
