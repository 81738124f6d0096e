#include "contact/torus_pair.hpp"

namespace hauberk {
namespace {

/// exp(w) x = x + w x x + 1/2 w x (w x x) + O(w^3), as jets in w = variables 3, 4, 5:
///   d(w x x)/dw_k = e_k x x,   d^2/dw_j dw_k of the rest = 1/2 (x_j e_k + x_k e_j) - delta_jk x.
std::array<PoseJet, 3> turned(const Vec3& x)
{
  std::array<PoseJet, 3> y;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<int>(i);
    y[i].v = x[row];
    for (std::size_t k = 0; k < 3; ++k) {
      y[i].g[3 + k] = Vec3::Unit(static_cast<int>(k)).cross(x)[row];
      for (std::size_t j = 0; j <= k; ++j) {
        double h = j == k ? -x[row] : 0.0;
        if (i == k) h += 0.5 * x[j];
        if (i == j) h += 0.5 * x[k];
        y[i].h[PoseJet::at(3 + k, 3 + j)] = h;
      }
    }
  }
  return y;
}

template <typename S>
std::array<S, 3> constant(const Vec3& x)
{
  return {S(x[0]), S(x[1]), S(x[2])};
}

template <typename S>
TorusPair<S> fixed_pair(const PairFrame& f)
{
  return {constant<S>(f.a), constant<S>(f.e1), constant<S>(f.e2), constant<S>(f.e3), S(f.P->R),
          S(f.P->r0),       S(f.P->r1),        S(f.F->R),         S(f.F->r0),        S(f.F->r1)};
}

}  // namespace

TorusPair<double> torus_pair(const PairFrame& frame) { return fixed_pair<double>(frame); }

TorusPair<PoseJet> pose_torus_pair(const PairFrame& frame)
{
  TorusPair<PoseJet> pair = fixed_pair<PoseJet>(frame);
  pair.a = turned(frame.a - frame.o);
  for (std::size_t k = 0; k < 3; ++k) {
    pair.a[k] += PoseJet::variable(frame.o[k], static_cast<int>(k));
  }
  pair.e1 = turned(frame.e1);
  pair.e2 = turned(frame.e2);
  pair.e3 = turned(frame.e3);
  return pair;
}

TorusPair<SizeJet> size_torus_pair(const PairFrame& frame)
{
  TorusPair<SizeJet> pair = fixed_pair<SizeJet>(frame);
  for (int k = 0; k < 3; ++k) pair.a[k] = SizeJet::variable(frame.a[k], k);
  pair.R = SizeJet::variable(frame.P->R, 3);
  pair.r0 = SizeJet::variable(frame.P->r0, 4);
  pair.r1 = SizeJet::variable(frame.P->r1, 5);
  pair.FR = SizeJet::variable(frame.F->R, 6);
  pair.fr0 = SizeJet::variable(frame.F->r0, 7);
  pair.fr1 = SizeJet::variable(frame.F->r1, 8);
  return pair;
}

}  // namespace hauberk
