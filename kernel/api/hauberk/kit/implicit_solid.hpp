#pragma once
/// A solid made of an author's chart and field; see author.hpp for what is written, solid.hpp for what it
/// gives.

#include <hauberk/kit/lazy.hpp>
#include <hauberk/kit/reach.hpp>
#include <hauberk/kit/section_segments.hpp>
#include <hauberk/kit/size_motion.hpp>
#include <hauberk/kit/surface_balls.hpp>

#include <stdexcept>

namespace hauberk::kit {

template <class Author>
class ImplicitSolid final : public Solid {
  using Say = Statements<Author>;
  using Surface = Chart<Author, false>;
  using Probe = Chart<Author, Say::has_core>;

 public:
  /// Throws std::invalid_argument unless there is one finite size for each name.
  explicit ImplicitSolid(std::vector<double> sizes) : sizes_(std::move(sizes))
  {
    if (sizes_.size() != Say::sizes)
      throw std::invalid_argument(std::string(Author::kind) + ": number of sizes");
    for (const double x : sizes_)
      if (!std::isfinite(x))
        throw std::invalid_argument(std::string(Author::kind) + ": a size is not finite");
    // The field's scale where lengths are compared with rounding; no bound is taken from it.
    for (int k = 0; k < 16; ++k)
      scale_ = std::max(scale_, chart_point<Author>(turn(2.4 * k), turn(1.7 * k + 0.3), q()).norm());
  }

  std::string kind() const override { return Author::kind; }
  std::vector<std::string> size_names() const override
  {
    return {Author::size_names.begin(), Author::size_names.end()};
  }
  const std::vector<double>& sizes() const override { return sizes_; }
  double radius() const override
  {
    return radius_.get([&] { return farthest_point<Author>(q()); });
  }
  double thickness() const override
  {
    if constexpr (Say::has_core)
      return offset();
    else
      return std::min(radius(), 1.0 / curvature().convex);
  }

  int probe_dimension() const override { return Probe::dimension; }
  double offset() const override
  {
    if constexpr (Say::has_core)
      return Author::template radius<double>(q());
    else
      return 0.0;
  }
  Fold fold() const override { return Say::fold; }

  ProbeDerivatives probe(const ProbeAngles& at) const override
  {
    const auto x =
        Probe::template jet<2>(Turn<double>{at.cos_u, at.sin_u}, Turn<double>{at.cos_v, at.sin_v}, q());
    const auto vector = [&](std::size_t m, double factor) {
      return Vec3(x[0].c[m] * factor, x[1].c[m] * factor, x[2].c[m] * factor);
    };
    const Vec3 none = Vec3::Zero();
    if constexpr (Say::has_core)
      return {vector(0, 1.0), vector(1, 1.0), none, vector(2, 2.0), none, none};
    else
      return {vector(0, 1.0), vector(1, 1.0), vector(2, 1.0), vector(3, 2.0), vector(4, 1.0), vector(5, 2.0)};
  }

  ProbeBounds probe_bounds(double at_u, double at_v, double half_u, double half_v) const override
  {
    if constexpr (Say::has_core) {
      const auto make = [&] { return ChartBounds<Probe>(q()); };
      return core_.get(make).over(at_u, at_v, half_u, half_v);
    } else {
      return surface().over(at_u, at_v, half_u, half_v);
    }
  }

  Vec3 surface_point(const ProbeAngles& at) const override
  {
    return chart_point<Author>({at.cos_u, at.sin_u}, {at.cos_v, at.sin_v}, q());
  }

  SolidDistance distance(const Vec3& x) const override
  {
    const FieldAt f = regular_field<Author>(x, q(), scale_);
    if constexpr (Say::field_is_distance) {
      SolidDistance s = level_surface(f);
      s.distance = s.at_least = f.value;
      return s;
    } else {
      const Foot foot = FootSearch<Author>(x, q(), scale_).from(f);
      if (!foot.found) return searched(x, f, nullptr);
      const SolidDistance s = at_foot(x, foot.y);
      return is_nearest(s.distance) ? s : searched(x, f, &s);
    }
  }

  SolidSmoothness smoothness() const override
  {
    return smoothness_.get([&] {
      return SolidSmoothness{curvature().convex, reach(), change_bound<Author>(q())};
    });
  }

  /// Of the implicit surface f(y, q) = 0 the distance changes by (df/dq)/|grad f| at the foot.
  void distance_sizes(const Vec3& x, std::span<double> out) const override
  {
    Vec3 y = x;
    FieldAt f = regular_field<Author>(x, q(), scale_);
    if constexpr (!Say::field_is_distance) {
      const Foot foot = FootSearch<Author>(x, q(), scale_).from(f);
      if (foot.found) y = foot.y, f = FieldAt(field_jet<Author, 2>(y, q()));
    }
    using J = Jet<double, Say::sizes, 1>;
    const auto sizes = size_jets();
    const J value = Author::template field<J>({J(y.x()), J(y.y()), J(y.z())}, sizes.data());
    for (std::size_t k = 0; k < Say::sizes; ++k) out[k] = value.slope(k) / f.steep;
  }

  void probe_sizes(const ProbeAngles& at, const Vec3& n, std::span<double> out) const override
  {
    using J = Jet<double, Say::sizes, 1>;
    const auto sizes = size_jets();
    const Turn<J> u{J(at.cos_u), J(at.sin_u)}, v{J(at.cos_v), J(at.sin_v)};
    const Point<J> x = Probe::at(u, v, sizes.data());
    J moves = x[0] * n.x() + x[1] * n.y() + x[2] * n.z();
    if constexpr (Say::has_core) moves -= Author::template radius<J>(sizes.data());
    for (std::size_t k = 0; k < Say::sizes; ++k) out[k] = moves.slope(k);
  }

  std::shared_ptr<const Solid> with_sizes(std::span<const double> sizes) const override
  {
    const bool right = sizes.size() == Say::sizes &&
                       std::all_of(sizes.begin(), sizes.end(), [](double x) { return std::isfinite(x); });
    if (!right) return nullptr;
    return std::make_shared<const ImplicitSolid>(std::vector<double>(sizes.begin(), sizes.end()));
  }
  double speed(std::span<const double> sizes) const override { return surface_speed<Author>(sizes_, sizes); }

  std::vector<std::vector<Vec3>> cores() const override { return Author::cores(q()); }

 private:
  const double* q() const { return sizes_.data(); }

  const CurvatureBounds& curvature() const
  {
    return curvature_.get([&] { return curvature_bounds<Author>(q()); });
  }
  double reach() const
  {
    return reach_.get([&] { return ReachSearch<Author>(q(), curvature().concave).bound(); });
  }
  const ChartBounds<Surface>& surface() const
  {
    return surface_.get([&] { return ChartBounds<Surface>(q()); });
  }

  std::array<Jet<double, Say::sizes, 1>, Say::sizes> size_jets() const
  {
    std::array<Jet<double, Say::sizes, 1>, Say::sizes> list;
    for (std::size_t k = 0; k < Say::sizes; ++k)
      list[k] = Jet<double, Say::sizes, 1>::variable(sizes_[k], static_cast<int>(k));
    return list;
  }

  SolidDistance at_foot(const Vec3& x, const Vec3& foot) const
  {
    SolidDistance s = parallel_surface(x, foot, FieldAt(field_jet<Author, 2>(foot, q())));
    s.at_least = s.distance;
    return s;
  }

  /// Whether the distance from a foot is that from the surface: outside a foot within the reach is the
  /// nearest point; inside any point of the surface bounds the depth.
  bool is_nearest(double distance) const { return distance <= 0.0 || distance < reach(); }

  /// The distance where `first`, that from a foot, may not be the least, or where no foot is known: balls
  /// around the surface (segments along the section of a revolved one) bound it, and Newton's method begins
  /// once more at the nearest point of theirs.
  SolidDistance searched(const Vec3& x, const FieldAt& f, const SolidDistance* first) const
  {
    constexpr double tight = 0.98;
    const double known = first ? first->distance : std::numeric_limits<double>::infinity();
    const BallDistance balls = bounded(x, tight * known);
    SolidDistance s = first ? *first : level_surface(f);
    bool has_foot = first != nullptr;
    if (!has_foot) s.distance = s.at_least = std::copysign(balls.distance, f.value);
    if (balls.distance < known) {
      const Foot foot = FootSearch<Author>(x, q(), scale_).from(f, balls.near);
      const SolidDistance other = foot.found ? at_foot(x, foot.y) : s;
      if (foot.found && (!has_foot || other.distance < s.distance)) s = other, has_foot = true;
    }
    const bool certain = s.distance <= 0.0 || (has_foot && is_nearest(s.distance));
    if (!certain) s.at_least = std::min(s.distance, balls.at_least);
    return s;
  }

  /// What balls around the surface tell of x, of a surface of revolution segments along its section.
  BallDistance bounded(const Vec3& x, double enough) const
  {
    if (revolved_.get([&] { return ChartDomain::of<Author>(q()).revolved; }))
      return segments_.get([&] { return SectionSegments<Author>(q(), surface()); }).of(x, enough);
    return balls_.get([&] { return SurfaceBalls<Author>(q(), surface()); }).of(x, enough);
  }

  std::vector<double> sizes_;
  double scale_ = 0.0;
  Lazy<ChartBounds<Surface>> surface_;
  Lazy<ChartBounds<Probe>> core_;
  Lazy<CurvatureBounds> curvature_;
  Lazy<double> reach_;
  Lazy<SolidSmoothness> smoothness_;
  Lazy<double> radius_;
  Lazy<bool> revolved_;
  Lazy<SectionSegments<Author>> segments_;
  Lazy<SurfaceBalls<Author>> balls_;
};

}  // namespace hauberk::kit
