#include "trace.hpp"

#include <hauberk/conformance/known_problems.hpp>
#include <hauberk/host/floating_point.hpp>
#include <hauberk/triangle_surface.hpp>

#include <cstring>

namespace hauberk::conformance {
namespace {

constexpr int traced_points = 6;
constexpr int traced_states = 8;
constexpr int most_iterates = 30;

using Numbers = std::vector<double>;

void append(Numbers& out, std::span<const double> values)
{
  out.insert(out.end(), values.begin(), values.end());
}

void trace_shape(const Shape& shape, const Numbers& p, Numbers& out)
{
  for (const Primitive& primitive : shape.primitives(p)) {
    out.push_back(static_cast<double>(primitive.kind));
    append(out, quantities(primitive));
    append(out, {primitive.rotation.data(), 9});
    if (!primitive.surface) continue;
    for (const Vec3& x : primitive.surface->points()) append(out, {x.data(), 3});
    for (const auto& t : primitive.surface->triangles()) out.insert(out.end(), t.begin(), t.end());
  }
  for (const PrimitiveJacobian& jacobian : shape.jacobians(p)) append(out, jacobian);
}

void trace_position(const LoadCase& load_case, const Numbers& macro, const Numbers& e, const Vec3& X,
                    const Vec3& T, Numbers& out)
{
  PositionMap map;
  load_case.position(macro, e, X, T, map);
  append(out, {map.x.data(), 3});
  append(out, {map.J.data(), static_cast<std::size_t>(map.J.size())});
  if (!map.curved) return;
  const std::size_t n = macro.size() + e.size();
  for (const auto& component : map.H) {
    for (std::size_t i = 0; i < n; ++i) append(out, {component[i].data(), n});
  }
}

/// Rosenbrock's valley, and hs71 where constraints are taken.
void trace_optimizer(const Optimizer& optimizer, Numbers& out)
{
  const FloatingPointMode before = floating_point_mode();
  for (const char* name : {"rosenbrock_bound", "hs71"}) {
    KnownProblem k = known_problem(name);
    // Between calls of the plugin the mode must be the program's, too.
    k.problem.objective = [smooth = k.problem.objective, before](const VectorXd& x, VectorXd& g) {
      const FloatingPointMode now = floating_point_mode();
      require(now == before, "the objective is evaluated in another floating-point mode ({})",
              describe_change(before, now));
      return smooth(x, g);
    };
    Recorder recorder;
    recorder.limit = most_iterates;
    const OptimizerResult r = optimizer.minimize(k.problem, k.start, recorder);
    for (const VectorXd& x : k.problem.evaluated) append(out, {x.data(), static_cast<std::size_t>(x.size())});
    append(out, r.x);
    out.push_back(r.value);
  }
}

}  // namespace

Exercise::Exercise(const Object& object, Trial& trial)
{
  if (object.shape) {
    for (int k = 0; k < traced_points; ++k) points_.push_back(draw_point(*object.shape, trial));
  }
  if (!object.load_case) return;
  const LoadCase& load_case = *object.load_case;
  Random& random = trial.random;
  const std::size_t coordinates = load_case.coordinate_count();
  for (const double theta : angles(random, traced_states)) {
    const Numbers macro = draw_macro(load_case, random);
    states_.push_back({macro, random.values(macro.size(), 0.1), random.values(coordinates, 0.5),
                       random.values(coordinates, 0.2), random.vector(2.0),
                       draw_translation(load_case, random), theta});
  }
}

std::vector<double> Exercise::operator()(const Object& object) const { return all(object, false); }

std::vector<double> Exercise::backwards(const Object& object) const { return all(object, true); }

void Exercise::trace_state(const LoadCase& load_case, const State& s, const std::vector<Vec3>& cycles,
                           Numbers& out)
{
  trace_position(load_case, s.macro, s.e, s.X, s.T, out);
  out.push_back(load_case.acceleration_bound(s.macro, s.step, s.e, s.de, s.X, s.T));
  out.push_back(load_case.admissible(s.macro) ? 1.0 : 0.0);
  const auto [smallest, largest] = load_case.stretch_range(s.macro);
  const Direction direction = Direction::at_radians(s.theta);
  Numbers load(s.macro.size()), metric(s.macro.size());
  load_case.load(direction, load);
  load_case.metric(metric);
  append(out, load);
  append(out, metric);
  append(out, Numbers{smallest, largest, load_case.value(direction, s.macro)});
  for (const auto& [name, value] : load_case.companions(direction, s.macro)) out.push_back(value);
  for (const MacroCondition& held : load_case.conditions(direction))
    append(out, {held.coefficients.data(), s.macro.size()});
  out.push_back(static_cast<double>(load_case.boundedness(load, cycles)));
}

std::vector<double> Exercise::all(const Object& object, bool reversed) const
{
  std::vector<Numbers> parts(points_.size() + states_.size());
  std::vector<Vec3> X, cycles;
  for (const State& s : states_) {
    X.push_back(s.X);
    cycles.push_back(s.T);
  }
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const std::size_t at = reversed ? parts.size() - 1 - k : k;
    if (object.shape) trace_shape(*object.shape, points_[at].p, parts[at]);
    if (object.load_case) trace_state(*object.load_case, states_[at], cycles, parts[at]);
  }
  Numbers out;
  for (const Numbers& part : parts) append(out, part);
  if (object.optimizer) trace_optimizer(*object.optimizer, out);
  if (!object.load_case) return out;
  for (const LinearInequality& wall : object.load_case->inequalities(X)) {
    out.push_back(wall.offset);
    for (const LinearTerm& term : wall.terms) out.push_back(term.coefficient);
  }
  for (const LinearEquality& held : object.load_case->equalities(X)) {
    for (const LinearTerm& term : held.terms) out.push_back(term.coefficient);
  }
  return out;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

std::string first_difference(const std::vector<double>& a, const std::vector<double>& b)
{
  if (a.size() != b.size()) return fmt::format("{} answers and then {}", a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::memcmp(&a[i], &b[i], sizeof(double)) != 0)
      return fmt::format("answer {} of {} is {:.17g} and then {:.17g}", i + 1, a.size(), a[i], b[i]);
  }
  return "no difference";
}

}  // namespace hauberk::conformance
