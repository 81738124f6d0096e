/// A torus as a solid of its own, and with a defect.
///
/// x(u, v) = ((R + r cos v) cos u, (R + r cos v) sin u, r sin v); the distance is that from the circle of
/// radius R, less r. At a point whose foot has the coordinate v, d from the surface, the level surface is the
/// torus of R and r + d, with the principal curvatures 1/(r + d) and cos v/(R + (r + d) cos v).

#include "defect.hpp"
#include "delegating_strut.hpp"

#include <hauberk/error.hpp>
#include <hauberk/solid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hauberk::mutants {
namespace {

class Torus final : public Solid {
 public:
  Torus(std::string defect, double R, double r) : defect_(std::move(defect)), R_(R), r_(r), sizes_{R, r} {}

  std::string kind() const override { return "torus"; }
  std::vector<std::string> size_names() const override { return {"R", "r"}; }
  const std::vector<double>& sizes() const override { return sizes_; }
  double radius() const override { return is("radius_times_0.9") ? 0.9 * (R_ + r_) : R_ + r_; }
  double thickness() const override { return r_; }
  int probe_dimension() const override { return 2; }
  double offset() const override { return is("offset") ? 0.01 * r_ : 0.0; }
  Fold fold() const override { return is("fold") ? Fold::mirror : Fold::none; }

  ProbeDerivatives probe(const ProbeAngles& at) const override
  {
    ProbeDerivatives p = regular_probe(bent(at));
    if (is("first_derivative_jumps")) {
      const double side = at.sin_v < 0.0 ? -1.0 : 1.0;
      const double first = 1.0 + kink * side * at.cos_v, second = -kink * side * at.sin_v;
      p.vv = first * first * p.vv + second * p.v;
      p.v *= first;
      p.uv *= first;
    }
    return p;
  }

  ProbeDerivatives regular_probe(const ProbeAngles& at) const
  {
    const double out = R_ + r_ * at.cos_v;
    ProbeDerivatives p;
    p.x = Vec3(out * at.cos_u, out * at.sin_u, r_ * at.sin_v);
    p.u = Vec3(-out * at.sin_u, out * at.cos_u, 0.0);
    p.v = r_ * Vec3(-at.sin_v * at.cos_u, -at.sin_v * at.sin_u, at.cos_v);
    p.uu = Vec3(-out * at.cos_u, -out * at.sin_u, 0.0);
    p.uv = r_ * at.sin_v * Vec3(at.sin_u, -at.cos_u, 0.0);
    p.vv = -r_ * Vec3(at.cos_v * at.cos_u, at.cos_v * at.sin_u, at.sin_v);
    if (is("probe_derivative_sign")) p.v *= -1.0;
    if (is("probe_second_derivative")) p.uv *= -1.0;
    if (is("probe_by_whim")) p.x.z() += whim("process_id", this, at.cos_u);
    return p;
  }

  /// |d/du| and |d2/du2| are R + r cos v, |d2/du dv| is r |sin v|; the rest is r.
  ProbeBounds probe_bounds(double, double v, double, double half_v) const override
  {
    const double out = R_ + r_ * largest_cosine(v, half_v);
    const double across =
        r_ * std::max(largest_cosine(v - half_pi, half_v), largest_cosine(v + half_pi, half_v));
    ProbeBounds b{out, r_, out, across, r_, out, r_, r_, r_};
    if (is("first_derivative_jumps")) {
      const double most = R_ + r_, more = (1.0 + kink) * (1.0 + kink) * (1.0 + kink) + 4.0 * kink;
      b = {most, more * r_, most, more * r_, more * r_, most, more * r_, more * r_, more * r_};
    }
    if (is("probe_bounds_times_0.9")) b.u *= 0.9;
    if (is("probe_bounds_times_0.5")) b.vv *= 0.5;
    if (is("probe_bounds_of_the_middle")) b.u = R_ + r_ * std::cos(v);
    if (is("probe_bounds_of_the_ends")) b.u = R_ + r_ * std::max(std::cos(v - half_v), std::cos(v + half_v));
    if (is("mixed_bound_times_0.9")) b.uv *= 0.9;
    if (is("third_bounds_times_0.5")) b.uuu *= 0.5;
    return b;
  }

  Vec3 surface_point(const ProbeAngles& at) const override
  {
    const double out = R_ + r_ * at.cos_v;
    if (is("chart_of_another_torus")) return {1.001 * out * at.cos_u, 1.001 * out * at.sin_u, r_ * at.sin_v};
    return {out * at.cos_u, out * at.sin_u, r_ * at.sin_v};
  }

  SolidDistance distance(const Vec3& x) const override
  {
    const double out = std::hypot(x.x(), x.y());
    const Vec3 radial = out > 0.0 ? Vec3(x.x() / out, x.y() / out, 0.0) : Vec3(1.0, 0.0, 0.0);
    const Vec3 from = x - R_ * radial;
    const double far = from.norm(), cos_v = far > 0.0 ? from.dot(radial) / far : 1.0;
    SolidDistance d;
    d.distance = d.at_least = far - r_;
    d.normal = far > 0.0 ? Vec3(from / far) : radial;
    d.along = Vec3(-radial.y(), radial.x(), 0.0);
    d.bend_along = cos_v / (R_ + far * cos_v);
    d.bend_across = 1.0 / far;
    spoil(x, d);
    return d;
  }

  SolidSmoothness smoothness() const override
  {
    // Along a geodesic at the angle A to the parallel the normal curvature is cos^2 A k + sin^2 A/r with
    // k = cos v/(R + r cos v), |dk/dv| <= R/(R - r)^2, |dv/ds| <= 1/r, and |dA/ds| <= 1/(R - r) (Clairaut).
    const double hole = R_ - r_;
    SolidSmoothness s{1.0 / r_, hole, R_ / (r_ * hole * hole) + (1.0 / r_ + 1.0 / hole) / hole};
    if (is("change_of_a_sphere")) s.change = 0.0;
    if (is("convex_times_0.9")) s.convex *= 0.9;
    if (is("convex_times_0.5")) s.convex *= 0.5;
    if (is("convex_of_the_outer_side")) s.convex = 1.0 / (R_ + r_);
    if (is("reach_times_1.1")) s.reach *= 1.1;
    if (is("reach_times_2")) s.reach *= 2.0;
    if (is("said_to_be_convex")) s.reach = std::numeric_limits<double>::infinity();
    return s;
  }

  void distance_sizes(const Vec3& x, std::span<double> out) const override
  {
    const double flat = std::hypot(x.x(), x.y());
    const double far = std::hypot(flat - R_, x.z());
    out[0] = -(flat - R_) / far;
    out[1] = is("distance_by_r_sign") ? 1.0 : -1.0;
    if (is("distance_by_R_nearly_right")) out[0] *= 1.0 + 1e-6;
  }

  void probe_sizes(const ProbeAngles& given, const Vec3& n, std::span<double> out) const override
  {
    const ProbeAngles at = bent(given);
    out[0] = n.x() * at.cos_u + n.y() * at.sin_u;
    out[1] = at.cos_v * out[0] + n.z() * at.sin_v;
    if (is("probe_by_r_forgets_z")) out[1] -= n.z() * at.sin_v;
  }

  std::vector<std::vector<Vec3>> cores() const override
  {
    constexpr int corners = 16;
    std::vector<Vec3> core;
    for (int k = 0; k < corners; ++k) {
      const double u = 4.0 * half_pi * k / corners;
      core.emplace_back(R_ * std::cos(u), R_ * std::sin(u), 0.0);
    }
    return {core};
  }

 private:
  static constexpr double half_pi = 1.5707963267948966;
  static constexpr double kink = 0.05;
  bool is(const char* defect) const { return defect_ == defect; }

  /// The same circle by v + kink |sin v|: its first derivative is right wherever it exists, and jumps at v =
  /// 0 and pi.
  ProbeAngles bent(const ProbeAngles& at) const
  {
    if (!is("first_derivative_jumps")) return at;
    const double by = kink * std::abs(at.sin_v), c = std::cos(by), s = std::sin(by);
    return {at.cos_u, at.sin_u, at.cos_v * c - at.sin_v * s, at.sin_v * c + at.cos_v * s};
  }

  static double largest_cosine(double v, double half)
  {
    // The nearest multiple of 2 pi is within the interval, or an end is nearest to it.
    const double off = std::abs(std::remainder(v, 4.0 * half_pi));
    return off <= half ? 1.0 : std::cos(off - half);
  }

  void spoil(const Vec3& x, SolidDistance& d) const
  {
    if (is("field_without_the_tube")) d.distance = d.at_least = d.distance + 1e-6 * r_;
    if (is("field_is_no_distance")) d.distance *= 1.0 + 1e-3;
    if (is("inside_positive")) d.distance = std::abs(d.distance);
    if (is("certain_of_too_much")) d.at_least *= 1.05;
    if (is("normal_inwards")) d.normal *= -1.0;
    if (is("normal_not_unit")) d.normal *= 1.001;
    if (is("curvatures_swapped")) std::swap(d.bend_along, d.bend_across);
    if (is("curvature_of_the_surface")) d.bend_across = 1.0 / r_;
    if (is("shifted_field")) d.distance += 1e-6 * x.z();
  }

  std::string defect_;
  double R_, r_;
  std::vector<double> sizes_;
};

/// A straight strut whose curvature is said not to jump where its cylinder meets its caps.
class SmoothStrut final : public test::DelegatingStrut {
 public:
  using DelegatingStrut::DelegatingStrut;
  SolidSmoothness smoothness() const override
  {
    SolidSmoothness s = DelegatingStrut::smoothness();
    s.change = 1e-11;
    return s;
  }
};

/// One torus.
class Mutant final : public Shape {
 public:
  explicit Mutant(std::string defect) : defect_(std::move(defect)) {}

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override
  {
    if (p[1] >= p[0])
      throw InputError(
          fmt::format("parameter 'r' = {} must be smaller than 'R' = {}: it closes the hole", p[1], p[0]));
    Primitive torus;
    torus.name = "torus";
    torus.kind = PrimitiveKind::solid;
    torus.solid = std::make_shared<const Torus>(defect_, p[0], p[1]);
    if (defect_ == "jump_of_a_thin_strut_not_told")
      torus.solid = std::make_shared<const SmoothStrut>(p[0], 1e-3 * p[1]);
    if (defect_ == "jump_of_curvature_not_told")
      torus.solid = std::make_shared<const SmoothStrut>(p[0], p[1]);
    out.push_back(torus);
  }
  void do_jacobians(std::span<const double>, std::vector<PrimitiveJacobian>& out) const override
  {
    PrimitiveJacobian J(16, 0.0);
    J[12] = J[15] = 1.0;  // two sizes by two parameters
    if (defect_ == "jump_of_a_thin_strut_not_told") J[15] = 1e-3;
    if (defect_ == "sizes_by_parameters") std::swap(J[12], J[13]);
    out.push_back(J);
  }

 private:
  std::string defect_;
  std::vector<ParameterInfo> parameters_{{"R", "length", 5.0, 1e-6, 1e6, "radius of the circle"},
                                         {"r", "length", 1.0, 1e-6, 1e6, "radius of the tube"}};
};

std::unique_ptr<Shape> make(const Node& section, Problems&)
{
  return std::make_unique<Mutant>(defect_of(section));
}

}  // namespace
}  // namespace hauberk::mutants

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::shape,
    "mutant_solid",
    "1.0",
    "A torus as a solid, with a defect.",
    "none",
    hauberk::mutants::add_defect_field,
    hauberk::mutants::make,
    nullptr,
    nullptr};
