#pragma once
/// The rest state that limits start from: checked, and relaxed where surfaces touch or overlap.

#include "model/model.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// What is wrong with the rest state, each a sentence that names elements and the way out; empty when nothing
/// is. Gaps within touching distance (1e-9 L) of the clearance are fine: relaxation opens them.
std::vector<std::string> rest_problems(const SceneSpec& spec, const Model& model, bool relax_allowed);

/// Rest state as used of a scene and its model: relaxed where gaps touch or overlap (call after
/// `rest_problems` found nothing). Throws InputError when there is no room. Returns the scene with new rest
/// poses, and how far elements moved (file units). Where the cell itself leaves no room (it is taut), rest
/// stays as it is and limits start from a state whose strain gives way: `start`.
struct PreparedScene {
  SceneSpec scene;
  double moved = 0.0;
  std::optional<State> start;
};
PreparedScene prepare_rest(const SceneSpec& spec, const Model& model);

/// The scene of a model with the poses of a state for its rest.
SceneSpec with_rest(const SceneSpec& spec, const Model& model, const State& rest);

}  // namespace hauberk
