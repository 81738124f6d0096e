#include "benchmarks.hpp"
#include "contact/body_pair.hpp"
#include "geometry/separation.hpp"
#include "measure.hpp"
#include "motion/advancement.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <array>
#include <limits>

namespace hauberk::bench {
namespace {

/// Half-axes along the axes of the two rings; across they are 0.7 mm. Equal ones are round tubes.
struct Shapes {
  const char* name;
  double first, second;
};
constexpr std::array shapes{Shapes{"tube_tube", 0.7, 0.7}, Shapes{"tube_ellipse", 0.7, 1.2},
                            Shapes{"ellipse_ellipse", 1.2, 1.2}};

/// Gaps over L at the ends of a first, a middle and a late stage: gaps are about a tenth of the activation
/// distance there.
constexpr std::array gaps{3e-3, 1e-5, 1e-8};
constexpr double activation = 10.0;

/// Centres of touching rings, and L, in the unit of the file (scenes/pair.json).
constexpr double touching = 8.6, length = 5.0;

/// Sideways displacement (L) and turn of the second ring in the step that is checked.
constexpr double slide = 0.02;
constexpr double keep = 0.1;  ///< what Newton's method leaves of a gap

Source pair_source(const Shapes& shape, double gap)
{
  return {"tests/bench/scenes/pair.json",
          {fmt::format("/elements/first/parameters/ring.r1={}", shape.first),
           fmt::format("/elements/second/parameters/ring.r1={}", shape.second),
           fmt::format("/cell/place/1/position=[{:.17g},0,0]", touching - gap * length)}};
}

/// The two bodies at rest.
struct Pair {
  const Model& model;
  State state;
  const Body &a, &b;
  Pose pose_a, pose_b;

  explicit Pair(const Model& m)
      : model(m),
        state(rest_state(m)),
        a(m.bodies[0]),
        b(m.bodies[1]),
        pose_a(image_pose(m, state, 0, {0, 0})),
        pose_b(image_pose(m, state, 1, {0, 0}))
  {
  }

  Separation apart() const
  {
    return separation(a, pose_a, b, pose_b, 0.0, std::numeric_limits<double>::infinity());
  }
};

/// The pair with this gap; throws if the scene has another one.
Pair pair_at(Scenes& scenes, const Shapes& shape, double gap)
{
  Pair pair(scenes.at(pair_source(shape, gap)).prepared().model);
  constexpr double rounding = 1e-14;
  const Separation s = pair.apart();
  if (!(s.lower <= gap + rounding && gap <= s.upper + rounding))
    throw ComputationError(fmt::format("the gap is {} to {}, expected {}", s.lower, s.upper, gap));
  return pair;
}

/// Registers one operation on a pair: `operation` returns the closest-point evaluations that it made.
template <class Operation>
void add(Scenes& scenes, const Shapes& shape, double gap, const std::string& what, Operation operation)
{
  enter(fmt::format("pair/{}/{:.0e}/{}", shape.name, gap, what),
        [&scenes, shape, gap, operation](benchmark::State& state) {
          long evaluations = 0;
          measure(state,
                  [&] { return [&, pair = pair_at(scenes, shape, gap)] { evaluations = operation(pair); }; });
          state.counters[counter::evaluations] = static_cast<double>(evaluations);
        });
}

long minima(const Pair& pair, double threshold)
{
  int evaluations = 0;
  const bool swapped = probe_rank(pair.b) < probe_rank(pair.a);
  const PairFrame frame = swapped ? PairFrame(pair.b, pair.pose_b, pair.a, pair.pose_a)
                                  : PairFrame(pair.a, pair.pose_a, pair.b, pair.pose_b);
  const auto found = frame.P->is_circle_tube() ? local_minima<1>(frame, threshold, evaluations)
                                               : local_minima<2>(frame, threshold, evaluations);
  if (found.empty()) throw ComputationError("there is no local minimum");
  return evaluations;
}

long safe_step(const Pair& pair)
{
  const Model& m = pair.model;
  Vector dy = Vector::Zero(m.dofs());
  const int begin = m.offset(1), turn = begin + m.coordinate_count;
  dy[begin + 1] = slide;
  dy[turn] = slide;
  return largest_safe_step(m, pair.state, dy, keep).evaluations;
}

void add_contacts(Scenes& scenes, const Shapes& shape, double gap)
{
  for (const Formulation formulation : {Formulation::nearest, Formulation::arc, Formulation::published}) {
    for (const int order : {0, 1, 2}) {
      ContactSettings settings;
      settings.formulation = formulation;
      settings.g_hat = activation * gap;
      add(scenes, shape, gap, fmt::format("{}/{}", name_of(formulation), order),
          [settings, order](const Pair& p) -> long {
            const PairContact contact = pair_contact(p.a, p.pose_a, p.b, p.pose_b, settings, order);
            if (!(contact.terms.energy > 0.0)) throw ComputationError("the pair has no contact energy");
            return contact.evaluations;
          });
    }
  }
}

}  // namespace

void register_pairs(Scenes& scenes)
{
  for (const Shapes& shape : shapes) {
    for (const double gap : gaps) {
      add_contacts(scenes, shape, gap);
      add(scenes, shape, gap, "separation", [](const Pair& p) -> long { return p.apart().evaluations; });
      add(scenes, shape, gap, "minima", [gap](const Pair& p) { return minima(p, activation * gap); });
      add(scenes, shape, gap, "safe_step", safe_step);
    }
  }
}

}  // namespace hauberk::bench
