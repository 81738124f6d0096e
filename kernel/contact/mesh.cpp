#include "contact/mesh.hpp"

#include "contact/barrier.hpp"
#include "geometry/facets.hpp"

#include <cmath>

namespace hauberk {
namespace {

/// Edges are nearly parallel below this part of |e_P|^2 |e_F|^2 of |e_P x e_F|^2 (Li et al. 2020,
/// section 5.3, with rest lengths: rigid edges keep theirs).
constexpr double nearly_parallel = 1e-3;

/// A function of the turn w of P alone, to second order.
struct TurnTerms {
  double value = 1.0;
  Vec3 gradient = Vec3::Zero();
  Mat3 hessian = Mat3::Zero();
};

/// Mollifier of two edges: m(c) = (2 - x) x with x = c/eps for c = |p x f|^2 < eps, else 1. With k = p . f is
/// c = |p|^2 |f|^2 - k^2, and turning p by exp(w) changes k by w . (p x f) + 1/2 ((w.p)(w.f) - |w|^2 k).
TurnTerms mollifier(const Vec3& p, const Vec3& f, bool derivatives)
{
  TurnTerms out;
  const Vec3 cross = p.cross(f);
  const double eps = nearly_parallel * p.squaredNorm() * f.squaredNorm();
  const double x = cross.squaredNorm() / eps;
  if (x >= 1.0) return out;
  out.value = (2.0 - x) * x;
  if (!derivatives) return out;
  const double k = p.dot(f), slope = 2.0 * (1.0 - x) / eps, bend = -2.0 / (eps * eps);
  const Vec3 dc = -2.0 * k * cross;
  Mat3 ddk = 0.5 * (p * f.transpose() + f * p.transpose());
  ddk.diagonal().array() -= k;
  const Mat3 ddc = -2.0 * (cross * cross.transpose() + k * ddk);
  out.gradient = slope * dc;
  out.hessian = slope * ddc + bend * dc * dc.transpose();
  return out;
}

/// Derivatives of the gap of two features in (eta, w), see SideTerms.
///
/// With r = on_P - on_F of length d, n = r/d, r_q = [I, -skew(rho)] and r_c = tangents of the free
/// coordinates c, eliminating c from |r(q, c)| leaves, with X = n . r_qc and G = r_c^T r_c,
///
///   g_q = r_q^T n,   g_qq = 1/d r_q^T Q r_q + n . r_qq - r_q^T r_c G^-1 X^T - X G^-1 r_c^T r_q - d X G^-1
///   X^T.
///
/// Q = I - n n^T - r_c G^-1 r_c^T is what of space neither the normal nor the tangents span: nothing for two
/// of them, so nothing large cancels at small gaps.
struct GapTerms {
  Vec6 gradient;
  Mat6 hessian;
};

Eigen::Matrix<double, 3, 6> moved_by(const Vec3& rho)
{
  Eigen::Matrix<double, 3, 6> out;
  out.leftCols<3>().setIdentity();
  out.rightCols<3>() << 0.0, rho.z(), -rho.y(), -rho.z(), 0.0, rho.x(), rho.y(), -rho.x(), 0.0;
  return out;
}

GapTerms gap_terms(const NearestFeatures& at, const Vec3& rho, int order)
{
  GapTerms out;
  const Vec3& n = at.normal;
  out.gradient << n, rho.cross(n);
  if (order < 2) return out;
  const Eigen::Matrix<double, 3, 6> rq = moved_by(rho);
  out.hessian.setZero();
  if (at.free == 0) {
    const Eigen::Matrix<double, 3, 6> across = rq - n * (n.transpose() * rq);
    out.hessian = across.transpose() * across / at.distance;
  } else if (at.free == 1) {
    const Vec3 t = (at.tangent_p[0] - at.tangent_f[0]).normalized();
    const Vec6 across = rq.transpose() * n.cross(t);
    out.hessian = across * across.transpose() / at.distance;
  }
  Mat3 turn = 0.5 * (n * rho.transpose() + rho * n.transpose());
  turn.diagonal().array() -= n.dot(rho);
  out.hessian.bottomRightCorner<3, 3>() += turn;
  if (at.free == 0) return out;

  const auto free = static_cast<Eigen::Index>(at.free);
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 2> rc(3, free);
  Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, 2> X(6, free);
  for (Eigen::Index k = 0; k < free; ++k) {
    const std::size_t i = k;
    rc.col(k) = at.tangent_p[i] - at.tangent_f[i];
    X.col(k) << Vec3::Zero(), at.tangent_p[i].cross(n);
  }
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2, 2> G = rc.transpose() * rc;
  const auto XG = (X * G.inverse()).eval();
  const Mat6 mixed = XG * (rc.transpose() * rq);
  out.hessian -= mixed + mixed.transpose() + at.distance * XG * X.transpose();
  return out;
}

/// How nearest points move with the sizes and places of both bodies; that edges turn with sizes, which the
/// mollifier sees, is left out.
void add_parameters(const PairFrame& frame, const NearestFeatures& at, double w1, SideTerms& out)
{
  out.d_clearance -= w1;
  const auto add = [w1](const Facets& facets, const FacetPoint& point, const Vec3& n,
                        std::array<double, primitive_dofs>& d, std::vector<double>& curve) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(point.count); ++k) {
      const double w = w1 * point.weights[k];
      const Vec3 by = facets.size_derivative(point.points[k]).transpose() * n;
      for (std::size_t q = 0; q < 3; ++q) d[3 + q] += w * by[q];
      facets.add_own_sizes(point.points[k], w * n, curve);
    }
  };
  for (int k = 0; k < 3; ++k) {
    out.dP[k] += w1 * at.normal[k];
    out.dF[k] -= w1 * at.normal[k];
  }
  const Vec3 own(frame.e1.dot(at.normal), frame.e2.dot(at.normal), frame.e3.dot(at.normal));
  add(*frame.P->facets, at.p, own, out.dP, out.curve_P);
  add(*frame.F_facets, at.f, -at.normal, out.dF, out.curve_F);
}

class MeshTerms {
 public:
  MeshTerms(const PairFrame& frame, const ContactSettings& settings, const Request& request, SideTerms& out)
      : frame_(frame), settings_(settings), request_(request), out_(out)
  {
  }

  void add(const FeaturePair& pair, const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& f)
  {
    ++out_.evaluations;
    const NearestFeatures at = nearest_features(pair, p, f);
    const double gap = at.distance - settings_.clearance;
    out_.min_gap = std::min(out_.min_gap, gap);
    if (gap <= 0.0 || gap >= settings_.g_hat) return;
    TurnTerms m;
    if (pair.edges()) m = mollifier(p[1] - p[0], f[1] - f[0], request_.order >= 1);
    const BarrierValue b = barrier<0>(gap, settings_.g_hat);
    out_.energy += m.value * b.b;
    if (request_.order >= 1) add_derivatives(at, m, b);
    if (request_.parameters) add_parameters(frame_, at, m.value * b.db, out_);
    if (request_.points && m.value > 0.0)
      out_.points.push_back({at.on_p, at.on_f, at.normal, gap, -m.value * b.db});
  }

 private:
  void add_derivatives(const NearestFeatures& at, const TurnTerms& m, const BarrierValue& b)
  {
    const GapTerms g = gap_terms(at, at.on_p - frame_.o, request_.order);
    out_.gradient += (m.value * b.db) * g.gradient;
    out_.gradient.tail<3>() += b.b * m.gradient;
    if (request_.order < 2) return;
    out_.hessian += (m.value * b.ddb) * g.gradient * g.gradient.transpose() + (m.value * b.db) * g.hessian;
    if (m.value == 1.0) return;
    Vec6 turn;
    turn << Vec3::Zero(), m.gradient;
    out_.hessian += b.db * (turn * g.gradient.transpose() + g.gradient * turn.transpose());
    out_.hessian.bottomRightCorner<3, 3>() += b.b * m.hessian;
  }

  const PairFrame& frame_;
  const ContactSettings& settings_;
  const Request& request_;
  SideTerms& out_;
};

}  // namespace

void add_mesh(const PairFrame& frame, const ContactSettings& settings, const Request& request, SideTerms& out)
{
  MeshTerms terms(frame, settings, request, out);
  near_features(frame, settings.g_hat + settings.clearance,
                [&terms](const FeaturePair& pair, const std::array<Vec3, 3>& p,
                         const std::array<Vec3, 3>& f) { terms.add(pair, p, f); });
}

double smallest_feature_distance(const PairFrame& frame, double range)
{
  // Few features are near: ranges grow until what is found is within what was looked at.
  constexpr int attempts = 4;
  constexpr double growth = 8.0;
  double smallest = std::numeric_limits<double>::infinity();
  for (int k = 1; k <= attempts; ++k) {
    const double r = range * std::pow(growth, k - attempts);
    near_features(frame, r,
                  [&](const FeaturePair& pair, const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& f) {
                    smallest = std::min(smallest, nearest_features(pair, p, f).distance);
                  });
    if (smallest <= r) break;
  }
  return smallest < range ? smallest : std::numeric_limits<double>::infinity();
}

std::vector<FeatureGap> feature_gaps(const PairFrame& frame, double range, double clearance)
{
  std::vector<FeatureGap> out;
  near_features(frame, range + clearance,
                [&](const FeaturePair& pair, const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& f) {
                  const NearestFeatures at = nearest_features(pair, p, f);
                  if (at.distance >= range + clearance) return;
                  FeatureGap g;
                  g.gap = at.distance - clearance;
                  g.terms.gradient << at.normal, (at.on_p - frame.o).cross(at.normal);
                  add_parameters(frame, at, 1.0, g.terms);
                  out.push_back(g);
                });
  return out;
}

}  // namespace hauberk
