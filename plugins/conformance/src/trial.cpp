#include "trial.hpp"

#include <hauberk/error.hpp>
#include <hauberk/host/factories.hpp>
#include <hauberk/solid.hpp>

#include <algorithm>
#include <cmath>

namespace hauberk::conformance {
namespace {

constexpr int most_draws = 4000;
constexpr double margin_part = 0.05;
/// Lengths are drawn from here where a parameter has neither default nor narrow bounds.
constexpr double short_length = 0.1, long_length = 10.0;

/// Where a parameter is drawn from.
struct Range {
  double low, high;
};

Range around(double value, const ParameterInfo& info)
{
  const double reach = value == 0.0 ? 1.0 : 0.4 * std::abs(value);
  return {std::max(info.lower, value - reach), std::min(info.upper, value + reach)};
}

Range range_of(const ParameterInfo& info)
{
  if (std::isfinite(info.default_value)) return around(info.default_value, info);
  const double widest = info.unit == "degree" ? 180.0 : long_length;
  const double least = info.lower >= 0.0 ? short_length : -widest;
  const Range range{std::max(info.lower, least), std::min(info.upper, widest)};
  return range.low < range.high ? range : Range{info.lower, info.upper};
}

std::vector<Range> ranges_of(const Shape& shape, const Node& given)
{
  std::vector<Range> ranges;
  ranges.reserve(shape.parameters().size());
  for (const ParameterInfo& info : shape.parameters()) {
    const Node* value = given.find(info.name);
    ranges.push_back(value != nullptr ? around(value->number, info) : range_of(info));
  }
  return ranges;
}

/// Ends the check where the parameters given cannot be looked at.
void check_given(const Shape& shape, const Node& given, Trial& trial)
{
  if (given.type == Node::Type::null) return;
  require(given.type == Node::Type::object, "the parameters of the section: expected an object of numbers");
  const std::vector<ParameterInfo>& infos = shape.parameters();
  for (const auto& [name, value] : given.members) {
    const auto info = std::find_if(infos.begin(), infos.end(),
                                   [&name = name](const ParameterInfo& i) { return i.name == name; });
    require(info != infos.end(), "the parameters of the section: the shape has no parameter '{}'", name);
    require(value.type == Node::Type::number && value.number >= info->lower && value.number <= info->upper,
            "the parameters of the section: '{}': expected a number in [{}, {}]", name, info->lower,
            info->upper);
  }
  std::vector<double> p;
  for (const ParameterInfo& info : infos) {
    const Node* value = given.find(info.name);
    p.push_back(value != nullptr ? value->number : info.default_value);
    if (!std::isfinite(p.back())) return;
  }
  const std::optional<std::string> message = refused(shape, p, trial);
  require(!message, "the shape refuses the parameters of the section: {}", message.value_or(""));
}

/// The first refusal of p moved to and fro along every parameter; null where the shape accepts all.
std::optional<std::string> refused_around(const Shape& shape, const Point& point, Trial& trial)
{
  std::optional<std::string> message = refused(shape, point.p, trial);
  std::vector<double> q = point.p;
  for (std::size_t k = 0; k < q.size(); ++k) {
    for (const double sign : {-1.0, 1.0}) {
      q[k] = point.p[k] + sign * point.margin[k];
      if (!message) message = refused(shape, q, trial);
    }
    q[k] = point.p[k];
  }
  return message;
}

/// A point of these ranges that the shape accepts, with its margins; `last` is the last refusal.
std::optional<Point> draw_from(const Shape& shape, const std::vector<Range>& ranges, Trial& trial, int draws,
                               std::optional<std::string>& last)
{
  for (int draw = 0; draw < draws; ++draw) {
    Point point;
    point.p.reserve(ranges.size());
    point.margin.reserve(ranges.size());
    for (const Range& r : ranges) {
      const bool wide = r.low > 0.0 && r.high > 20.0 * r.low;
      const double middle = r.low == r.high ? r.low : 0.0;
      const double inside = margin_part * (r.high - r.low);
      const double value = wide ? trial.random.scale(1.2 * r.low, r.high / 1.2)
                                : trial.random.between(r.low + inside, r.high - inside);
      point.p.push_back(r.low == r.high ? middle : value);
      point.margin.push_back(wide ? margin_part * value : inside);
    }
    last = refused_around(shape, point, trial);
    if (last) continue;
    trial.look_at(shape, point.p);
    return point;
  }
  return std::nullopt;
}

}  // namespace

bool mentions(std::string_view text, std::string_view name)
{
  const auto in_name = [&](std::size_t at) {
    const auto c = static_cast<unsigned char>(text[at]);
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
  };
  for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || !in_name(at - 1)) && (end == text.size() || !in_name(end))) return true;
  }
  return false;
}

void Trial::look_at(const Shape& shape, const std::vector<double>& p)
{
  looked_at.clear();
  for (std::size_t k = 0; k < p.size(); ++k)
    looked_at += fmt::format("{}{} = {:.9g}", k == 0 ? "" : ", ", shape.parameters()[k].name, p[k]);
}

Object Trial::make(const Node& values, Problems& problems, double length) const
{
  Object object;
  switch (table.kind) {
    case PluginKind::shape:
      object.shape = make_shape(table, values, problems);
      break;
    case PluginKind::load_case:
      object.load_case = make_load_case(table, values, length, problems);
      break;
    case PluginKind::optimizer:
      object.optimizer = make_optimizer(table, values, problems);
      break;
  }
  return object;
}

Object Trial::make() const
{
  Problems problems;
  Object object = make(section.values, problems);
  for (const Problem& p : problems.list())
    fail("the plugin refuses the section: {}: {}; give another one with --section", p.pointer, p.message);
  return object;
}

std::vector<double> quantities(const Primitive& primitive)
{
  std::vector<double> out(primitive.position.begin(), primitive.position.end());
  out.insert(out.end(), primitive.size.begin(), primitive.size.end());
  // What the kernel sets has no row of a Jacobian.
  if (primitive.surface) out[4] = out[5] = 0.0;
  if (primitive.solid) {
    out[3] = out[4] = out[5] = 0.0;
    out.insert(out.end(), primitive.solid->sizes().begin(), primitive.solid->sizes().end());
  }
  if (primitive.curve.empty()) return out;
  out[3] = 0.0;
  for (const Harmonic& h : primitive.curve) {
    out.insert(out.end(), h.c.begin(), h.c.end());
    out.insert(out.end(), h.s.begin(), h.s.end());
  }
  return out;
}

std::vector<Primitive> primitives_at(const Shape& shape, const std::vector<double>& p, Trial& trial)
{
  try {
    return shape.primitives(p);
  } catch (const InputError&) {
    throw;
  } catch (...) {
    trial.look_at(shape, p);
    throw;
  }
}

std::optional<std::string> refused(const Shape& shape, const std::vector<double>& p, Trial& trial)
{
  try {
    static_cast<void>(primitives_at(shape, p, trial));
  } catch (const InputError& error) {
    return error.what();
  }
  return std::nullopt;
}

std::string quantity_name(const Primitive& primitive, std::size_t row)
{
  constexpr const char* names[] = {"position x", "position y", "position z", "size 0", "size 1", "size 2"};
  if (row < std::size(names)) return names[row];
  if (primitive.solid) return "the solid's " + primitive.solid->size_names().at(row - primitive_dofs);
  const std::size_t harmonic = (row - primitive_dofs) / harmonic_dofs,
                    at = (row - primitive_dofs) % harmonic_dofs;
  return fmt::format("{} {} of harmonic {}", at < 3 ? "cosine" : "sine", "xyz"[at % 3], harmonic + 1);
}

Point draw_point(const Shape& shape, Trial& trial)
{
  if (!trial.switched) check_given(shape, trial.section.parameters, trial);
  const std::vector<Range> ranges = ranges_of(shape, trial.section.parameters);
  std::optional<std::string> last;
  const std::optional<Point> point = draw_from(shape, ranges, trial, most_draws, last);
  if (!point)
    throw NoParameters(fmt::format(
        "no parameters found that the shape accepts, the last refusal: {}; give defaults to its parameters, or "
        "--section '{{\"parameters\": {{...}}}}'",
        last.value_or("")));
  return *point;
}

std::pair<double, double> whole_range(const ParameterInfo& info)
{
  constexpr double decades = 1e3;
  const bool given = std::isfinite(info.default_value) && info.default_value != 0.0;
  const double typical = given ? std::abs(info.default_value) : 1.0;
  const double least = info.lower > 0.0 ? typical / decades : -typical * decades;
  const double low = std::min(std::max(info.lower, least), info.upper);
  return {low, std::max(low, std::min(info.upper, typical * decades))};
}

Point draw_far_point(const Shape& shape, Trial& trial)
{
  constexpr int tries = 40;
  const std::vector<ParameterInfo>& infos = shape.parameters();
  std::vector<Range> whole;
  whole.reserve(infos.size());
  for (const ParameterInfo& info : infos) {
    const auto [low, high] = whole_range(info);
    whole.push_back({low, high});
  }
  std::optional<std::string> last;
  if (const auto point = draw_from(shape, whole, trial, tries, last)) return *point;
  const std::vector<Range> near = ranges_of(shape, trial.section.parameters);
  for (int draw = 0; draw < tries && !infos.empty(); ++draw) {
    std::vector<Range> mixed = near;
    const auto k = static_cast<std::size_t>(trial.random.between(0.0, static_cast<double>(infos.size())));
    mixed[k] = whole[k];
    if (const auto point = draw_from(shape, mixed, trial, 1, last)) return *point;
  }
  return draw_point(shape, trial);
}

std::vector<double> draw_macro(const LoadCase& load_case, Random& random, double size)
{
  const std::size_t count = load_case.macro_count();
  for (int draw = 0; draw < most_draws; ++draw) {
    std::vector<double> macro = random.values(count, size);
    if (load_case.admissible(macro)) return macro;
  }
  fail("none of {} states with unknowns up to {} is admissible", most_draws, size);
}

bool spatial(const LoadCase& load_case, Random& random)
{
  const std::vector<double> macro = draw_macro(load_case, random);
  const std::vector<double> e(load_case.coordinate_count(), 0.0);
  PositionMap here, above;
  load_case.position(macro, e, Vec3::Zero(), Vec3::Zero(), here);
  load_case.position(macro, e, Vec3::Zero(), Vec3::UnitZ(), above);
  return (above.x - here.x - Vec3::UnitZ()).norm() > 1e-12;
}

Vec3 draw_translation(const LoadCase& load_case, Random& random)
{
  if (!load_case.periodic()) return Vec3::Zero();
  Vec3 T = random.vector(3.0);
  if (load_case.lattice_vectors() == 1) return {T.x(), 0.0, 0.0};
  if (!spatial(load_case, random)) T.z() = 0.0;
  return T;
}

std::vector<double> angles(Random& random, int count)
{
  std::vector<double> out{0.0, 90.0 * degree};
  while (static_cast<int>(out.size()) < count) out.push_back(random.between(0.0, 180.0 * degree));
  return out;
}

}  // namespace hauberk::conformance
