#include "contact/side_terms.hpp"

#include "geometry/panel_bound.hpp"

#include <hauberk/solid.hpp>

namespace hauberk {

void SideTerms::add(const FieldValue& f, const Vec3& rho, double w1, double w2, int order)
{
  Vec6 g;
  g << f.n, rho.cross(f.n);
  if (order >= 1) gradient += w1 * g;
  if (order >= 2) {
    Vec6 a, b;
    a << f.meridian, rho.cross(f.meridian);
    b << f.azimuth, rho.cross(f.azimuth);
    const Vec6 wg = w2 * g, wa = (w1 * f.m.k) * a, wb = (w1 * f.k_azimuth) * b;
    for (int j = 0; j < 6; ++j) {
      for (int i = j; i < 6; ++i) hessian(i, j) += wg[i] * g[j] + wa[i] * a[j] + wb[i] * b[j];
    }
    // n . 1/2 w x (w x rho) = 1/2 ((w.rho)(w.n) - |w|^2 rho.n)
    const double rn = rho.dot(f.n);
    for (int j = 0; j < 3; ++j) {
      for (int i = j; i < 3; ++i) {
        hessian(3 + i, 3 + j) += w1 * (0.5 * (rho[i] * f.n[j] + f.n[i] * rho[j]) - (i == j ? rn : 0.0));
      }
    }
  }
}

namespace {

/// Adds the derivatives of a core's harmonics at the angle u, where its point moves along `n`.
void add_harmonics(const ClosedCurve& curve, const Angle& u, const Vec3& n, std::vector<double>& out)
{
  out.resize(harmonic_dofs * curve.size(), 0.0);
  Angle k;
  double* d = out.data();
  for (std::size_t h = 0; h < curve.size(); ++h, d += harmonic_dofs) {
    k = k.turned(u);
    for (int i = 0; i < 3; ++i) {
      d[i] += k.c * n[i];
      d[3 + i] += k.s * n[i];
    }
  }
}

}  // namespace

template <int dim>
void SideTerms::add_parameters(const PairFrame& frame, const FieldValue& f, const ProbePoint& q, double w1)
{
  d_clearance -= w1;  // gap = distance - clearance
  for (int k = 0; k < 3; ++k) {
    dP[k] += w1 * f.n[k];
    dF[k] -= w1 * f.n[k];
  }
  const auto add_field = [&] {
    if (frame.F->solid)
      add_solid_field(*frame.F, q.p, w1);
    else
      add_field_size(f, w1);
  };
  if (frame.P->solid) {
    add_solid_probe(*frame.P, q, w1, {f.n.dot(frame.e1), f.n.dot(frame.e2), f.n.dot(frame.e3)});
    add_field();
    return;
  }
  if (frame.P->curve) {
    add_harmonics(*frame.P->curve, q.u, w1 * Vec3(f.n.dot(frame.e1), f.n.dot(frame.e2), f.n.dot(frame.e3)),
                  curve_P);
    dP[quantity_r0] -= w1;  // r1 is r0
    if (frame.difference != nullptr) {
      add_harmonics(*frame.difference, q.v, -w1 * f.n, curve_F);
      dF[quantity_r0] -= w1;
      return;
    }
    add_field();
    return;
  }
  const double nr = f.n.dot(q.radial), nz = f.n.dot(frame.e3);
  dP[quantity_R] += w1 * nr;
  if constexpr (dim == 1) {
    // The tube's surface point faces F: its profile normal is -(nr, nz). A change of r0 (r1) moves it by
    // cos^2 (sin^2) of its profile angle; both together by 1.
    const double m = std::max(nr * nr + nz * nz, 1e-300);
    dP[quantity_r0] -= w1 * nr * nr / m;
    dP[quantity_r1] -= w1 * nz * nz / m;
  } else {
    dP[quantity_r0] += w1 * nr * q.cv;
    dP[quantity_r1] += w1 * nz * q.sv;
  }
  add_field();
}

void SideTerms::add_field_size(const FieldValue& f, double w1)
{
  dF[quantity_R] -= w1 * f.m.nr;
  // At the closest profile point (R + r0 c, r1 s) of F.
  dF[quantity_r0] -= w1 * f.m.nr * f.m.c;
  dF[quantity_r1] -= w1 * f.m.nz * f.m.s;
}

void SideTerms::add_solid_field(const Body& F, const Vec3& p, double w1)
{
  curve_F.resize(F.solid->sizes().size(), 0.0);
  std::vector<double> d(curve_F.size());
  F.solid->distance_sizes(F.unit * p, d);
  for (std::size_t k = 0; k < d.size(); ++k) curve_F[k] += w1 * d[k];
}

void SideTerms::add_solid_probe(const Body& P, const ProbePoint& q, double w1, const Vec3& n)
{
  curve_P.resize(P.solid->sizes().size(), 0.0);
  std::vector<double> d(curve_P.size());
  P.solid->probe_sizes({q.u.c, q.u.s, q.v.c, q.v.s}, n, d);
  for (std::size_t k = 0; k < d.size(); ++k) curve_P[k] += w1 * d[k];
}

template void SideTerms::add_parameters<1>(const PairFrame&, const FieldValue&, const ProbePoint&, double);
template void SideTerms::add_parameters<2>(const PairFrame&, const FieldValue&, const ProbePoint&, double);

Vec6 gradient_along(const FieldValue& f, const Vec3& rho, const Vec3& t, bool on_p)
{
  const Vec3 kn = field_hessian(f, t);
  Vec6 x;
  if (on_p)
    x << kn, t.cross(f.n) + rho.cross(kn);
  else
    x << kn, rho.cross(kn);
  return x;
}

PairTerms to_world(const SideTerms& side, const Mat3& M, const Vec3& xi, int order)
{
  PairTerms t;
  t.energy = side.energy;
  if (order < 1) return t;
  const Vec3 ge = M * side.gradient.head<3>();
  const Vec3 gp = M * side.gradient.tail<3>();
  const Mat3 X = skew(xi);
  t.gradient << ge, gp, -(xi.cross(ge) + gp);  // ge . (xi x w_F ...) : d eta'/d w_F = skew(xi)
  if (order < 2) return t;

  const Mat6 local = side.hessian.selfadjointView<Eigen::Lower>();
  Mat6 H;
  H.topLeftCorner<3, 3>() = M * local.topLeftCorner<3, 3>() * M.transpose();
  H.topRightCorner<3, 3>() = M * local.topRightCorner<3, 3>() * M.transpose();
  H.bottomLeftCorner<3, 3>() = H.topRightCorner<3, 3>().transpose();
  H.bottomRightCorner<3, 3>() = M * local.bottomRightCorner<3, 3>() * M.transpose();

  // First-order map (eta, w_P, w_F) -> (eta', w_P') = (eta + X w_F, w_P - w_F), T = [I, (X; -I)]: T^T H T.
  const Eigen::Matrix<double, 6, 3> K = H.leftCols<3>() * X - H.rightCols<3>();
  t.hessian.topLeftCorner<6, 6>() = H;
  t.hessian.topRightCorner<6, 3>() = K;
  t.hessian.bottomLeftCorner<3, 6>() = K.transpose();
  t.hessian.bottomRightCorner<3, 3>() = X.transpose() * K.topRows<3>() - K.bottomRows<3>();

  // Second-order parts: ge . (-w_F x eta + 1/2 w_F x (w_F x xi)) + gp . (-1/2 w_F x w_P).
  const Mat3 G = skew(ge);  // ge.(-w x eta) = w.(-(eta x ge)) = w . (ge x eta) = w^T G eta
  t.hessian.block<3, 3>(6, 0) += G;
  t.hessian.block<3, 3>(0, 6) += G.transpose();
  t.hessian.block<3, 3>(6, 6) +=
      0.5 * (xi * ge.transpose() + ge * xi.transpose()) - xi.dot(ge) * Mat3::Identity();
  const Mat3 S = 0.5 * skew(gp);  // gp.(-1/2 w_F x w_P) = 1/2 w_F . (gp x w_P)
  t.hessian.block<3, 3>(6, 3) += S;
  t.hessian.block<3, 3>(3, 6) += S.transpose();
  return t;
}

namespace {

std::size_t further_quantities(const Body& body)
{
  if (body.solid) return body.solid->sizes().size();
  return body.curve ? harmonic_dofs * body.curve->size() : 0;
}

/// Of one body; d, further: of the side; turn: of its element, in the world.
std::vector<double> geometry_of(const Body& body, const Pose& pose, const Mat3& M,
                                const std::array<double, primitive_dofs>& d,
                                const std::vector<double>& further, const Vec3& turn)
{
  const Vec3 force = pose.rotation.transpose() * (M * Vec3(d[0], d[1], d[2]));
  const Vec3 own_turn = pose.rotation.transpose() * turn - body.center.cross(force);
  std::vector<double> out{force[0], force[1], force[2], d[3], d[4], d[5]};
  out.insert(out.end(), further.begin(), further.end());
  out.resize(primitive_dofs + further_quantities(body), 0.0);
  out.insert(out.end(), own_turn.begin(), own_turn.end());
  return out;
}

}  // namespace

GeometryTerms geometry_terms(const SideTerms& side, const Mat3& M, const Body& P, const Pose& pose_p,
                             const Body& F, const Pose& pose_f)
{
  const PairTerms world = to_world(side, M, pose_p.position - pose_f.position, 1);
  return {geometry_of(P, pose_p, M, side.dP, side.curve_P, world.gradient.segment<3>(3)),
          geometry_of(F, pose_f, M, side.dF, side.curve_F, world.gradient.segment<3>(6))};
}

}  // namespace hauberk
