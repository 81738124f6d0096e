#include "limits/orthogonal_parts.hpp"

#include "limits/symmetry.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <map>

namespace hauberk {
namespace {

/// The nearest orthogonal matrix, with entries that are 0 or +-1 up to rounding exactly that.
Mat3 orthogonal(const Mat3& m)
{
  constexpr double rounding = 1e-15;
  const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 O = svd.matrixU() * svd.matrixV().transpose();
  constexpr double identical = 1e-12;
  if ((O - Mat3::Identity()).norm() <= identical) return Mat3::Identity();
  for (double& x : O.reshaped()) {
    if (std::abs(x - std::round(x)) <= rounding) x = std::round(x);
  }
  return O;
}

void put_identity_first(std::vector<Mat3>& list)
{
  std::stable_partition(list.begin(), list.end(), [](const Mat3& O) { return O == Mat3::Identity(); });
}

/// A basis of the same lattice that nothing shortens: no sum or difference with the others is shorter than a
/// vector of it. Pairs are reduced first (Lagrange), so that idle long vectors take no more steps.
std::vector<Vec3> reduced(std::vector<Vec3> v)
{
  constexpr double shorter = 1.0 - 1e-12;  // ties must not go round in circles
  const auto improve = [&v](std::size_t k, const Vec3& candidate) {
    if (!(candidate.norm() < shorter * v[k].norm())) return false;
    v[k] = candidate;
    return true;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t k = 0; k < v.size(); ++k) {
      for (std::size_t j = 0; j < v.size(); ++j) {
        if (j == k) continue;
        const double steps = std::round(v[k].dot(v[j]) / v[j].squaredNorm());
        changed = improve(k, v[k] - steps * v[j]) || changed;
      }
      if (v.size() < 3) continue;
      const Vec3 a = v[(k + 1) % 3], b = v[(k + 2) % 3];
      for (const Vec3& d : {Vec3(a + b), Vec3(a - b), Vec3(-a - b), Vec3(b - a)})
        changed = improve(k, v[k] + d) || changed;
    }
  }
  std::stable_sort(v.begin(), v.end(),
                   [](const Vec3& a, const Vec3& b) { return a.squaredNorm() < shorter * b.squaredNorm(); });
  return v;
}

/// Sums of the vectors of a reduced basis with coefficients -1, 0, 1: in two and three dimensions its images
/// under symmetries of the lattice are among them.
std::vector<Vec3> short_sums(const std::vector<Vec3>& v)
{
  std::vector<Vec3> sums{Vec3::Zero()};
  for (const Vec3& x : v) {
    std::vector<Vec3> more;
    for (const Vec3& s : sums) {
      for (const double c : {1.0, 0.0, -1.0}) more.emplace_back(s + c * x);
    }
    sums = std::move(more);
  }
  return sums;
}

Mat3 columns(const std::vector<Vec3>& v)
{
  Mat3 m;
  for (int k = 0; k < 3; ++k) m.col(k) = v[k];
  return m;
}

/// Adds the O that maps each of `from` to that of `to` (three vectors each), if it is orthogonal.
void add_if_orthogonal(const std::vector<Vec3>& from, const std::vector<Vec3>& to, std::vector<Mat3>& out)
{
  const Mat3 m = columns(to) * columns(from).inverse();
  constexpr double far_from_orthogonal = 1e-3;
  if (!((m.transpose() * m - Mat3::Identity()).norm() < far_from_orthogonal)) return;
  const Mat3 O = orthogonal(m);
  for (std::size_t k = 0; k < 3; ++k) {
    if ((O * from[k] - to[k]).norm() > symmetry_tolerance(to[k])) return;
  }
  out.push_back(O);
}

/// All choices of images for the vectors from the k-th on, and their isometries.
void choose_images(const std::vector<Vec3>& basis, const std::vector<Vec3>& sums, std::vector<Vec3>& to,
                   std::vector<Mat3>& out)
{
  const std::size_t k = to.size();
  if (k == basis.size()) {
    if (k == 3) return add_if_orthogonal(basis, to, out);
    // A sheet: its normal keeps its place or turns over.
    std::vector<Vec3> from = basis;
    from.push_back(basis[0].cross(basis[1]).normalized());
    for (const double side : {1.0, -1.0}) {
      std::vector<Vec3> onto = to;
      onto.emplace_back(side * from[2]);
      add_if_orthogonal(from, onto, out);
    }
    return;
  }
  for (const Vec3& s : sums) {
    if (std::abs(s.norm() - basis[k].norm()) > symmetry_tolerance(s)) continue;
    to.push_back(s);
    choose_images(basis, sums, to, out);
    to.pop_back();
  }
}

}  // namespace

namespace {

/// Mirrors and half turns about the axis of a strip, which is along x, and about those across it.
std::vector<Mat3> parts_of_strip()
{
  std::vector<Mat3> out;
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0})
      for (const double z : {1.0, -1.0}) out.emplace_back(Vec3(x, y, z).asDiagonal());
  return out;
}

}  // namespace

std::vector<Mat3> lattice_point_group(const Model& m)
{
  if (m.lattice.size() == 1) return parts_of_strip();
  const std::vector<Vec3> basis = reduced(m.lattice);
  std::vector<Mat3> out;
  std::vector<Vec3> to;
  choose_images(basis, short_sums(basis), to, out);
  put_identity_first(out);
  return out;
}

std::vector<Mat3> patch_candidates(const Model& m, const std::vector<int>& kinds)
{
  // Elements by kind and distance from the axis; those that follow each other closely make a ring.
  struct Ring {
    int kind = 0;
    double radius = 0.0;  ///< of its last element
    std::vector<int> elements;
  };
  const auto place = [&m](int i) -> const Vec3& { return m.rest[i].position; };
  const auto radius = [&place](int i) { return std::hypot(place(i).x(), place(i).y()); };
  std::vector<std::pair<double, int>> order;
  for (int i = 0; i < m.element_count(); ++i) order.emplace_back(radius(i), i);
  std::sort(order.begin(), order.end());
  std::vector<Ring> rings;
  std::map<int, std::size_t> last;  // per kind: its latest ring
  for (const auto& [r, i] : order) {
    const int kind = kinds[i];
    const auto at = last.find(kind);
    if (at == last.end() || r - rings[at->second].radius > symmetry_tolerance(place(i))) {
      last[kind] = rings.size();
      rings.push_back({kind, r, {}});
    }
    Ring& ring = rings[last[kind]];
    ring.radius = r;
    ring.elements.push_back(i);
  }
  constexpr double least_radius = 0.1;  // L: nearer to the axis its direction is inaccurate
  const Ring* rarest = nullptr;
  for (const Ring& ring : rings) {
    if (ring.radius < least_radius) continue;
    if (!rarest || ring.elements.size() < rarest->elements.size() ||
        (ring.elements.size() == rarest->elements.size() && ring.radius > rarest->radius))
      rarest = &ring;
  }
  if (!rarest) return {Mat3::Identity()};
  const auto angle = [&place](int i) { return std::atan2(place(i).y(), place(i).x()); };
  const double own = angle(rarest->elements.front());
  std::vector<Mat3> out;
  for (const int j : rarest->elements) {
    for (const bool mirrored : {false, true}) {
      const double a = mirrored ? angle(j) + own : angle(j) - own, c = std::cos(a), s = std::sin(a);
      for (const double side : {1.0, -1.0}) {
        Mat3 O = Mat3::Zero();
        O.topLeftCorner<2, 2>() << c, mirrored ? s : -s, s, mirrored ? -c : c;
        O(2, 2) = side;
        out.push_back(orthogonal(O));
      }
    }
  }
  put_identity_first(out);
  return out;
}

}  // namespace hauberk
