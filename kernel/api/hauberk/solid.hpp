#pragma once
/// Interface for solids: closed surfaces that a plugin gives by a chart and a distance, where the kernel
/// knows none of their formulas.
///
/// Contact is one reduction: points that ride on one body, its *probe*, in the distance field of the other. A
/// solid gives both. Most authors write neither: they write a chart and an implicit function as two
/// templates, and `hauberk/kit/implicit_solid.hpp` makes a solid of them, with derivatives and certified
/// bounds.

#include <hauberk/linalg.hpp>

#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

/// Coordinates of a probe by cosine and sine. Probes are periodic, with the period 2 pi in u and in v: a pole
/// or an end of a curve is a *fold*, where the chart turns back on itself and stays smooth, as
/// (sin v cos u, sin v sin u, cos v) does on a sphere and cos u on the segment from -1 to 1.
struct ProbeAngles {
  double cos_u = 1.0, sin_u = 0.0;
  double cos_v = 1.0, sin_v = 0.0;  ///< 1 and 0 of a probe of dimension 1
};

/// A point of a probe and its derivatives, all in v zero where the probe has one dimension.
struct ProbeDerivatives {
  Vec3 x, u, v;     ///< the point, d/du, d/dv
  Vec3 uu, uv, vv;  ///< second derivatives
};

/// Upper bounds of the lengths of derivatives over a part of a probe.
struct ProbeBounds {
  double u = 0.0, v = 0.0;
  double uu = 0.0, uv = 0.0, vv = 0.0;
  double uuu = 0.0, uuv = 0.0, uvv = 0.0, vvv = 0.0;
};

/// Which other coordinates mean the same point of a probe. A contact that is found at both counts once.
enum class Fold {
  none,
  mirror,  ///< (u, v) and (u, -v); of dimension 1 u and -u: ends
  pole     ///< (u, v) and (u + pi, -v): poles
};

/// The distance from a surface at a point.
struct SolidDistance {
  double distance = 0.0;  ///< along the normal from its foot on the surface to the point, negative inside
  double at_least = 0.0;  ///< a lower bound of the distance from the surface; `distance` where it is certain
  Vec3 normal;            ///< unit, outward at the foot: the gradient of the distance
  Vec3 along;             ///< unit, perpendicular to it: first principal direction of the level surface
  double bend_along = 0.0, bend_across = 0.0;  ///< principal curvatures there, positive where convex
};

/// How smooth the distance is, over the whole surface.
struct SolidSmoothness {
  double convex = 0.0;  ///< largest principal curvature, at least 0
  /// A ball of this radius that touches the surface from outside anywhere holds no other point of it, so
  /// that up to there distances have one foot; infinite of a convex solid. 0 states nothing, and leaves
  /// contact with bounds that are slow.
  double reach = 0.0;
  /// Largest derivative of the normal curvature along unit-speed geodesics; infinite where curvature jumps.
  double change = std::numeric_limits<double>::infinity();
};

/// A closed surface with its sizes fixed. Lengths are in the unit of the experiment, vectors in the frame of
/// the primitive. Immutable, so that all calls are thread safe; none may throw.
class Solid {
 public:
  virtual ~Solid() = default;

  /// What results call it, for instance "capsule".
  virtual std::string kind() const = 0;
  /// Names of the sizes, and their values in the same order. They alone determine the surface.
  virtual std::vector<std::string> size_names() const = 0;
  virtual const std::vector<double>& sizes() const = 0;
  /// Radius of a ball about the origin that holds it.
  virtual double radius() const = 0;
  /// Smallest radius of curvature where it is convex, at most `radius`; 0 where no bound of it is known: such
  /// sizes are refused, by name.
  virtual double thickness() const = 0;

  /// 1: a curve, whose points are `offset` from the surface; 2: the surface itself.
  virtual int probe_dimension() const = 0;
  /// Constant distance of the probe from the surface, 0 of dimension 2.
  virtual double offset() const = 0;
  virtual Fold fold() const = 0;
  virtual ProbeDerivatives probe(const ProbeAngles& at) const = 0;
  /// Over |u - at_u| <= half_u, |v - at_v| <= half_v, radians.
  virtual ProbeBounds probe_bounds(double at_u, double at_v, double half_u, double half_v) const = 0;

  /// A point of the surface by the same kind of coordinates, for pictures and meshes.
  virtual Vec3 surface_point(const ProbeAngles& at) const = 0;

  virtual SolidDistance distance(const Vec3& x) const = 0;
  virtual SolidSmoothness smoothness() const = 0;

  /// d distance(x)/d size, one for each.
  virtual void distance_sizes(const Vec3& x, std::span<double> out) const = 0;
  /// d (n . probe - offset)/d size at fixed coordinates.
  virtual void probe_sizes(const ProbeAngles& at, const Vec3& n, std::span<double> out) const = 0;

  /// The same kind of solid with other sizes; null where they make none, or where it is not known how.
  /// Designs need it, and `speed`.
  virtual std::shared_ptr<const Solid> with_sizes(std::span<const double> /*sizes*/) const { return nullptr; }
  /// While the sizes go straight to those, a part t of the way moves the surface by no more than t times
  /// this: no point of either is farther from the other. Infinite: not known.
  virtual double speed(std::span<const double> /*sizes*/) const
  {
    return std::numeric_limits<double>::infinity();
  }

  /// Corners of a closed polygon for each core curve, inside and not linked with itself otherwise than the
  /// solid is; links are counted by them. None of a solid without holes.
  virtual std::vector<std::vector<Vec3>> cores() const = 0;
};

}  // namespace hauberk
