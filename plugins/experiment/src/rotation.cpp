#include "rotation.hpp"

#include "document/field_helpers.hpp"
#include "document/node_access.hpp"

#include <Eigen/Geometry>

#include <cmath>

namespace hauberk {

namespace {

/// (cos, sin) with exact values at multiples of 90 degrees.
std::pair<double, double> cos_sin(double degrees)
{
  const double turn = std::remainder(degrees, 360.0);  // exact
  const double quarter = std::round(turn / 90.0);
  const double rest = (turn - 90.0 * quarter) * degree;
  const double c = std::cos(rest), s = std::sin(rest);
  switch ((static_cast<int>(quarter) + 4) % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

}  // namespace

Mat3 rotation_about(const Vec3& axis, double degrees)
{
  const Vec3 a = axis / axis.norm();
  const auto [c, s] = cos_sin(degrees);
  return c * Mat3::Identity() + s * skew(a) + (1.0 - c) * a * a.transpose();
}

Field rotation_field(const std::string& of)
{
  using namespace fields;
  return object(
      "rotation",
      "Active, right-handed rotation about the " + of +
          "'s origin, applied before translation: axis and degrees, or a quaternion. Absent: none.",
      {numbers("axis", "Axis; normalised.", 3), number("degrees", "Angle about the axis.", "degree"),
       numbers("quaternion", "Quaternion [w, x, y, z]; normalised.", 4)});
}

Mat3 read_rotation(const Node* rotation, Problems& problems)
{
  if (rotation == nullptr) return Mat3::Identity();
  const Node* axis = find_typed(*rotation, "axis", Node::Type::array);
  const Node* quaternion = find_typed(*rotation, "quaternion", Node::Type::array);
  const std::optional<double> degrees = optional_number(*rotation, "degrees");
  const bool turned = axis != nullptr && degrees && quaternion == nullptr;
  const bool given = quaternion != nullptr && axis == nullptr && !degrees;
  if (!turned && !given) {
    problems.add(*rotation, "expected either axis and degrees, or quaternion");
    return Mat3::Identity();
  }
  const std::vector<double> v = (turned ? axis : quaternion)->numbers();
  double largest = 0.0;
  for (const double x : v) largest = std::max(largest, std::abs(x));
  if (largest == 0.0) {
    problems.add(turned ? *axis : *quaternion, "expected a direction, found all zeros");
    return Mat3::Identity();
  }
  // Scaled first, so that the norm can neither overflow nor vanish.
  if (turned) return rotation_about(Vec3(v[0], v[1], v[2]) / largest, *degrees);
  Eigen::Quaterniond q(v[0] / largest, v[1] / largest, v[2] / largest, v[3] / largest);
  q.normalize();
  return q.toRotationMatrix();
}

}  // namespace hauberk
