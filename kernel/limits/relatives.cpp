#include "limits/relatives.hpp"

#include "geometry/closed_curve.hpp"
#include "motion/advancement.hpp"
#include "numerics/decompositions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace hauberk {
namespace {

constexpr double same = rounding_of_scenes;

/// Index of a cell among those of `repeat`, and the lattice translation of the repeated cell that leads to
/// it.
struct CellPlace {
  int cell;
  Image image;
};

CellPlace place_of(const std::array<int, 3>& at, const std::array<int, 3>& repeat)
{
  std::array<int, 3> within{};
  CellPlace out{};
  for (std::size_t k = 0; k < 3; ++k) {
    within[k] = at[k] % repeat[k];
    out.image[k] = at[k] / repeat[k];
  }
  out.cell = (within[2] * repeat[1] + within[1]) * repeat[0] + within[0];
  return out;
}

bool same_body(const Body& a, const Body& b)
{
  if (a.kind != b.kind || a.surface != b.surface || (a.curve == nullptr) != (b.curve == nullptr) ||
      std::hypot(a.R - b.R, a.r0 - b.r0, a.r1 - b.r1) > same || (a.center - b.center).norm() > same ||
      (a.axes - b.axes).norm() > same)
    return false;
  if (a.solid || b.solid) return same_solid(a, b);
  if (!a.curve) return true;
  return std::ranges::equal(
      a.curve->harmonics(), b.curve->harmonics(),
      [](const Harmonic& x, const Harmonic& y) { return (x.c - y.c).norm() + (x.s - y.s).norm() <= same; });
}

/// Element i of one model and element j of another one are the same, wherever they are.
bool same_element(const Model& a, std::size_t i, const Model& b, std::size_t j)
{
  const std::span<const Body> these(a.bodies.data() + a.first_body[i], a.bodies.data() + a.first_body[i + 1]);
  const std::span<const Body> those(b.bodies.data() + b.first_body[j], b.bodies.data() + b.first_body[j + 1]);
  return std::ranges::equal(these, those, same_body);
}

/// Each once.
std::vector<int> prime_factors(int number)
{
  std::vector<int> out;
  for (int p = 2; number > 1; ++p) {
    if (number % p != 0) continue;
    out.push_back(p);
    while (number % p == 0) number /= p;
  }
  return out;
}

/// The cell of a scene whose cell repeats it `times` along an axis, all copies being alike.
SceneSpec part_of_cells(const SceneSpec& spec, std::size_t axis, int times)
{
  SceneSpec out = spec;
  out.repeat[axis] /= times;
  out.lattice[axis] /= times;
  out.elements.clear();
  const auto n = spec.elements.size() / static_cast<std::size_t>(cell_count(spec.repeat));
  for (std::size_t k = 0; k < spec.elements.size(); ++k)
    if (cell_at(static_cast<int>(k / n), spec.repeat)[axis] < out.repeat[axis])
      out.elements.push_back(spec.elements[k]);
  return out;
}

std::string name_of_cells(const std::array<int, 3>& repeat)
{
  if (cell_count(repeat) == 1) return "one cell";
  const std::string in_plane = fmt::format("{} x {}", repeat[0], repeat[1]);
  return repeat[2] == 1 ? in_plane + " cells" : fmt::format("{} x {} cells", in_plane, repeat[2]);
}

}  // namespace

std::vector<Relative> relatives(const Model& m, const SceneSpec& spec)
{
  std::vector<Relative> out;
  SceneSpec scene = spec;
  scene.length = m.length;
  for (StricterLoadCase& s : m.load->stricter())
    out.push_back({std::move(s.name), scene, std::shared_ptr<const LoadCase>(std::move(s.load))});
  if (m.load->periodic() && cell_count(spec.repeat) > 1 && cells_alike(spec, m.length)) {
    for (std::size_t axis = 0; axis < scene.lattice.size(); ++axis) {
      for (const int prime : prime_factors(spec.repeat[axis])) {
        SceneSpec part = part_of_cells(scene, axis, prime);
        out.push_back({name_of_cells(part.repeat), std::move(part), nullptr});
      }
    }
  }
  return out;
}

bool contains(const Model& outer, const SceneSpec& outer_spec, const Model& inner,
              const SceneSpec& inner_spec)
{
  if (std::abs(outer.length / inner.length - 1.0) > same || outer.clearance > inner.clearance + same ||
      outer.lattice.size() != inner.lattice.size() || outer_spec.facets != inner_spec.facets ||
      !outer.load->contains(*inner.load))
    return false;
  const auto n = inner_spec.elements.size() / static_cast<std::size_t>(cell_count(inner_spec.repeat));
  if (n * static_cast<std::size_t>(cell_count(outer_spec.repeat)) != outer_spec.elements.size()) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (outer_spec.repeat[i] % inner_spec.repeat[i] != 0) return false;
    if (i < outer.lattice.size() &&
        (outer.lattice[i] / outer_spec.repeat[i] - inner.lattice[i] / inner_spec.repeat[i]).norm() > same)
      return false;
  }
  for (std::size_t k = 0; k < outer_spec.elements.size(); ++k) {
    const auto at = cell_at(static_cast<int>(k / n), outer_spec.repeat);
    const auto other = static_cast<std::size_t>(place_of(at, inner_spec.repeat).cell) * n + k % n;
    if (!same_element(outer, k, inner, other)) return false;
  }
  return true;
}

Carrier::Carrier(const Model& from, const SceneSpec& from_spec, const Model& to, const SceneSpec& to_spec)
    : from_(from), to_(to), from_repeat_(from_spec.repeat), to_repeat_(to_spec.repeat)
{
  const std::optional<State> rest = state(rest_state(from));
  if (!rest) return;
  const State here = rest_state(to);
  const Vector way = difference(to, here, *rest);
  joined_ = step_norm(to, way) < same || largest_safe_step(to, here, way, 0.0).alpha >= 1.0;
}

std::optional<State> Carrier::state(const State& from) const
{
  State out = rest_state(to_);
  const double scale = from_.length / to_.length;
  out.macro = from.macro;
  for (int k = 0; k < to_.macro_count; ++k)
    out.macro[k] *= std::pow(scale, to_.load->macros()[k].length_power);
  const auto n = from_.element_count() / cell_count(from_repeat_);
  const std::span<const double> macro = out.macro_values();
  const std::size_t nc = to_.coordinate_count;
  PositionMap map;
  for (int k = 0; k < to_.element_count(); ++k) {
    const CellPlace there = place_of(cell_at(k / n, to_repeat_), from_repeat_);
    const Pose pose = image_pose(from_, from, there.cell * n + k % n, there.image);
    out.rotation[k] = pose.rotation;
    // Positions are affine in an element's coordinates, or nearly: Newton's method ends at once. On a rolled
    // sheet, along which elements may have slid far, it begins where the element is along it.
    auto e = out.e.segment(k * to_.coordinate_count, to_.coordinate_count);
    const int along = std::min(from_.coordinate_count, to_.coordinate_count);
    if (to_.load->bends() && along >= 2)
      e.head(along) = scale * from.e.segment((there.cell * n + k % n) * from_.coordinate_count, along);
    double missed = 0.0;
    for (int step = 0; step < 4; ++step) {
      to_.load->position(macro, {e.data(), nc}, to_.rest[k].position, Vec3::Zero(), map);
      const Vec3 left = scale * pose.position - map.x;
      missed = left.norm();
      if (nc == 0 || missed < 1e-15) break;
      const Matrix J = map.J.middleCols(to_.macro_count, to_.coordinate_count);
      e += least_squares(J, left);
    }
    if (missed > same) return std::nullopt;
  }
  return out;
}

}  // namespace hauberk
