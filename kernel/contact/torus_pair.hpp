#pragma once
/// Squared distance between surface points of two tori as a function of their chart coordinates (paper
/// equations (1) and (2)), with its derivatives in the coordinates, on any scalar type.

#include "geometry/pair_frame.hpp"
#include "numerics/jet.hpp"

#include <array>

namespace hauberk {

/// Chart coordinates of a point of each surface: (u, v) on P, (u, v) on F.
template <typename S>
using TorusCoordinates = std::array<S, 4>;

/// d = |V_P - V_F|^2 and its derivatives in c = (u_P, v_P, u_F, v_F); `H` is filled symmetrically.
template <typename S>
struct TorusDistance {
  S d;
  std::array<S, 4> gradient;
  std::array<std::array<S, 4>, 4> H;
};

/// What of it is wanted: the value comes first, everything up to the named order follows.
enum class DistanceOrder { value, gradient, hessian };

/// Both tori in F's frame (F's axis is e_z, its centre the origin): centre and axes of P, sizes of both.
template <typename S>
struct TorusPair {
  std::array<S, 3> a, e1, e2, e3;
  S R, r0, r1;     ///< P
  S FR, fr0, fr1;  ///< F

  /// With rad = cos u e1 + sin u e2, tan = -sin u e1 + cos u e2, W = R + r0 cos v, a chart is
  ///   V    = a + W rad + r1 sin v e3,
  ///   V_u  = W tan,                        V_v  = -r0 sin v rad + r1 cos v e3,
  ///   V_uu = -W rad,   V_uv = -r0 sin v tan,   V_vv = -r0 cos v rad - r1 sin v e3.
  /// So with r = V_P - V_F every derivative of d = r . r is a product of these factors with the components
  /// of r in both triads (rad, tan, e3) and the nine cosines between the triads.
  TorusDistance<S> at(const TorusCoordinates<S>& c, DistanceOrder order) const
  {
    using std::cos;
    using std::sin;
    const S cu = cos(c[0]), su = sin(c[0]), cv = cos(c[1]), sv = sin(c[1]);
    const S fcu = cos(c[2]), fsu = sin(c[2]), fcv = cos(c[3]), fsv = sin(c[3]);

    using Triad = std::array<S, 3>;
    const auto in_f = [&](const Triad& x) {
      return Triad{x[0] * fcu + x[1] * fsu, x[1] * fcu - x[0] * fsu, x[2]};
    };
    const auto dot = [](const Triad& x, const Triad& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; };
    const Triad g1 = in_f(e1), g2 = in_f(e2), g3 = in_f(e3), center = in_f(a);
    Triad rad, tan, r;
    const S w = R + r0 * cv, q = r0 * sv, p = r1 * sv, t = r1 * cv;
    const S fw = FR + fr0 * fcv, fq = fr0 * fsv, fp = fr1 * fsv, ft = fr1 * fcv;
    for (std::size_t k = 0; k < 3; ++k) {
      rad[k] = cu * g1[k] + su * g2[k];
      tan[k] = cu * g2[k] - su * g1[k];
      r[k] = center[k] + w * rad[k] + p * g3[k];
    }
    r[0] -= fw;
    r[2] -= fp;

    TorusDistance<S> out;
    out.d = dot(r, r);
    if (order == DistanceOrder::value) return out;
    const S x = dot(r, rad), y = dot(r, tan), z = dot(r, g3);
    out.gradient = {2.0 * (w * y), 2.0 * (t * z - q * x), -2.0 * (fw * r[1]), 2.0 * (fq * r[0] - ft * r[2])};
    if (order == DistanceOrder::gradient) return out;

    auto& H = out.H;
    H[0][0] = 2.0 * (w * (w - x));
    H[0][1] = -2.0 * (q * y);
    H[1][1] = 2.0 * (q * q + t * t - (r0 * cv) * x - p * z);
    H[2][2] = 2.0 * (fw * (fw + r[0]));
    H[2][3] = 2.0 * (fq * r[1]);
    H[3][3] = 2.0 * (fq * fq + ft * ft + (fr0 * fcv) * r[0] + fp * r[2]);
    // -2 V_P,i . V_F,j
    H[0][2] = -2.0 * ((w * fw) * tan[1]);
    H[0][3] = 2.0 * (w * (fq * tan[0] - ft * tan[2]));
    const Triad Pv{t * g3[0] - q * rad[0], t * g3[1] - q * rad[1], t * g3[2] - q * rad[2]};
    H[1][2] = -2.0 * (fw * Pv[1]);
    H[1][3] = 2.0 * (fq * Pv[0] - ft * Pv[2]);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) H[i][j] = H[j][i];
    }
    return out;
  }
};

/// V(u, v) of a body in its own frame, equation (1).
inline Vec3 chart_point(const Body& b, double u, double v)
{
  const double w = b.R + b.r0 * std::cos(v);
  return {w * std::cos(u), w * std::sin(u), b.r1 * std::sin(v)};
}

/// The pair as it stands.
TorusPair<double> torus_pair(const PairFrame& frame);

/// The six relative unknowns (eta, w): P's points at r = eta + o + exp(w)(p - o), w about P's element origin.
using PoseJet = Jet<6, 2>;
TorusPair<PoseJet> pose_torus_pair(const PairFrame& frame);

/// The ten parameters: shift of P's centre against F's, R, r0, r1 of P, then of F, and the clearance (which
/// no chart depends on).
using SizeJet = Jet<10, 1>;
TorusPair<SizeJet> size_torus_pair(const PairFrame& frame);

}  // namespace hauberk
