#include "contact/published.hpp"

#include "contact/formulation.hpp"

#include <algorithm>

namespace hauberk {
namespace {

using published::PublishedMinimum;

constexpr int most_newton_steps = 30;

/// Eigenvalues of H below this part of the largest are rounding.
constexpr double eigenvalue_rounding = 1e-14;

/// A minimum's gradient is below this part of the largest that a distance sqrt(d) allows, or is rounding.
constexpr double stationary = 1e-6;
constexpr double gradient_rounding = 1e-14;

/// The inverse of H by its eigenvectors, without those whose eigenvalue is rounding: at a merge of two minima
/// the minimum does not respond smoothly, and the fade takes the contact out.
Eigen::Matrix4d inverse_hessian(const PublishedMinimum& m)
{
  Eigen::Vector4d inverse;
  for (int k = 0; k < 4; ++k) {
    const double l = m.eigenvalues[k];
    inverse[k] = l > eigenvalue_rounding * m.eigenvalues[3] ? 1.0 / l : 0.0;
  }
  return m.eigenvectors * inverse.asDiagonal() * m.eigenvectors.transpose();
}

/// One step of the implicit-function theorem. d_c(c(q), q) = 0 defines c(q); Newton's method on truncated
/// Taylor series doubles the number of exact terms: from constant c the first step
///   c <- c - H^-1 d_c(c, q)
/// makes first derivatives exact, c_q = -H^-1 d_cq (paper eq. (7)), the second one second derivatives. The
/// value of c stays.
template <typename S>
void respond(TorusCoordinates<S>& c, std::array<S, 4> residual, const Eigen::Matrix4d& inverse)
{
  for (std::size_t i = 0; i < 4; ++i) {
    residual[i].v = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      c[k] -= inverse(static_cast<int>(k), static_cast<int>(i)) * residual[i];
    }
  }
}

/// s b/d_hat^2 (equation (11)) of one minimum. With a clearance delta the squared gap (sqrt(d) - delta)^2
/// takes the place of d, and `lambda` is an eigenvalue of its Hessian.
template <typename S>
S faded_barrier(const S& d, const S& lambda, const S& clearance, double g_hat)
{
  using std::sqrt;
  const S gap = sqrt(d) - clearance;
  const double d_hat = g_hat * g_hat;
  const S h = published::fade((1.0 / (published::lambda_bar * d_hat)) * lambda);
  const S x = (1.0 / d_hat) * (gap * gap);
  return published::smooth_factor(x, h) * published::barrier(x);
}

class Contact {
 public:
  Contact(const PairFrame& frame, const ContactSettings& settings, const PublishedMinimum& m)
      : frame_(frame), settings_(settings), m_(m)
  {
    const double d_hat = settings.g_hat * settings.g_hat;
    gap_ = std::sqrt(m.d) - settings.clearance;
    width_ = published::eigenvalue_width * published::lambda_bar * d_hat;
    lambda_ = lowest({m.eigenvalues[0], 0.0, m.eigenvalues[1]}, m.d, settings.clearance);
    faded_ = lambda_ < published::lambda_bar * d_hat && gap_ * gap_ > published::d1 * d_hat;
  }

  void add(const Request& request, SideTerms& out) const
  {
    const double energy = faded_barrier(m_.d, lambda_, settings_.clearance, settings_.g_hat);
    out.energy += energy;
    if (request.order >= 1) add_pose(out, request.order);
    if (request.parameters) add_sizes(out);
    if (request.points) add_point(out);
  }

 private:
  template <typename S>
  S energy(const TorusPair<S>& pair, const S& clearance, int order, int& evaluations) const
  {
    const Eigen::Matrix4d inverse = inverse_hessian(m_);
    TorusCoordinates<S> c{S(m_.c[0]), S(m_.c[1]), S(m_.c[2]), S(m_.c[3])};
    respond(c, pair.at(c, DistanceOrder::gradient).gradient, inverse);
    evaluations += 2;
    if (!faded_) {
      // d_c = 0: d(c(q), q) to second order needs c to first order only. The factor is constant.
      return faded_barrier(pair.at(c, DistanceOrder::value).d, S(lambda_), clearance, settings_.g_hat);
    }
    if (order >= 2) {
      respond(c, pair.at(c, DistanceOrder::gradient).gradient, inverse);
      ++evaluations;
    }
    const TorusDistance<S> at = pair.at(c, DistanceOrder::hessian);
    const std::array<S, 3> B = published::lowest_block(at.H, m_.eigenvectors, m_.eigenvalues);
    return faded_barrier(at.d, lowest(B, at.d, clearance), clearance, settings_.g_hat);
  }

  /// Smallest eigenvalue of the Hessian of the squared gap e = (sqrt(d) - delta)^2: at a stationary point it
  /// is e'(d) d_cc with e' = 1 - delta/sqrt(d). `B` has the two smallest of d_cc.
  template <typename S>
  S lowest(const std::array<S, 3>& B, const S& d, const S& clearance) const
  {
    using std::sqrt;
    const S slope = 1.0 - clearance * inverse(sqrt(d));
    return published::soft_minimum(slope * B[0], slope * B[1], slope * B[2], width_);
  }

  void add_pose(SideTerms& out, int order) const
  {
    const PoseJet e = energy(pose_torus_pair(frame_), PoseJet(settings_.clearance), 2, out.evaluations);
    for (int i = 0; i < 6; ++i) {
      out.gradient[i] += e.g[i];
      if (order < 2) continue;
      for (int j = 0; j < 6; ++j) {
        out.hessian(i, j) += e.h[PoseJet::at(static_cast<std::size_t>(i), static_cast<std::size_t>(j))];
      }
    }
  }

  void add_sizes(SideTerms& out) const
  {
    const SizeJet e =
        energy(size_torus_pair(frame_), SizeJet::variable(settings_.clearance, 9), 1, out.evaluations);
    for (std::size_t k = 0; k < 3; ++k) {
      out.dP[k] += e.g[k];
      out.dF[k] -= e.g[k];
      out.dP[3 + k] += e.g[3 + k];
      out.dF[3 + k] += e.g[6 + k];
    }
    out.d_clearance += e.g[9];
  }

  /// The force along the normal. Where the contact is faded its eigenvalue pushes too, in the pose as a
  /// whole and not at a point: that part is in the gradient only.
  void add_point(SideTerms& out) const
  {
    using GapJet = Jet<1, 1>;
    const GapJet distance = GapJet::variable(gap_ + settings_.clearance, 0);
    const GapJet e =
        faded_barrier(distance * distance, GapJet(lambda_), GapJet(settings_.clearance), settings_.g_hat);
    ContactPoint p;
    const Vec3 local = chart_point(*frame_.P, m_.c[0], m_.c[1]);
    p.on_p = frame_.a + local.x() * frame_.e1 + local.y() * frame_.e2 + local.z() * frame_.e3;
    p.on_f = chart_point(*frame_.F, m_.c[2], m_.c[3]);
    // F's outward normal: the difference of the points is rounding where the gap is small.
    const Body& F = *frame_.F;
    const double radial = F.r1 * std::cos(m_.c[3]);
    p.normal =
        Vec3(radial * std::cos(m_.c[2]), radial * std::sin(m_.c[2]), F.r0 * std::sin(m_.c[3])).normalized();
    p.gap = gap_;
    p.force = -e.g[0];
    out.points.push_back(p);
  }

  const PairFrame& frame_;
  const ContactSettings& settings_;
  const PublishedMinimum& m_;
  double gap_ = 0.0;
  double width_ = 0.0;   ///< of the smooth minimum of two eigenvalues
  double lambda_ = 0.0;  ///< smallest eigenvalue of the Hessian of the squared gap
  bool faded_ = false;   ///< the factor s varies here
};

}  // namespace

namespace published {

template <int dim>
TorusCoordinates<double> chart_start(const PairFrame& frame, const Minimum& m)
{
  const ProbePoint q = Probe<dim>(frame).at(m.u, m.v);
  const FieldValue f = field_at(*frame.F, q.p);
  double v = m.v;
  // The tube's surface point faces F; the normal points from F to P.
  if constexpr (dim == 1) v = std::atan2(-f.n.dot(frame.e3), -f.n.dot(q.radial));
  return {m.u, v, std::atan2(q.p.y(), q.p.x()), std::atan2(f.m.s, f.m.c)};
}

template TorusCoordinates<double> chart_start<1>(const PairFrame&, const Minimum&);
template TorusCoordinates<double> chart_start<2>(const PairFrame&, const Minimum&);

PublishedMinimum refine(const TorusPair<double>& pair, TorusCoordinates<double> c, int& evaluations)
{
  PublishedMinimum m;
  double best = std::numeric_limits<double>::infinity();
  TorusDistance<double> found{};
  for (int k = 0; k < most_newton_steps; ++k) {
    const TorusDistance<double> at = pair.at(c, DistanceOrder::hessian);
    ++evaluations;
    const Eigen::Map<const Eigen::Vector4d> g(at.gradient.data());
    const double slope = g.norm();
    if (!(slope < best)) break;
    best = slope;
    m.c = c;
    found = at;
    const Eigen::Matrix4d H = Eigen::Map<const Eigen::Matrix4d>(at.H[0].data());
    const Eigen::Vector4d step = -H.ldlt().solve(g);
    for (std::size_t i = 0; i < 4; ++i) c[i] += step[i];
  }
  m.d = found.d;
  const Eigen::Matrix4d H = Eigen::Map<const Eigen::Matrix4d>(found.H[0].data());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eig(H);
  m.eigenvalues = eig.eigenvalues();
  m.eigenvectors = eig.eigenvectors();
  const double largest = m.eigenvalues[3];
  m.converged = best <= stationary * std::sqrt(largest * found.d) + gradient_rounding * largest &&
                m.eigenvalues[0] > -eigenvalue_rounding * largest;
  return m;
}

}  // namespace published

template <int dim>
void add_published(const PairFrame& frame, const ContactSettings& settings, const Request& request,
                   SideTerms& out)
{
  const auto add = [&](const PublishedMinimum& m) {
    const double gap = std::sqrt(m.d) - settings.clearance;
    if (m.converged && gap > 0.0 && gap < settings.g_hat) Contact(frame, settings, m).add(request, out);
  };
  if (settings.search == MinimaSearch::sampled) {
    for (const PublishedMinimum& m : published::sampled_minima(frame, out.evaluations)) {
      out.min_gap = std::min(out.min_gap, std::sqrt(m.d) - settings.clearance);
      add(m);
    }
    return;
  }
  const TorusPair<double> pair = torus_pair(frame);
  for (const Minimum& found : local_minima<dim>(frame, settings.g_hat + settings.clearance, out.evaluations,
                                                {}, settings.keep_going)) {
    out.min_gap = std::min(out.min_gap, found.distance - settings.clearance);
    if (found.distance <= settings.clearance) continue;  // min_gap tells
    add(published::refine(pair, published::chart_start<dim>(frame, found), out.evaluations));
  }
}

template void add_published<1>(const PairFrame&, const ContactSettings&, const Request&, SideTerms&);
template void add_published<2>(const PairFrame&, const ContactSettings&, const Request&, SideTerms&);

}  // namespace hauberk
