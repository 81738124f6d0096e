#include "contact/published.hpp"

#include <algorithm>

namespace hauberk::published {
namespace {

using std::numbers::pi;

/// Samples of each surface along the ring and around the tube. The paper says "multiple samples on both
/// tori"; these numbers are assumed.
constexpr int ring_samples = 12, tube_samples = 6;
constexpr int samples = ring_samples * tube_samples;

constexpr int most_steps = 60;
constexpr double longest_step = 0.5;  ///< radians
/// Eigenvalues of H are replaced by their size, at least this part of the largest: steps go downhill.
constexpr double least_curvature = 1e-13;
/// A descent has arrived where the step is this short (radians); `refine` does the rest.
constexpr double arrived = 1e-6;
/// Minima closer than this are one (radians).
constexpr double same_minimum = 1e-5;

struct Samples {
  std::array<std::array<double, 2>, samples> angles;
  std::array<Vec3, samples> points;
};

Samples sample(double R, double r0, double r1, const Vec3& a, const Vec3& e1, const Vec3& e2, const Vec3& e3)
{
  Samples out;
  for (int i = 0; i < ring_samples; ++i) {
    const double u = 2.0 * pi * i / ring_samples;
    const Vec3 radial = std::cos(u) * e1 + std::sin(u) * e2;
    for (int j = 0; j < tube_samples; ++j) {
      const double v = 2.0 * pi * j / tube_samples;
      const int sample = i * tube_samples + j;
      const std::size_t k = sample;
      out.angles[k] = {u, v};
      out.points[k] = a + (R + r0 * std::cos(v)) * radial + r1 * std::sin(v) * e3;
    }
  }
  return out;
}

/// Newton step; where H is not positive definite, with its eigenvalues replaced by their sizes.
Eigen::Vector4d downhill(const TorusDistance<double>& at)
{
  const Eigen::Map<const Eigen::Vector4d> g(at.gradient.data());
  const Eigen::Matrix4d H = Eigen::Map<const Eigen::Matrix4d>(at.H[0].data());
  const Eigen::LLT<Eigen::Matrix4d> llt(H);
  if (llt.info() == Eigen::Success) return -llt.solve(g);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eig(H);
  const Eigen::Vector4d size = eig.eigenvalues().cwiseAbs();
  const Eigen::Vector4d l = size.cwiseMax(least_curvature * size.maxCoeff());
  return -eig.eigenvectors() * (eig.eigenvectors().transpose() * g).cwiseQuotient(l);
}

/// Newton's method from a sample, made to descend: steps of limited length, halved until the distance falls.
TorusCoordinates<double> descend(const TorusPair<double>& pair, TorusCoordinates<double> c, int& evaluations)
{
  TorusDistance<double> at = pair.at(c, DistanceOrder::hessian);
  ++evaluations;
  for (int it = 0; it < most_steps; ++it) {
    Eigen::Vector4d step = downhill(at);
    step *= std::min(1.0, longest_step / std::max(step.norm(), 1e-300));
    bool lower = false;
    for (double t = 1.0; t > 1e-3 && !lower; t *= 0.5) {
      TorusCoordinates<double> next = c;
      for (std::size_t k = 0; k < 4; ++k) next[k] += t * step[k];
      const TorusDistance<double> there = pair.at(next, DistanceOrder::hessian);
      ++evaluations;
      lower = there.d < at.d;
      if (lower) {
        c = next;
        at = there;
      }
    }
    if (!lower || step.norm() < arrived) break;
  }
  return c;
}

bool same(const TorusCoordinates<double>& a, const TorusCoordinates<double>& b)
{
  for (std::size_t k = 0; k < 4; ++k) {
    if (std::abs(std::remainder(a[k] - b[k], 2.0 * pi)) > same_minimum) return false;
  }
  return true;
}

}  // namespace

std::vector<PublishedMinimum> sampled_minima(const PairFrame& frame, int& evaluations)
{
  const Body &P = *frame.P, &F = *frame.F;
  const Samples p = sample(P.R, P.r0, P.r1, frame.a, frame.e1, frame.e2, frame.e3);
  const Samples f = sample(F.R, F.r0, F.r1, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ());
  // The nearest pair of samples for every ring angle of either torus: two minima on one ring have starts on
  // both sides of them.
  struct Start {
    double d = std::numeric_limits<double>::infinity();
    std::size_t on_p = 0, on_f = 0;
    bool operator==(const Start& o) const { return on_p == o.on_p && on_f == o.on_f; }
  };
  std::array<Start, 2 * ring_samples> starts;
  for (std::size_t i = 0; i < samples; ++i) {
    for (std::size_t j = 0; j < samples; ++j) {
      const double d = (p.points[i] - f.points[j]).squaredNorm();
      for (Start* s : {&starts[i / tube_samples], &starts[ring_samples + j / tube_samples]}) {
        if (d < s->d) *s = {d, i, j};
      }
    }
  }
  evaluations += samples;

  const TorusPair<double> pair = torus_pair(frame);
  std::vector<PublishedMinimum> out;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const Start& s = starts[k];
    const auto end = starts.begin() + static_cast<std::ptrdiff_t>(k);
    if (std::find(starts.begin(), end, s) != end) continue;
    const auto &a = p.angles[s.on_p], &b = f.angles[s.on_f];
    const PublishedMinimum m =
        refine(pair, descend(pair, {a[0], a[1], b[0], b[1]}, evaluations), evaluations);
    if (std::none_of(out.begin(), out.end(), [&m](const PublishedMinimum& o) { return same(o.c, m.c); }))
      out.push_back(m);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const PublishedMinimum& x, const PublishedMinimum& y) { return x.d < y.d; });
  return out;
}

}  // namespace hauberk::published
