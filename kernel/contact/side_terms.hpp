#pragma once
/// Accumulated contact terms of one pair of bodies, in the relative motion of the two elements.

#include "geometry/pair_frame.hpp"

#include <limits>
#include <vector>

namespace hauberk {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vec9 = Eigen::Matrix<double, 9, 1>;
using Mat9 = Eigen::Matrix<double, 9, 9>;

/// What an evaluation is asked for. Less is faster.
struct Request {
  int order = 0;            ///< 0: energy, 1: and gradient, 2: and Hessian
  bool parameters = false;  ///< also d energy / d (geometry of both bodies, clearance); needs the gradient
  bool points = false;      ///< also list contact points and forces
};

/// A contact force: P is pushed along `normal` (from F to P).
struct ContactPoint {
  Vec3 on_p, on_f, normal;  ///< F's frame while accumulating, world after `to_world`
  double gap = 0.0;
  double force = 0.0;  ///< -d energy / d gap (before the stiffness is applied)
};

/// Energy and derivatives with respect to (eta, w_P): eta shifts P's element relative to F's, w_P turns P's
/// element about its origin, Q <- exp(w) Q; F stays. Vectors are in F's frame.
struct SideTerms {
  double energy = 0.0;
  Vec6 gradient = Vec6::Zero();
  Mat6 hessian = Mat6::Zero();  ///< symmetric; only its lower triangle is kept
  double d_clearance = 0.0;
  /// d energy / d(position in the element frame, R, r0, r1) of P and F; positions in F's frame here.
  std::array<double, primitive_dofs> dP{}, dF{};
  /// d energy / d(harmonics of the core, or sizes of a solid), in the frame of its body; empty for other
  /// bodies.
  std::vector<double> curve_P, curve_F;
  double min_gap = std::numeric_limits<double>::infinity();
  double regularity = std::numeric_limits<double>::infinity();  ///< see `relative_curvature` in nearest
  int evaluations = 0;
  std::vector<ContactPoint> points;

  /// Adds w1 times the first-order terms of the gap at a probe point, and w2 g g^T + w1 (second-order terms
  /// at fixed probe coordinates).
  ///
  /// A material point of P at r = eta + o + rho, rho = p - o, moves by
  ///   dr = eta + w x rho + 1/2 w x (w x rho),
  /// so the gradient of phi(r) is (n, rho x n), and its Hessian J^T K J + n . (second-order part) with
  /// J = [I, -skew(rho)], K = k_m a a^T + k_a b b^T.
  void add(const FieldValue& f, const Vec3& rho, double w1, double w2, int order);

  /// Adds w1 times the derivatives of the gap in the geometry of both bodies, at fixed probe coordinates.
  template <int dim>
  void add_parameters(const PairFrame& frame, const FieldValue& f, const ProbePoint& q, double w1);

 private:
  void add_field_size(const FieldValue& f, double w1);
  /// At the point p of F's frame.
  void add_solid_field(const Body& F, const Vec3& p, double w1);
  /// n: the field's gradient in P's frame.
  void add_solid_probe(const Body& P, const ProbePoint& q, double w1, const Vec3& n);
};

/// The change of a gap's gradient (n, rho x n) in the relative motion while its place moves along t, which
/// moves the point of P, too, or that of F alone.
Vec6 gradient_along(const FieldValue& f, const Vec3& rho, const Vec3& t, bool on_p);

/// Terms in the world frame for (eta, w_P, w_F), eta = shift of P's element minus shift of F's.
struct PairTerms {
  double energy = 0.0;
  Vec9 gradient = Vec9::Zero();
  Mat9 hessian = Mat9::Zero();
};

/// Extends side terms to rotations of F by invariance: turning F by w_F is turning everything else by -w_F,
///   eta' = exp(-w_F)(xi + eta) - xi,   w_P' = log(exp(-w_F) exp(w_P)) = w_P - w_F - 1/2 w_F x w_P + ...,
/// with xi the vector from F's element origin to P's, and turns vectors from F's frame to the world.
PairTerms to_world(const SideTerms& side, const Mat3& M, const Vec3& xi, int order);

/// d energy / d(all geometric quantities of a body, its turn) of P and F, positions and turns in the frames
/// of their elements; what Model::geometry_derivative takes to parameters.
///
/// A turn of a body about its centre c is one of its element about its origin, and a shift that takes the
/// centre back. So with the force f that the energy's derivative in the place of the body is, and the
/// derivative t in the turn of its element, the derivative in its own turn is
///
///     tau = t - c x f,
///
/// the sum of (p - c) x f over the points p of contact. Energies depend on the relative pose of bodies alone,
/// so nothing else has to be known of them: also where a force is none at a point, as that of a mollified
/// pair of edges.
struct GeometryTerms {
  std::vector<double> P, F;
};

/// `side` needs its gradient; M: axes of F in the world.
GeometryTerms geometry_terms(const SideTerms& side, const Mat3& M, const Body& P, const Pose& pose_p,
                             const Body& F, const Pose& pose_f);

}  // namespace hauberk
