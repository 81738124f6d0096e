#pragma once
/// How elements move over a step, and which of them can meet.

#include "model/model.hpp"

#include <functional>

namespace hauberk {

/// Rigid motion of one element (image) over the step.
struct Track {
  const Model* m;
  const State* from;
  const Vector* dy;
  int element;
  Image image;
  Vec3 w;               ///< rotation vector of the whole step
  double acceleration;  ///< bound of |x''|
  Pose pose;            ///< at the start, as
  Vec3 velocity;        ///< this

  Track(const Model& model, const State& state, const Vector& step, int k, const Image& im);

  /// Pose and velocity at s.
  void at(double s, Pose& there, Vec3& moving) const;
};

/// Two elements that the step may bring together.
struct CandidatePair {
  Track ti, tj;
  double approach;  ///< bound of how far the origins come together over the whole step
};

/// Every pair that the whole step can bring together, in a fixed order (broad phase). Where `keep_going`, if
/// given, says no, Interrupted is thrown: steps far beyond any cell have millions of pairs.
std::vector<CandidatePair> candidate_pairs(const Model& model, const State& from, const Vector& dy,
                                           const std::function<bool()>* keep_going = nullptr);

/// Fraction of the step that keeps `keep` of the gap to every wall. Walls are linear: exact.
double wall_step(const Model& model, const State& from, const Vector& dy, double keep);

}  // namespace hauberk
