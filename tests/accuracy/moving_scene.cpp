#include "moving_scene.hpp"

#include <scenes.hpp>
#include "nearest_pair.hpp"
#include "random_pairs.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk::brute {
namespace {

constexpr Sampling quick{384, 72, 24};
constexpr int substeps = 2000;
constexpr int cells = 3;  ///< images searched each way

double uniform(std::mt19937_64& rng, double lo, double hi)
{
  return std::uniform_real_distribution<double>(lo, hi)(rng);
}

std::array<double, 3> random_size(double R, bool round, std::mt19937_64& rng)
{
  const double r0 = R * uniform(rng, 0.05, 0.22);
  return {R, r0, round ? r0 : r0 * std::pow(3.0, uniform(rng, -1.0, 1.0))};
}

std::vector<double> values(std::initializer_list<std::array<double, 3>> sizes)
{
  std::vector<double> v;
  for (const auto& s : sizes) v.insert(v.end(), s.begin(), s.end());
  return v;
}

Torus torus(const std::array<double, 3>& size, const Vec3& center, const Mat3& axes)
{
  return {center, axes, size[0], size[1], size[2]};
}

/// Pose of a ring that links with a ring at the origin and keeps 0.01 away from it. Tubes too thick for each
/// other are made thinner.
Pose linked_pose(std::array<double, 3>& first, std::array<double, 3>& second, std::mt19937_64& rng)
{
  for (int attempt = 1;; ++attempt) {
    Pose p;
    p.rotation = any_rotation(rng);
    p.position = first[0] * Vec3(1, 0, 0) + uniform(rng, 0.0, 0.8) * any_direction(rng);
    const Torus a = torus(first, Vec3::Zero(), Mat3::Identity()), b = torus(second, p.position, p.rotation);
    if (surface_distance(a, b, quick) > 0.01 && gauss_linking(a, b) != 0) return p;
    if (attempt % 20 != 0) continue;
    for (std::size_t k : {1, 2}) {
      first[k] *= 0.8;
      second[k] *= 0.8;
    }
  }
}

class Watcher {
 public:
  Watcher(const Model& m, const TorusAt& at, double keep, double until)
      : m_(m), at_(at), keep_(keep), until_(until)
  {
    out_.smallest = 1e300;
  }

  Watched run()
  {
    const int n = static_cast<int>(m_.bodies.size());
    const int range = m_.lattice.empty() ? 0 : cells;
    for (int a = 0; a < n; ++a) {
      for (int b = a; b < n; ++b) {
        for (int i = -range; i <= range; ++i) {
          for (int j = -range; j <= range; ++j) {
            const bool same = m_.bodies[a].element == m_.bodies[b].element;
            if (same && i == 0 && j == 0) continue;
            if (a == b && (i < 0 || (i == 0 && j < 0))) continue;
            pair(a, b, {i, j});
          }
        }
      }
    }
    return out_;
  }

 private:
  double gap(int a, int b, const Image& image, double s)
  {
    ++out_.looks;
    return nearest_place(at_(a, {0, 0}, s), at_(b, image, s)).distance - m_.clearance;
  }

  void pair(int a, int b, const Image& image)
  {
    // Fastest approach of surfaces over 64 intervals, from centres and axes (the ring as a rigid frame).
    double speed = 0.0, closest = 1e300;
    constexpr int intervals = 64;
    Torus pa = at_(a, {0, 0}, 0.0), pb = at_(b, image, 0.0);
    for (int k = 1; k <= intervals; ++k) {
      const Torus qa = at_(a, {0, 0}, static_cast<double>(k) / intervals),
                  qb = at_(b, image, static_cast<double>(k) / intervals);
      const auto turn = [](const Torus& p, const Torus& q) { return (p.axes - q.axes).norm() * q.bound(); };
      const auto grow = [](const Torus& p, const Torus& q) {
        return std::abs(p.R - q.R) + std::max(std::abs(p.r0 - q.r0), std::abs(p.r1 - q.r1));
      };
      const double step = ((qa.center - qb.center) - (pa.center - pb.center)).norm() + turn(pa, qa) +
                          turn(pb, qb) + grow(pa, qa) + grow(pb, qb);
      speed = std::max(speed, step * intervals);
      closest = std::min({closest, (pa.center - pb.center).norm() - pa.bound() - pb.bound() - step,
                          (qa.center - qb.center).norm() - qa.bound() - qb.bound() - step});
      pa = qa;
      pb = qb;
    }
    if (closest > m_.clearance) return;
    follow(a, b, image, 2.0 * speed);
    const auto link = [&](double s) { return gauss_linking(at_(a, {0, 0}, s), at_(b, image, s)); };
    if (link(0.0) != link(until_)) ++out_.changed_links;
  }

  void follow(int a, int b, const Image& image, double speed)
  {
    const double first = gap(a, b, image, 0.0);
    double s0 = 0.0, g0 = first, s1 = 0.0, g1 = first, s = 0.0;
    note(first, 0.0);
    bool near = false;
    while (s < 1.0) {
      const double free = speed > 0.0 ? 0.9 * std::max(0.0, g1 - keep_ * first) / speed : 1.0;
      s = std::min(1.0, s1 + std::max(free, 1.0 / substeps));
      const double g = gap(a, b, image, s);
      note(g, s);
      if (!near && g <= keep_ * first) {
        near = true;
        record(out_.near, crossing(a, b, image, s1, s, keep_ * first));
      }
      if (g <= 0.0) {
        record(out_.contact, crossing(a, b, image, s1, s, 0.0));
        return;
      }
      if (g1 < g0 && g1 <= g && closest_approach(a, b, image, s0, s1, s)) return;
      s0 = s1;
      g0 = g1;
      s1 = s;
      g1 = g;
      if (out_.contact && s > *out_.contact) return;  // another pair touches earlier
    }
  }

  void note(double g, double s)
  {
    if (s <= until_) out_.smallest = std::min(out_.smallest, g);
  }

  static void record(std::optional<double>& first, double s)
  {
    if (!first || s < *first) first = s;
  }

  double crossing(int a, int b, const Image& image, double lo, double hi, double level)
  {
    for (int k = 0; k < 25; ++k) {
      const double mid = 0.5 * (lo + hi);
      (gap(a, b, image, mid) > level ? lo : hi) = mid;
    }
    return hi;
  }

  /// Narrows a dip between samples; true if surfaces meet in it.
  bool closest_approach(int a, int b, const Image& image, double lo, double mid, double hi)
  {
    double best = gap(a, b, image, mid);
    if (best > 0.05) return false;
    for (int k = 0; k < 30; ++k) {
      for (const double x : {0.5 * (lo + mid), 0.5 * (mid + hi)}) {
        const double g = gap(a, b, image, x);
        note(g, x);
        if (g <= 0.0) {
          record(out_.contact, crossing(a, b, image, lo, x, 0.0));
          return true;
        }
        if (g < best) {
          best = g;
          (x < mid ? hi : lo) = mid;
          mid = x;
          break;
        }
        (x < mid ? lo : hi) = x;
      }
    }
    return false;
  }

  const Model& m_;
  const TorusAt& at_;
  double keep_, until_;
  Watched out_;
};

}  // namespace

RandomScene random_scene(long k, std::mt19937_64& rng)
{
  RandomScene out;
  const bool first_round = k % 3 != 2, second_round = k % 3 == 0;
  std::array<double, 3> A = random_size(1.0, first_round, rng);
  std::array<double, 3> B = random_size(uniform(rng, 0.6, 1.6), second_round, rng);
  SceneSpec& s = out.spec;
  s.length = 1.0;
  s.lattice = {Vec3(7, 0, 0), Vec3(1, 7, 0)};
  s.types.push_back({"ring", std::make_shared<test::Rings>()});
  const auto place = [&](const std::array<double, 3>& size, const Pose& pose) {
    s.elements.push_back({0, values({size}), pose});
  };
  switch ((k / 3) % 4) {
    case 0: {
      out.what = "linked pair";
      const Pose pose = linked_pose(A, B, rng);
      place(A, {});
      place(B, pose);
      break;
    }
    case 1: {
      out.what = "linked pair and free ring";
      const Pose pose = linked_pose(A, B, rng);
      place(A, {});
      place(B, pose);
      const std::array<double, 3> C = random_size(uniform(rng, 0.5, 1.0), first_round, rng);
      for (;;) {
        const Pose free{uniform(rng, 0.0, 3.0) * any_direction(rng), any_rotation(rng)};
        const Torus t = torus(C, free.position, free.rotation);
        if (surface_distance(t, torus(A, Vec3::Zero(), Mat3::Identity()), quick) > 0.01 &&
            surface_distance(t, torus(B, pose.position, pose.rotation), quick) > 0.01) {
          place(C, free);
          break;
        }
      }
      break;
    }
    case 2: {
      out.what = "elements of two rings";
      // A second ring on the far side of each first one; the pair of first ones is linked.
      test::Rings::Ring extra;
      extra.position = Vec3(-1.2, 0.0, 0.0);
      extra.rotation = rotation_exp(Vec3(0.9, 0.0, 0.0));
      s.types[0].shape = std::make_shared<test::Rings>(std::vector<test::Rings::Ring>{{}, extra});
      for (;;) {
        const Pose pose = linked_pose(A, B, rng);
        const auto second = [&](const std::array<double, 3>& size, const Pose& p) {
          return torus({0.5 * size[0], 0.5 * size[1], 0.5 * size[2]},
                       p.position + p.rotation * extra.position, p.rotation * extra.rotation);
        };
        const Torus a0 = torus(A, Vec3::Zero(), Mat3::Identity()), a1 = second(A, {}),
                    b0 = torus(B, pose.position, pose.rotation), b1 = second(B, pose);
        if (std::min({surface_distance(a0, b1, quick), surface_distance(a1, b0, quick),
                      surface_distance(a1, b1, quick)}) < 0.01) {
          continue;
        }
        const auto half = [](const std::array<double, 3>& x) {
          return std::array<double, 3>{0.5 * x[0], 0.5 * x[1], 0.5 * x[2]};
        };
        s.elements.push_back({0, values({A, half(A)}), {}});
        s.elements.push_back({0, values({B, half(B)}), pose});
        break;
      }
      break;
    }
    default:
      out.what = "chainmail cell";
      s = test::chainmail(1, 1);
      for (PlacedElement& e : s.elements) {
        e.parameters[1] = uniform(rng, 0.8, 1.1);
        e.parameters[2] = k % 3 == 0 ? e.parameters[1] : uniform(rng, 0.6, 1.15);
      }
      out.clearance = 0.02;
  }
  return out;
}

RandomScene thin_scene(long k, std::mt19937_64& rng)
{
  RandomScene out;
  const auto size = [&](double R, bool round) {
    const double wide = R * 0.005 * std::pow(8.0, uniform(rng, 0.0, 1.0)),
                 high = round ? wide : wide * std::pow(10.0, -uniform(rng, 0.0, 1.0));
    return (rng() & 1U) != 0U ? std::array<double, 3>{R, wide, high} : std::array<double, 3>{R, high, wide};
  };
  std::array<double, 3> A = size(1.0, k % 3 != 2), B = size(uniform(rng, 0.6, 1.6), k % 3 == 0);
  SceneSpec& s = out.spec;
  out.what = "thin linked pair";
  s.length = 1.0;
  s.lattice = {Vec3(40, 0, 0), Vec3(0, 40, 0)};
  s.types.push_back({"ring", std::make_shared<test::Rings>()});
  const Pose pose = linked_pose(A, B, rng);
  s.elements.push_back({0, values({A}), {}});
  s.elements.push_back({0, values({B}), pose});
  return out;
}

Vector random_step(const Model& m, const State& from, bool strain, std::mt19937_64& rng)
{
  Vector dy = Vector::Zero(m.dofs());
  const double size = std::pow(10.0, uniform(rng, -1.7, 0.8));
  for (int i = 0; i < m.element_count(); ++i) {
    const int o = m.offset(i), nc = m.coordinate_count;
    if ((rng() & 3U) == 0U) continue;  // some stay
    dy.segment(o, nc) = (size * any_direction(rng)).head(nc);
    dy.segment<3>(o + nc) = size * uniform(rng, 0.0, 1.0) * any_direction(rng);
  }
  if (strain) {
    for (;;) {
      for (int k = 0; k < m.macro_count; ++k) dy[k] = std::min(size, 0.3) * uniform(rng, -1.0, 1.0);
      const Vector end = from.macro + dy.head(m.macro_count);
      if (m.load->admissible({end.data(), static_cast<std::size_t>(m.macro_count)})) break;
    }
  }
  return dy;
}

Watched watch(const Model& model, const TorusAt& at, double keep, double until)
{
  return Watcher(model, at, keep, until).run();
}

}  // namespace hauberk::brute
