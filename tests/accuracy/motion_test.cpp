// Certified steps of motions and of parameter changes against small steps with brute-force distances.

#include <scenes.hpp>
#include "contact/published.hpp"
#include "counts.hpp"
#include "design/design_point.hpp"
#include "motion/advancement.hpp"
#include "moving_scene.hpp"
#include "statistics.hpp"

#include <gtest/gtest.h>

namespace hauberk::brute {
namespace {

constexpr double keep = 0.1;

/// Results over all motions of one kind.
struct Tally {
  long motions = 0, touching = 0, missed = 0, links = 0, whole = 0, short_steps = 0, none = 0;
  Sample to_contact, to_near, evaluations;
  long sampled_missed = 0, sampled_links = 0, sampled_cut = 0;
  Sample sampled_evaluations, certified_alpha, sampled_alpha;
  long walks = 0, walks_missed = 0, walks_links = 0, walks_arrived = 0;

  /// What the sampled check of the same motion let through; nothing is promised of it.
  void add_sampled(const Watched& w, double alpha, bool links_changed)
  {
    sampled_cut += alpha < 1.0;
    sampled_alpha.add(alpha);
    sampled_missed += w.contact && *w.contact < alpha;
    sampled_links += links_changed;
  }

  /// The same for the whole motion in as many sampled steps as it takes.
  void add_walk(const Watched& w, double reached, bool links_changed)
  {
    ++walks;
    walks_missed += w.contact && *w.contact < reached;
    walks_links += links_changed;
    walks_arrived += reached >= 1.0;
  }

  void add(const Watched& w, double alpha, const std::string& what)
  {
    ++motions;
    certified_alpha.add(alpha);
    const bool collided = (w.contact && *w.contact < alpha) || w.smallest <= 0.0;
    missed += collided;
    EXPECT_FALSE(collided) << what << ": certified " << alpha << ", contact " << w.contact.value_or(-1.0)
                           << ", smallest gap " << w.smallest;
    links += w.changed_links != 0;
    EXPECT_EQ(w.changed_links, 0) << what;
    if (w.contact) {
      ++touching;
      to_contact.add(alpha / *w.contact);
    }
    if (w.near) {
      to_near.add(alpha / *w.near);
    } else {
      (alpha == 1.0 ? whole : short_steps) += 1;
    }
    none += alpha <= 0.0;
  }

  void print(const char* what)
  {
    fmt::print(
        "{}: {} motions, {} of them through something; collisions missed {}, links changed {}\n"
        "  alpha / time of contact        {}\n  alpha / time a gap falls to {:.2g}  {}\n"
        "  no gap falls that far: {} whole steps, {} cut; alpha = 0: {}\n  evaluations  {}\n",
        what, motions, touching, missed, links, to_contact.summary(), keep, to_near.summary(), whole,
        short_steps, none, evaluations.summary());
    fmt::print(
        "  alpha  {}\n  sampled: cut {}, collisions missed {}, links changed {}\n  evaluations  {}\n  alpha  "
        "{}\n",
        certified_alpha.summary(), sampled_cut, sampled_missed, sampled_links, sampled_evaluations.summary(),
        sampled_alpha.summary());
    if (walks > 0)
      fmt::print("  in sampled steps: {} motions, {} arrived, collisions missed {}, links changed {}\n",
                 walks, walks_arrived, walks_missed, walks_links);
  }
};

/// A number of links of the whole scene that changes when cores pass through each other.
long link_count(const Model& m, const TorusAt& at, double s)
{
  long links = 0;
  const int n = static_cast<int>(m.bodies.size()), range = m.lattice.empty() ? 0 : 1;
  for (int a = 0; a < n; ++a) {
    for (int b = a; b < n; ++b) {
      for (int i = -range; i <= range; ++i) {
        for (int j = -range; j <= range; ++j) {
          const auto element = [&](int body) { return m.bodies[body].element; };
          if (a == b && i == 0 && j == 0) continue;
          if (element(a) == element(b) && i == 0 && j == 0) continue;
          links += std::abs(gauss_linking(at(a, {0, 0}, s), at(b, {i, j}, s)));
        }
      }
    }
  }
  return links;
}

/// Least distance at which the published check lets a step pass, in L.
constexpr double least_sampled = 1e-8;

/// How far sampled steps, one after another, go along a motion before they stop.
double walk(const Model& m, const State& from, const Vector& dy)
{
  constexpr int most_steps = 3000;
  constexpr double stopped = 1e-4;
  double s = 0.0;
  for (int k = 0; k < most_steps; ++k) {
    const double rest = 1.0 - s;
    const double alpha = sampled_safe_step(m, advanced(m, from, dy, s), rest * dy, least_sampled).alpha;
    if (alpha >= 1.0) return 1.0;
    s += alpha * rest;
    if (alpha * rest < stopped) break;
  }
  return s;
}

void follow(long k, const RandomScene& scene, std::mt19937_64& rng, bool on, bool walked, Tally& tally)
{
  static const test::Sheet sheet(3);
  const Model m = make_model(scene.spec, sheet, scene.clearance);
  // Not from rest alone: half of the motions start where another one ended.
  State from = rest_state(m);
  if (on) {
    const Vector first = random_step(m, from, true, rng);
    from = advanced(m, from, first, largest_safe_step(m, from, first, 0.5).alpha);
  }
  const Vector dy = random_step(m, from, (k / 2) % 2 == 0, rng);
  const SafeStep safe = largest_safe_step(m, from, dy, keep);
  tally.evaluations.add(static_cast<double>(safe.evaluations));
  const TorusAt at = [&](int body, const Image& image, double s) {
    const Body& b = m.bodies[body];
    return from_kernel(b, image_pose(m, advanced(m, from, dy, s), b.element, image));
  };
  const Watched w = watch(m, at, keep, safe.alpha);
  tally.add(w, safe.alpha, fmt::format("motion {} ({})", k, scene.what));
  const SafeStep sampled = sampled_safe_step(m, from, dy, least_sampled);
  tally.sampled_evaluations.add(static_cast<double>(sampled.evaluations));
  const long links = link_count(m, at, 0.0);
  tally.add_sampled(w, sampled.alpha, links != link_count(m, at, sampled.alpha));
  if (!walked) return;
  const double reached = sampled.alpha < 1.0 ? walk(m, from, dy) : 1.0;
  tally.add_walk(w, reached, links != link_count(m, at, reached));
}

TEST(Motion, NoCollisionBeforeTheCertifiedStep)
{
  Tally tally;
  for (long k = 0; k < motion_count(); ++k) {
    std::seed_seq seed{k, 77L};
    std::mt19937_64 rng(seed);
    const RandomScene scene = random_scene(k, rng);
    follow(k, scene, rng, (k / 12) % 2 == 1, (k / 3) % 4 == 0, tally);
  }
  tally.print("motions");
  EXPECT_GT(tally.touching, tally.motions / 4);
}

TEST(Motion, ThinRingsDoNotPassThroughEachOther)
{
  Tally tally;
  for (long k = 0; k < motion_count(); ++k) {
    std::seed_seq seed{k, 80L};
    std::mt19937_64 rng(seed);
    const RandomScene scene = thin_scene(k, rng);
    follow(k, scene, rng, k % 2 == 1, (k / 2) % 4 == 0, tally);
  }
  tally.print("thin rings");
  EXPECT_GT(tally.touching, tally.motions / 4);
}

TEST(Motion, StrainBringsElementsTogetherThatHaveLeftTheirPlaces)
{
  // The third ring has moved by ten cells: an image of it is 3.5 away from the first ring, as at rest. A
  // strain of 0.2 moves that one by 0.2 (3.5 - 70) = -13.3.
  const test::Sheet sheet(3);
  SceneSpec spec = test::chain({1.0, 0.1, 0.1}, {1.0, 0.1, 0.1}, 7.0);
  spec.length = 1.0;
  const Mat3 across = rotation_exp(Vec3(0.0, 0.5 * std::numbers::pi, 0.0));
  spec.elements[1].rest = {Vec3(0.0, 1.0, 0.0), across};  // linked, as something has to be
  spec.elements.push_back({0, spec.elements[0].parameters, {Vec3(3.5, 0.0, 0.0), Mat3::Identity()}});
  const Model m = make_model(spec, sheet, 0.0);
  State from = rest_state(m);
  from.e[6] = 70.0;
  Vector dy = Vector::Zero(m.dofs());
  dy[0] = 0.2;
  // Rings of radius 1.1 in one plane meet at 3.5 - 13.3 s = 2.2.
  const double alpha = largest_safe_step(m, from, dy, keep).alpha;
  EXPECT_LT(alpha, 1.3 / 13.3);
  EXPECT_GT(alpha, 0.5 * 1.3 / 13.3);
  // In a lattice that is stretched 51 times the third ring has been kept beside the first one. A strain of
  // -10 moves it by -10 * 3.5, unless it keeps its place in the moving lattice: then by -10/51 * 3.5.
  from.macro[0] = 50.0;
  from.e[6] = 3.5 - 51.0 * 3.5;
  dy[0] = -10.0;
  const double far = largest_safe_step(m, from, dy, keep).alpha;
  EXPECT_LT(far, 1.3 / 35.0);
  EXPECT_GT(far, 0.5 * 1.3 / 35.0);
  dy[m.offset(2)] = 10.0 * 3.5 - 10.0 / 51.0 * 3.5;
  EXPECT_EQ(largest_safe_step(m, from, dy, keep).alpha, 1.0);
}

/// The published search for closest points at ten places of a change of parameters, for which no sampled
/// check is published: the last place before the first at which something touches.
double sampled_change(const Model& m, const TorusAt& at)
{
  constexpr int places = 10;
  const int n = static_cast<int>(m.bodies.size()), range = m.lattice.empty() ? 0 : 1;
  for (int k = 1; k <= places; ++k) {
    const double s = static_cast<double>(k) / places;
    for (int a = 0; a < n; ++a) {
      for (int b = a; b < n; ++b) {
        for (int i = -range; i <= range; ++i) {
          for (int j = -range; j <= range; ++j) {
            const auto element = [&](int body) { return m.bodies[body].element; };
            if (element(a) == element(b) && i == 0 && j == 0) continue;
            const Torus p = at(a, {0, 0}, s), q = at(b, {i, j}, s);
            if ((p.center - q.center).norm() > p.bound() + q.bound() + m.clearance) continue;
            const Body P = kernel_body(p), Q = kernel_body(q);
            int evaluations = 0;
            const auto minima =
                published::sampled_minima(PairFrame(P, kernel_pose(p), Q, kernel_pose(q)), evaluations);
            if (std::sqrt(minima.front().d) - m.clearance <= least_sampled)
              return static_cast<double>(k - 1) / places;
          }
        }
      }
    }
  }
  return 1.0;
}

/// Moves a primitive in its element, and turns it about its centre, by up to `size` of all that can be.
void place_anew(Primitive& p, double size, std::mt19937_64& rng)
{
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  p.position += size * p.R() * Vec3(shift(rng), shift(rng), shift(rng));
  p.rotation = test::random_rotation(rng, size * std::numbers::pi) * p.rotation;
}

TEST(Motion, NoCollisionBeforeTheCertifiedChangeOfParameters)
{
  const test::Sheet sheet(3);
  Tally tally;
  for (long k = 0; k < motion_count(); ++k) {
    std::seed_seq seed{k, 78L};
    std::mt19937_64 rng(seed);
    const RandomScene scene = random_scene(k, rng);
    const Model a = make_model(scene.spec, sheet, scene.clearance);
    SceneSpec changed = scene.spec;
    changed.length = a.length;
    std::uniform_real_distribution<double> factor(0.6, 1.6);
    const double size = std::pow(10.0, std::uniform_real_distribution<double>(-1.5, 0.0)(rng));
    for (PlacedElement& e : changed.elements) {
      for (double& p : e.parameters) p *= 1.0 + size * (factor(rng) - 1.0);
    }
    Model b = a;
    std::seed_seq other_seed{k, 79L};
    std::mt19937_64 places(other_seed);
    {
      const std::vector<PlacedElement>& elements = changed.elements;
      std::size_t body = 0;
      for (std::size_t e = 0; e < elements.size(); ++e) {
        for (Primitive p : changed.types[0].shape->primitives(elements[e].parameters)) {
          if (k % 3 == 2) place_anew(p, size, places);
          b.bodies[body] = make_body(p, static_cast<int>(e), b.bodies[body].index, b.length);
          ++body;
        }
      }
    }
    const State from = rest_state(a);
    Vector dy = Vector::Zero(a.dofs());
    if (k % 2 == 0) dy = 0.1 * random_step(a, from, false, rng);
    const double alpha = safe_parameter_step(a, b, from, dy);
    const TorusAt at = [&](int body, const Image& image, double s) {
      const std::size_t i = body;
      Body placed = a.bodies[i];
      placed.center += s * (b.bodies[i].center - placed.center);
      placed.axes = Eigen::Quaterniond(placed.axes).slerp(s, Eigen::Quaterniond(b.bodies[i].axes));
      Torus t = from_kernel(placed, image_pose(a, advanced(a, from, dy, s), a.bodies[i].element, image));
      t.R += s * (b.bodies[i].R - t.R);
      t.r0 += s * (b.bodies[i].r0 - t.r0);
      t.r1 += s * (b.bodies[i].r1 - t.r1);
      return t;
    };
    const Watched w = watch(a, at, keep, alpha);
    tally.add(w, alpha, fmt::format("change {} ({})", k, scene.what));
    const double sampled = sampled_change(a, at);
    tally.add_sampled(w, sampled, link_count(a, at, 0.0) != link_count(a, at, sampled));
  }
  tally.print("parameter changes");
  EXPECT_GT(tally.touching, tally.motions / 4);
}

}  // namespace
}  // namespace hauberk::brute
