#pragma once
/// Curves through values against direction, as polar diagrams draw them.

#include <utility>
#include <vector>

namespace hauberk::detail {

/// Values against degrees, in increasing order of degrees.
using AngularValues = std::vector<std::pair<double, double>>;

/// Through the values a curve in steps of at most two degrees, which has them among its points and lies
/// nowhere beyond the two between which it is: a monotone piecewise cubic in the angle (F. N. Fritsch and
/// J. Butland, A method for constructing local monotone piecewise cubic interpolants, SIAM J. Sci. Stat.
/// Comput. 5, 1984), so that equal values lie on a circle. Profiles have cusps: values more than 15 degrees
/// apart say nothing about what is between them, and have no points between them. Fewer than four values are
/// joined by what is straight in the angle. `closed`: the last is joined to the first, 360 degrees on, with
/// which the curve ends.
AngularValues angular_curve(const AngularValues& values, bool closed);

/// The parts of a curve where it is not above `largest`, with their ends there.
std::vector<AngularValues> within(const AngularValues& curve, double largest);

}  // namespace hauberk::detail
