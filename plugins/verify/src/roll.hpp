#pragma once
/// The motion of cylinder_roll as geometry: the place (y, z) of the flat sheet goes to the end of a walk of
/// length |y| that leaves the origin along y and turns at a constant rate about an axis in the plane z = 0,
/// and from there by z along the normal, which has turned with it. In all the normal e_z is turned by |K y|
/// towards -K y.
#include "model.hpp"

namespace hauberk::verification {

/// Where the place `at` = (y, z) of the flat sheet is on the rolled one. `curvature` are kxx, kyy, kxy; any
/// unit of length.
Vec3 rolled(const Macros& curvature, const Vec3& at);

/// Derivatives of that by kxx, kyy, kxy and by the place: five-point differences.
Eigen::Matrix<double, 3, 6> rolled_derivatives(const Macros& curvature, const Vec3& at);

/// The place that is rolled to x, by Newton's method from the rest place and, where that leads half a radius
/// of curvature off the sheet, from others around the origin: of those that end at x the one nearest to rest.
/// Where none does the last iterate, so that rolling it again does not give x.
Vec3 unrolled(const Macros& curvature, const Vec3& x, const Vec3& rest);

}  // namespace hauberk::verification
