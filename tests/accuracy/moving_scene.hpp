#pragma once
/// Scenes in motion, watched by brute force: random linked scenes, and the first contact along a path by
/// small steps. Kinematics (where a state puts an element) come from the model; distances do not.

#include "minima.hpp"
#include "model/model.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <random>

namespace hauberk::brute {

/// A random scene of linked rings, apart at rest by brute force, in lengths of about its rings.
struct RandomScene {
  SceneSpec spec;
  double clearance = 0.0;
  std::string what;
};

/// Scene number k: a linked pair, a linked pair and a free ring, two linked elements of two rings each, or
/// a published chainmail cell with varied tubes; round, mixed and elliptical tubes take turns.
RandomScene random_scene(long k, std::mt19937_64& rng);

/// Linked rings whose tubes are 0.5 to 4 % of the ring, up to ten times as wide as high or as high as wide:
/// fast motions pass through them between two looks.
RandomScene thin_scene(long k, std::mt19937_64& rng);

/// A random step of the whole model: strain (images move), shifts, turns; sizes over three decades.
Vector random_step(const Model& model, const State& from, bool strain, std::mt19937_64& rng);

/// Tori at time s of a path; index is the body. `image` shifts the second of a pair.
using TorusAt = std::function<Torus(int body, const Image& image, double s)>;

/// What small steps saw.
struct Watched {
  std::optional<double> contact;  ///< first s at which a gap is gone, in [0, 1]
  std::optional<double> near;     ///< first s at which a pair's gap is `keep` of its gap at s = 0
  double smallest = 0.0;          ///< smallest gap over [0, until]
  int changed_links = 0;          ///< pairs whose linking number (Gauss) at `until` is not that at 0
  long looks = 0;                 ///< distances computed
};

/// Follows every pair of bodies of different elements (or images within three cells) over [0, 1] with steps
/// of at most 1/2000 where surfaces are near (longer only where the gap allows it at twice the fastest
/// sampled speed), and refines around every closest approach.
Watched watch(const Model& model, const TorusAt& at, double keep, double until);

}  // namespace hauberk::brute
