/// Checks of shapes.

#include "checks.hpp"
#include "deviations.hpp"
#include "solid_checks.hpp"

#include <hauberk/error.hpp>
#include <hauberk/solid.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <set>

namespace hauberk::conformance {
namespace {

/// Half of them near the defaults, half from the whole bounds; fewer where a switch is set otherwise.
int points(const Trial& trial) { return trial.switched ? 4 : 12; }
/// Of equal quantities that come from different arithmetic, relative to the largest of them.
constexpr double shape_rounding = 1e-12;

using Values = std::vector<double>;

Point draw(const Shape& shape, Trial& trial, int number)
{
  return number % 2 == 0 ? draw_point(shape, trial) : draw_far_point(shape, trial);
}

void parameters(Trial& trial)
{
  const Object object = trial.make();
  std::set<std::string> names;
  for (const ParameterInfo& info : object.shape->parameters()) {
    const bool usable = !info.name.empty() && info.name.find_first_of("/* \t\n") == std::string::npos;
    require(usable, "the parameter name '{}' is empty, or has '/', '*' or a space in it", info.name);
    require(names.insert(info.name).second, "there are two parameters '{}'", info.name);
    require(info.unit == "length" || info.unit == "degree" || info.unit == "1",
            "parameter '{}' has the unit '{}'; expected length, degree or 1", info.name, info.unit);
    require(info.lower <= info.upper, "parameter '{}' has the bounds [{}, {}]", info.name, info.lower,
            info.upper);
    const double value = info.default_value;
    require(std::isnan(value) || (value >= info.lower && value <= info.upper),
            "parameter '{}' has the default {} outside its bounds [{}, {}]", info.name, value, info.lower,
            info.upper);
    require(!info.doc.empty(), "parameter '{}' has no doc", info.name);
  }
}

void parameter_bounds(Trial& trial)
{
  const Object object = trial.make();
  const std::vector<ParameterInfo>& infos = object.shape->parameters();
  const Point inside = draw_point(*object.shape, trial);
  const double infinity = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < infos.size(); ++k) {
    for (const double bad : {std::nextafter(infos[k].lower, -infinity),
                             std::nextafter(infos[k].upper, infinity), std::nan("")}) {
      if (std::isinf(bad)) continue;
      Values p = inside.p;
      p[k] = bad;
      trial.look_at(*object.shape, p);
      const auto message = refused(*object.shape, p, trial);
      require(message.has_value(), "parameter '{}' = {} is accepted outside [{}, {}]", infos[k].name, bad,
              infos[k].lower, infos[k].upper);
      require(mentions(*message, infos[k].name),
              "'{}' = {} is refused without the name of the parameter: '{}'", infos[k].name, bad, *message);
    }
  }
}

/// Whether a refusal tells one of the parameters.
bool names_one(const std::string& message, const std::vector<ParameterInfo>& infos)
{
  return std::any_of(infos.begin(), infos.end(),
                     [&](const ParameterInfo& info) { return mentions(message, info.name); });
}

/// The kernel has checked that sizes are positive; what is left is that the tube leaves a hole.
void require_closed(const Primitive& primitive)
{
  const bool ring =
      primitive.kind == PrimitiveKind::circle_tube || primitive.kind == PrimitiveKind::revolved_ellipse;
  require(!ring || primitive.R() > primitive.r0(),
          "primitive '{}' is no closed surface with a hole: its tube of half-width {} closes its radius {}; "
          "refuse such parameters",
          primitive.name, primitive.r0(), primitive.R());
}

std::vector<std::string> names_of(const Shape& shape, const Values& p)
{
  std::vector<std::string> out;
  for (const Primitive& primitive : shape.primitives(p)) out.push_back(primitive.name);
  return out;
}

void require_names(const Shape& shape, const Values& p, const std::vector<std::string>& names)
{
  const std::vector<std::string> found = names_of(shape, p);
  require(found == names,
          "names, number or order of primitives depend on the parameters: {} ('{}', ...) and {} ('{}', ...)",
          names.size(), names.front(), found.size(), found.front());
}

/// The corners of the parameters' box, of many parameters some of them: there, too, a shape either answers
/// both questions or refuses by name.
void corners(Trial& trial, const Shape& shape)
{
  constexpr std::size_t all_of = 6;
  const std::vector<ParameterInfo>& infos = shape.parameters();
  const std::size_t count = std::size_t{1} << std::min(infos.size(), all_of);
  const std::vector<std::string> names = names_of(shape, draw_point(shape, trial).p);
  for (std::size_t corner = 0; corner < count; ++corner) {
    Values p;
    for (std::size_t k = 0; k < infos.size(); ++k) {
      const bool upper =
          infos.size() <= all_of ? (corner >> k & 1U) != 0 : trial.random.between(0.0, 1.0) < 0.5;
      const auto [low, high] = whole_range(infos[k]);
      const double end = upper ? infos[k].upper : infos[k].lower;
      p.push_back(std::isfinite(end) ? end : (upper ? high : low));
    }
    trial.look_at(shape, p);
    const auto message = refused(shape, p, trial);
    require(!message || names_one(*message, infos),
            "a corner of the bounds is refused without the name of a parameter: '{}'", message.value_or(""));
    if (message) continue;
    require_names(shape, p, names);
    for (const Primitive& primitive : shape.primitives(p)) require_closed(primitive);
    try {
      static_cast<void>(shape.jacobians(p));
    } catch (const InputError& error) {
      fail("parameters of which there are primitives have no Jacobians: '{}'", error.what());
    }
  }
}

/// Inside the bounds a shape may refuse what makes no sense; it must say which parameter.
void refusals(Trial& trial)
{
  const Object object = trial.make();
  const std::vector<ParameterInfo>& infos = object.shape->parameters();
  corners(trial, *object.shape);
  const std::vector<std::string> names = names_of(*object.shape, draw_point(*object.shape, trial).p);
  for (int draw_number = 0; draw_number < points(trial); ++draw_number) {
    const Point inside = draw(*object.shape, trial, draw_number);
    for (std::size_t k = 0; k < infos.size(); ++k) {
      for (const double end : {infos[k].lower, infos[k].upper}) {
        if (!std::isfinite(end)) continue;
        Values p = inside.p;
        p[k] = end;
        trial.look_at(*object.shape, p);
        const auto message = refused(*object.shape, p, trial);
        require(!message || names_one(*message, infos),
                "'{}' = {} is within its bounds and refused without the name of a parameter: '{}'",
                infos[k].name, end, message.value_or(""));
        if (message) continue;
        require_names(*object.shape, p, names);
        for (const Primitive& primitive : object.shape->primitives(p)) require_closed(primitive);
      }
    }
  }
}

void primitives(Trial& trial)
{
  const Object object = trial.make();
  std::vector<std::string> names;
  for (int draw_number = 0; draw_number < points(trial); ++draw_number) {
    const Point point = draw(*object.shape, trial, draw_number);
    std::vector<std::string> found;
    const std::vector<Primitive> here = object.shape->primitives(point.p);
    found.reserve(here.size());
    for (const Primitive& primitive : here) {
      found.push_back(primitive.name);
      require(!primitive.name.empty(), "a primitive has no name");
      require_closed(primitive);
    }
    require(std::set(found.begin(), found.end()).size() == found.size(), "two primitives have the same name");
    if (draw_number == 0) names = found;
    require_names(*object.shape, point.p, names);
    const std::size_t jacobians = object.shape->jacobians(point.p).size();
    require(jacobians == found.size(), "{} Jacobians for {} primitives", jacobians, found.size());
  }
}

/// Deviations with steps as large as the shape accepts: what it accepts need not be convex.
std::vector<Deviation> accepted_deviations(const Along& moved, const Values& column, double margin)
{
  constexpr int shrinkings = 6;
  for (int k = 0; k < shrinkings; ++k) {
    try {
      return deviations(moved, column, margin);
    } catch (const InputError&) {
      margin *= 0.25;
    }
  }
  return {};
}

/// What of a primitive is compared with differences.
struct Compared {
  std::function<Values(const Primitive&)> values;
  /// Their derivatives, out of a column of the primitive's Jacobian.
  std::function<Values(const Primitive&, const Values& column)> claimed;
  std::function<std::string(const Primitive&, std::size_t component)> name;
};

void compare_derivatives(Trial& trial, const Compared& compared)
{
  const Object object = trial.make();
  const Shape& shape = *object.shape;
  const std::size_t count = shape.parameters().size();
  if (count == 0) skip("it has no parameters");
  for (int draw_number = 0; draw_number < points(trial); ++draw_number) {
    const Point point = draw(shape, trial, draw_number);
    const std::vector<Primitive> here = shape.primitives(point.p);
    const std::vector<PrimitiveJacobian> claimed = shape.jacobians(point.p);
    require(claimed.size() == here.size(), "{} Jacobians for {} primitives", claimed.size(), here.size());
    for (std::size_t i = 0; i < here.size(); ++i) {
      Values column(claimed[i].size() / count);
      for (std::size_t k = 0; k < count; ++k) {
        for (std::size_t row = 0; row < column.size(); ++row) column[row] = claimed[i][row * count + k];
        const Along moved = [&](double s) {
          Values p = point.p;
          p[k] += s;
          return compared.values(primitives_at(shape, p, trial).at(i));
        };
        const Values expected = compared.claimed(here[i], column);
        for (const Deviation& wrong : accepted_deviations(moved, expected, point.margin[k]))
          fail("d({} of '{}')/d {} at {} = {:.6g}: {}", compared.name(here[i], wrong.component), here[i].name,
               shape.parameters()[k].name, shape.parameters()[k].name, point.p[k], text_of(wrong));
      }
    }
  }
}

void jacobians(Trial& trial)
{
  const auto all_but_rotation = [](const Primitive&, const Values& column) {
    return Values(column.begin(), column.end() - rotation_dofs);
  };
  compare_derivatives(trial, {quantities, all_but_rotation, quantity_name});
}

/// Rotations turn as the last three rows say, and do not where there are none: of Q all entries are compared,
/// with dQ/dp = skew(omega) Q.
void rotations(Trial& trial)
{
  const auto entries = [](const Mat3& Q) { return Values(Q.data(), Q.data() + Q.size()); };
  const auto values = [entries](const Primitive& primitive) { return entries(primitive.rotation); };
  const auto claimed = [entries](const Primitive& primitive, const Values& column) {
    const double* omega = column.data() + column.size() - rotation_dofs;
    return entries(skew(Vec3(omega[0], omega[1], omega[2])) * primitive.rotation);
  };
  const auto name = [](const Primitive&, std::size_t component) {
    return fmt::format("component {} of axis {}", "xyz"[component % 3], "xyz"[component / 3]);
  };
  compare_derivatives(trial, {values, claimed, name});
}

/// Distances of a solid from points near it and its probe, as functions of its sizes; `claimed` are
/// derivatives by them, as the solid gives them.
struct SolidSamples {
  std::vector<Vec3> points;
  std::vector<ProbeAngles> angles;
  std::vector<Vec3> directions;

  SolidSamples(const Solid& solid, Random& random)
  {
    constexpr int count = 6;
    for (int k = 0; k < count; ++k) {
      const double u = random.between(0.0, 6.28), v = random.between(0.0, 6.28);
      angles.push_back({std::cos(u), std::sin(u), 1.0, 0.0});
      if (solid.probe_dimension() == 2) angles.back() = {std::cos(u), std::sin(u), std::cos(v), std::sin(v)};
      directions.push_back(random.vector(1.0));
      const Vec3 x = solid.surface_point({std::cos(u), std::sin(u), std::cos(v), std::sin(v)});
      const double far = std::min(0.3 * solid.smoothness().reach, 0.3 * solid.radius());
      points.push_back(x + far * solid.distance(x).normal);
    }
  }
  Values values(const Solid& solid) const
  {
    Values out;
    for (std::size_t k = 0; k < points.size(); ++k) {
      out.push_back(solid.distance(points[k]).distance);
      out.push_back(directions[k].dot(solid.probe(angles[k]).x) - solid.offset());
    }
    return out;
  }
  /// Along a change of the sizes.
  Values claimed(const Solid& solid, const Values& sizes_change) const
  {
    Values out, by_size(sizes_change.size());
    const auto along = [&] {
      double sum = 0.0;
      for (std::size_t j = 0; j < by_size.size(); ++j) sum += by_size[j] * sizes_change[j];
      out.push_back(sum);
    };
    for (std::size_t k = 0; k < points.size(); ++k) {
      solid.distance_sizes(points[k], by_size);
      along();
      solid.probe_sizes(angles[k], directions[k], by_size);
      along();
    }
    return out;
  }
};

/// Sizes move the surface as the solid says: an element's sizes are designed by these derivatives.
void solid_sizes(Trial& trial)
{
  const Object object = trial.make();
  const Shape& shape = *object.shape;
  const std::size_t count = shape.parameters().size();
  bool any = false;
  for (int draw_number = 0; draw_number < 3; ++draw_number) {
    const Point point = draw_point(shape, trial);
    const std::vector<Primitive> here = shape.primitives(point.p);
    const std::vector<PrimitiveJacobian> jacobian = shape.jacobians(point.p);
    for (std::size_t i = 0; i < here.size(); ++i) {
      if (!here[i].solid) continue;
      any = true;
      const SolidSamples samples(*here[i].solid, trial.random);
      for (std::size_t k = 0; k < count; ++k) {
        Values change(here[i].solid->sizes().size());
        for (std::size_t j = 0; j < change.size(); ++j)
          change[j] = jacobian[i][(primitive_dofs + j) * count + k];
        const Along moved = [&](double s) {
          Values p = point.p;
          p[k] += s;
          return samples.values(*primitives_at(shape, p, trial).at(i).solid);
        };
        for (const Deviation& wrong :
             accepted_deviations(moved, samples.claimed(*here[i].solid, change), 0.2 * point.margin[k]))
          fail("the {} of '{}' by its sizes is not what its derivatives say, along {}: {}",
               wrong.component % 2 == 0 ? "distance" : "probe", here[i].name, shape.parameters()[k].name,
               text_of(wrong));
      }
    }
  }
  if (!any) skip("none of its primitives is a solid");
}

void shape_scaling(Trial& trial)
{
  const Object object = trial.make();
  const std::vector<ParameterInfo>& infos = object.shape->parameters();
  const auto is_length = [](const ParameterInfo& info) { return info.unit == "length"; };
  if (std::none_of(infos.begin(), infos.end(), is_length)) skip("none of its parameters is a length");
  int compared = 0;
  for (int draw_number = 0; draw_number < points(trial); ++draw_number) {
    const Point point = draw(*object.shape, trial, draw_number);
    const std::vector<Primitive> small = object.shape->primitives(point.p);
    for (const double factor : {2.0, 0.5}) {
      Node values = trial.section.values;
      scale_lengths(values, trial.section.fields, factor);
      Problems problems;
      const Object scaled = trial.make(values, problems);
      if (!scaled.shape) continue;  // a length of the section beyond its bounds
      Values p = point.p;
      for (std::size_t k = 0; k < p.size(); ++k) {
        if (is_length(infos[k])) p[k] *= factor;
      }
      if (refused(*scaled.shape, p, trial)) continue;
      const std::vector<Primitive> large = scaled.shape->primitives(p);
      for (std::size_t i = 0; i < std::min(small.size(), large.size()); ++i) {
        const Values a = quantities(small[i]), b = quantities(large[i]);
        const double largest = factor * std::max(small[i].position.norm(), small[i].R());
        // Sizes of a solid may have any unit; its distances are lengths.
        const std::size_t rows = small[i].solid ? primitive_dofs : std::min(a.size(), b.size());
        const double turned = (small[i].rotation - large[i].rotation).cwiseAbs().maxCoeff();
        require(turned <= shape_rounding, "with all lengths times {}, '{}' is turned, by {:.3g}", factor,
                small[i].name, turned);
        if (small[i].solid && large[i].solid) require_scaled(small[i], large[i], factor, trial.random);
        for (std::size_t row = 0; row < rows; ++row)
          require(std::abs(b[row] - factor * a[row]) <= shape_rounding * largest,
                  "with all lengths times {}, {} of '{}' goes from {:.12g} to {:.12g}; expected {:.12g}",
                  factor, quantity_name(small[i], row), small[i].name, a[row], b[row], factor * a[row]);
      }
      ++compared;
    }
  }
  require(compared > 0, "it refuses every scaled set of lengths; its bounds are too narrow for other units");
}

}  // namespace

void add_shape_checks(std::vector<Check>& out)
{
  const auto add = [&](const char* name, const char* about, void (*function)(Trial&)) {
    out.push_back(of_trial(name, PluginKind::shape, about, function));
  };
  add("shape.parameters", "parameters have names, units, docs, and defaults within their bounds", parameters);
  add("shape.bounds", "values outside the bounds are refused with the parameter's name", parameter_bounds);
  add("shape.refusals",
      "at the ends of their bounds, parameters make closed primitives or are refused by name", refusals);
  add("shape.primitives", "primitives are closed; names, number and order do not depend on parameters",
      primitives);
  add("shape.jacobians", "Jacobians are the derivatives: differences approach them with slope 2", jacobians);
  add("shape.solid_sizes", "sizes of solids move distance and probe as the solid says", solid_sizes);
  add("shape.rotations", "rotations turn as Jacobians say: differences approach them with slope 2",
      rotations);
  add("shape.scaling", "all lengths times c gives positions and sizes times c, and turns nothing",
      shape_scaling);
  add("shape.surface",
      "surfaces of primitives are closed, do not meet themselves, and are within their spheres",
      check_surfaces);
  add("shape.distances", "gaps by the kinds of the primitives are those of samples of their surfaces",
      check_distances);
  add("shape.smooth", "primitives depend on smooth parameters without jumps or kinks", check_smoothness);
}

}  // namespace hauberk::conformance
