#include "limits/donors.hpp"
#include "numerics/decompositions.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Angles (degrees) that differ by less are one direction; beside each other are those up to `widest` apart.
constexpr double same_angle = 1e-7, widest = 30.0;
constexpr int strides = 2;

/// Elements of the largest cell whose stretches that hold a strain learn from those beside them.
constexpr int largest_taut_walk = 16;

/// Activation distance (L) of a stage whose gaps, a tenth of it, have room for what a scene's symmetry is off
/// by (symmetry_tolerance).
constexpr double room_of_image = 1e-5;

/// From one direction to another, in (-90, 90].
double turn(double from, double to)
{
  const double t = std::remainder(to - from, 180.0);
  return t <= -90.0 ? t + 180.0 : t;
}

/// The symmetric tensor S whose product S : dF with what macroscopic unknowns make of the lattice at rest is
/// the load's with them; what they cannot make has no part in it.
Mat3 load_tensor(const Model& m, const Direction& direction)
{
  const Eigen::Index vectors = static_cast<Eigen::Index>(m.lattice.size()), nm = m.macro_count;
  const State rest = rest_state(m);
  const Vector none = Vector::Zero(m.coordinate_count);
  const auto span = [](const Vector& v) {
    return std::span<const double>(v.data(), static_cast<std::size_t>(v.size()));
  };
  Eigen::Matrix3Xd T(3, vectors);
  std::vector<PositionMap> maps(m.lattice.size());
  for (Eigen::Index k = 0; k < vectors; ++k) {
    const auto at = static_cast<std::size_t>(k);
    T.col(k) = m.lattice[at];
    m.load->position(span(rest.macro), span(none), Vec3::Zero(), m.lattice[at], maps[at]);
  }
  const Matrix inverse = pseudo_inverse(T);
  Matrix basis(9, nm);
  for (Eigen::Index k = 0; k < nm; ++k) {
    Eigen::Matrix3Xd moved(3, vectors);
    for (Eigen::Index v = 0; v < vectors; ++v) moved.col(v) = maps[v].J.col(k);
    const Mat3 dF = moved * inverse;
    basis.col(k) = Mat3(0.5 * (dF + dF.transpose())).reshaped();
  }
  Vector load = Vector::Zero(nm);
  m.load->load(direction, {load.data(), static_cast<std::size_t>(nm)});
  const Vector S = shortest_least_squares(basis.transpose(), load);
  return S.reshaped(3, 3);
}

/// Whether the task's load pushes along a line that the lattice has.
bool pushes(const Model& m, const LimitTask& task)
{
  constexpr double rounding = 1e-9;
  Eigen::Matrix3Xd T(3, static_cast<Eigen::Index>(m.lattice.size()));
  for (std::size_t k = 0; k < m.lattice.size(); ++k) T.col(k) = m.lattice[k];
  const Matrix lines = orthonormal_columns(T);
  const double sign = task.sense == Sense::positive ? 1.0 : -1.0;
  const Matrix S = sign * lines.transpose() * load_tensor(m, task.direction) * lines;
  const Vector values = symmetric_eigenvalues(S);
  return values.minCoeff() < -rounding * values.cwiseAbs().maxCoeff();
}

}  // namespace

bool may_fold(const Model& m, const LimitTask& task)
{
  if (!m.load->periodic()) return false;
  if (m.load->bends()) return true;
  if (task.direction.is_angle()) return task.sense == Sense::negative;
  return !m.lattice.empty() && pushes(m, task) && bounded_by_links(m, task) == Boundedness::attained;
}

bool is_taut(const Model& m, const LimitTask& task)
{
  if (m.load->bends() || !task.direction.is_angle() || may_fold(m, task)) return false;
  const LimitTask across{Direction::at_degrees(task.direction.degrees() + 90.0), task.sense};
  return bounded_by_links(m, task) == Boundedness::attained &&
         bounded_by_links(m, across) == Boundedness::attained;
}

bool begins_again(const Model& m, const LimitTask& task, ContactChoice contact)
{
  if (m.load->bends() || !task.direction.is_angle()) return false;
  return may_fold(m, task) || (is_taut(m, task) && contact != ContactChoice::constrained);
}

bool learns_beside(const Model& m, const LimitTask& task)
{
  return !is_taut(m, task) || m.element_count() <= largest_taut_walk ||
         m.load->conditions(task.direction).empty();
}

Donors::Donors(const Model& m, const std::vector<LimitTask>& tasks)
    : model_(m), tasks_(tasks), symmetries_(point_symmetries(m))
{
  images_.reserve(tasks.size() * symmetries_.size());
  for (const LimitTask& task : tasks)
    for (const SceneSymmetry& g : symmetries_) images_.push_back(transformed(m, g, task));
  for (std::size_t k = 0; k < tasks.size(); ++k) images_[k * symmetries_.size()] = tasks[k];
}

std::optional<State> Donors::state(std::size_t donor, const Locked& own) const
{
  if (is_own(donor)) return own.state;
  const State* roomy = &own.state;
  for (std::size_t k = 0; k < own.trail.size() && own.stages[k].g_hat >= room_of_image; ++k)
    roomy = &own.trail[k];
  return transformed(model_, symmetries_[donor % symmetries_.size()], *roomy);
}

bool Donors::same_load(std::size_t donor, const LimitTask& task) const
{
  const std::optional<LimitTask>& other = images_[donor];
  if (!other || other->sense != task.sense || other->direction.is_angle() != task.direction.is_angle())
    return false;
  if (task.direction.is_angle())
    return std::abs(turn(other->direction.degrees(), task.direction.degrees())) < same_angle;
  const auto a = other->direction.components(), b = task.direction.components();
  constexpr double same_component = 1e-9;
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return std::abs(x - y) < same_component; });
}

std::optional<double> Donors::reached(std::size_t donor, const Vector& macro, const LimitTask& along) const
{
  if (!images_[donor]) return std::nullopt;
  Vector there = macro;
  const std::size_t n = macro.size();
  if (!is_own(donor) && !model_.load->transform(symmetries_[donor % symmetries_.size()].O, {macro.data(), n},
                                                {there.data(), n}))
    return std::nullopt;
  const MacroLoad load = macro_load(model_, along.direction, along.sense);
  if (!keeps(load.held, there)) return std::nullopt;
  const double v = model_.load->value(along.direction, {there.data(), n});
  return along.sense == Sense::positive ? v : -v;
}

void Donors::add_beside(std::size_t task, std::size_t learners, std::vector<Lesson>& out) const
{
  for (const double side : {-1.0, 1.0}) {
    double passed = 0.0;  // angle of the last donor taken
    bool company = false;
    for (int stride = 0; stride < strides;) {
      std::optional<std::size_t> next;
      double nearest = widest + same_angle;
      for (std::size_t d = 0; d < images_.size(); ++d) {
        const std::optional<LimitTask>& other = images_[d];
        if (!other || !other->direction.is_angle() || other->sense != tasks_[task].sense) continue;
        const double by = side * turn(tasks_[task].direction.degrees(), other->direction.degrees());
        // Of donors with one load those of the task itself come first.
        const bool nearer =
            by < nearest - same_angle || (next && by < nearest + same_angle && is_own(d) && !is_own(*next));
        if (by < passed + same_angle || !nearer) continue;
        nearest = by;
        next = d;
      }
      if (!next) break;
      out.push_back({task, *next});
      passed = nearest;
      const bool in_company = this->task(*next) >= learners;
      if (!in_company || !company) ++stride;
      company = company || in_company;
    }
  }
}

void Donors::add_across(std::size_t task, std::vector<Lesson>& out) const
{
  for (std::size_t d = 0; d < images_.size(); ++d) {
    const std::optional<LimitTask>& other = images_[d];
    if (!other || !other->direction.is_angle() || other->sense == tasks_[task].sense) continue;
    const double by = std::abs(turn(tasks_[task].direction.degrees(), other->direction.degrees()));
    if (by < 90.0 - same_angle) continue;
    out.push_back({task, d});
    return;
  }
}

std::vector<Lesson> Donors::starting_points(std::size_t learners, ContactChoice contact) const
{
  std::vector<Lesson> out;
  for (std::size_t k = 0; k < learners; ++k) {
    if (!begins_again(model_, tasks_[k], contact)) continue;
    if (is_taut(model_, tasks_[k])) add_across(k, out);
    if (learns_beside(model_, tasks_[k])) add_beside(k, learners, out);
  }
  return out;
}

}  // namespace hauberk
