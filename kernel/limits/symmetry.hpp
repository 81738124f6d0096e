#pragma once
/// Symmetries of a scene: isometries that carry the whole fabric to itself, and what they make of states and
/// of directions of loading.
///
/// Limits of directions that a symmetry carries to each other are equal, and a locked state of one, carried
/// over, is a locked state of the other.

#include "limits/limits.hpp"

#include <optional>
#include <vector>

namespace hauberk {

/// An isometry g(x) = O x + t that maps a scene at rest to itself. Lattice and elements of a periodic scene
/// are mapped to each other; a patch keeps its apex, the origin of the plane, so that t is along z there.
///
/// Element i, with rest pose (X_i, Q_i), goes to the image `image[i]` of element j = `to[i]`:
///   O X_i + t = X_j + T_i,   O Q_i = Q_j S_i,
/// with the lattice translation T_i of that image and the isometry S_i = `local[i]` about the element's
/// origin, which maps the primitives of element i to those of element j, both in their element frames. S_i is
/// a rotation where g is proper, and improper where g is (a mirror, a glide).
struct SceneSymmetry {
  Mat3 O = Mat3::Identity();
  Vec3 t = Vec3::Zero();     ///< scaled
  std::vector<int> to;       ///< per element: the one whose image it becomes
  std::vector<Image> image;  ///< per element: which image of that
  std::vector<Mat3> local;   ///< per element: S
};

/// Rest positions at x (scaled) that differ by this much count as one: 1e-8 + 1e-9 |x|. Scenes are written
/// with about ten digits, and repeated cells add up what those leave out. Directions of axes may differ by
/// 1e-8.
inline double symmetry_tolerance(const Vec3& x) { return 1e-8 + 1e-9 * x.norm(); }

/// Lists of more symmetries times elements than this hold one symmetry for every orthogonal part alone.
inline constexpr std::size_t most_symmetric_elements = 200000;

/// One symmetry for every orthogonal part that any has, the identity first, in a fixed order: all that is
/// needed where translated copies of a state are worth nothing new. Every one is a symmetry of the load case
/// too (LoadCase::transform).
///
/// Orthogonal parts are those of the lattice's point group (two lattice vectors: turns about the sheet's
/// normal, mirrors, and these with the sheet turned upside down; three: any in space), for patches those that
/// carry the rarest kind of element at one distance from the apex to each other. Without lattice vectors and
/// with all elements at the apex only the identity is found.
///
/// Elements are compared as the model has them (primitives at rest, scaled), so that two shapes of different
/// names may be equal. A torus is symmetric about its axis and under all mirrors through its centre. A closed
/// curve is compared by its harmonics, up to a shift of its coordinate and its sense, a solid by points of
/// its surface, which have to lie on it again. Meshes are equal only where one lies upon the other: of
/// theirs, rotations of the element alone are found. An element's symmetry has to keep its origin, which is
/// what load cases move: a ring away from its origin has no others.
///
/// A candidate takes O(n) for n elements if it is a symmetry, and mostly O(1) if it is none: elements are
/// first told apart by how their neighbours lie around them, rare ones are looked at first, and only elements
/// of the rarest kind are candidates for each other's images. Thread safe; deterministic.
std::vector<SceneSymmetry> point_symmetries(const Model& model);

/// All symmetries modulo lattice translations of the model's cell: the group of its layer or space group
/// modulo them. The order is that of `point_symmetries`, each with all translations (those of cells that
/// `repeat` joined among them); the identity comes first. Where they are more than `most_symmetric_elements`
/// together, the same as `point_symmetries`.
std::vector<SceneSymmetry> scene_symmetries(const Model& model);

/// The symmetry that undoes g.
SceneSymmetry inverse(const Model& model, const SceneSymmetry& g);

/// The state that g makes of a state: element to[i] is at O x_i + F' t, where F' t is what the load case
/// makes of t, less what the lattice translation T_i moves it by; its rotation is O Q_i S_i^-1. Element
/// coordinates are those that give these positions. Null where the load case has none (then g is no symmetry
/// of it) and where the macroscopic unknowns do not transform. As exact as the scene is symmetric. Thread
/// safe.
std::optional<State> transformed(const Model& model, const SceneSymmetry& g, const State& state);

/// What g makes of a limit's task: its value at the transformed state is, but for the sign of the sense, the
/// value of `task` at the state. An angle becomes the angle of O n, from 0 to below 180 degrees; its sense is
/// reversed where g turns a bent patch upside down. Components transform as the macroscopic unknowns do. Null
/// where the value has no such counterpart: a measure that depends on the frame, an angle that leaves the
/// plane.
std::optional<LimitTask> transformed(const Model& model, const SceneSymmetry& g, const LimitTask& task);

}  // namespace hauberk
