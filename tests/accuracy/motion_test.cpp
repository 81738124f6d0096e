// Certified steps of motions and of parameter changes against small steps with brute-force distances.

#include "counts.hpp"
#include "moving_scene.hpp"
#include "statistics.hpp"

#include <hauberk/design/design_point.hpp>
#include <hauberk/motion/advancement.hpp>

#include <scenes.hpp>

#include <gtest/gtest.h>

namespace hauberk::brute {
namespace {

constexpr double keep = 0.1;

/// Results over all motions of one kind.
struct Tally {
  long motions = 0, touching = 0, missed = 0, links = 0, whole = 0, short_steps = 0, none = 0;
  Sample to_contact, to_near, evaluations;

  void add(const Watched& w, double alpha, const std::string& what)
  {
    ++motions;
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
  }
};

TEST(Motion, NoCollisionBeforeTheCertifiedStep)
{
  const test::Sheet sheet(3);
  Tally tally;
  for (long k = 0; k < motion_count(); ++k) {
    std::seed_seq seed{k, 77L};
    std::mt19937_64 rng(seed);
    const RandomScene scene = random_scene(k, rng);
    const Model m = make_model(scene.spec, sheet, scene.clearance);
    // Not from rest alone: half of the motions start where another one ended.
    State from = rest_state(m);
    if ((k / 12) % 2 == 1) {
      const Vector first = random_step(m, from, true, rng);
      from = advanced(m, from, first, largest_safe_step(m, from, first, 0.5).alpha);
    }
    const Vector dy = random_step(m, from, (k / 2) % 2 == 0, rng);
    const SafeStep safe = largest_safe_step(m, from, dy, keep);
    tally.evaluations.add(static_cast<double>(safe.evaluations));
    const TorusAt at = [&](int body, const Image& image, double s) {
      const Body& b = m.bodies[static_cast<std::size_t>(body)];
      return from_kernel(b, image_pose(m, advanced(m, from, dy, s), b.element, image));
    };
    tally.add(watch(m, at, keep, safe.alpha), safe.alpha, fmt::format("motion {} ({})", k, scene.what));
  }
  tally.print("motions");
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
    {
      const std::vector<PlacedElement>& elements = changed.elements;
      std::size_t body = 0;
      for (std::size_t e = 0; e < elements.size(); ++e) {
        for (const Primitive& p : changed.types[0].shape->primitives(elements[e].parameters)) {
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
      const auto i = static_cast<std::size_t>(body);
      Torus t = from_kernel(a.bodies[i], image_pose(a, advanced(a, from, dy, s), a.bodies[i].element, image));
      t.R += s * (b.bodies[i].R - t.R);
      t.r0 += s * (b.bodies[i].r0 - t.r0);
      t.r1 += s * (b.bodies[i].r1 - t.r1);
      return t;
    };
    tally.add(watch(a, at, keep, alpha), alpha, fmt::format("change {} ({})", k, scene.what));
  }
  tally.print("parameter changes");
  EXPECT_GT(tally.touching, tally.motions / 4);
}

}  // namespace
}  // namespace hauberk::brute
