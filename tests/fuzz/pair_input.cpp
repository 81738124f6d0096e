#include "pair_input.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hauberk::fuzz {
namespace {

/// Numbers from bytes; zeros once they are used up.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : next_(data), left_(size) {}

  int byte()
  {
    if (left_ == 0) return 0;
    --left_;
    return *next_++;
  }
  /// -128 .. 127
  int small() { return static_cast<std::int8_t>(byte()); }
  /// [-1, 1], exactly 0 for 0.
  double fraction()
  {
    const int high = small(), low = byte();
    return (high * 256 + low) / 32768.0;
  }
  /// 10^-decades .. 10^decades, exactly 1 for 0.
  double factor(double decades) { return std::pow(10.0, small() * decades / 127.0); }
  /// 0, or a positive number down to 10^-decades.
  double tiny(double decades)
  {
    const int b = byte();
    return b == 0 ? 0.0 : std::pow(10.0, -b * decades / 255.0);
  }

 private:
  const std::uint8_t* next_;
  std::size_t left_;
};

brute::Torus torus(Bytes& bytes)
{
  constexpr std::array<double, 8> ratios{0.1, 0.5, 0.25, 0.75, 0.999, 1e-3, 1e-6, 1.0 - 1e-9};
  brute::Torus t;
  t.R = bytes.factor(3.0);
  const int ratio = bytes.byte();
  t.r0 = t.R * (ratio < 8 ? ratios[ratio] : ratio / 256.0);
  t.r1 = t.r0 * bytes.factor(3.0);
  return t;
}

/// A sum of radii in which things touch or are concentric, or any length, and a little more or less.
double length(Bytes& bytes, const brute::Torus& a, const brute::Torus& b)
{
  int choice = bytes.byte();
  double x = 0.0;
  if (choice < 243) {
    for (const double part : {a.R, b.R, a.r0, b.r0, a.r1}) {
      constexpr std::array<double, 3> signs{0.0, 1.0, -1.0};
      x += signs[choice % 3] * part;
      choice /= 3;
    }
  } else {
    x = 3.0 * (a.R + b.R) * bytes.fraction();
  }
  const int nudge = bytes.small();
  if (nudge != 0) x += std::copysign(a.R * std::pow(10.0, -std::abs(nudge) / 8.0), nudge);
  return x;
}

Mat3 rotation(Bytes& bytes)
{
  const int choice = bytes.byte();
  if (choice % 4 == 0) return Mat3::Identity();
  if (choice % 4 == 1) return rotation_exp(0.5 * std::numbers::pi * Vec3::Unit((choice / 4) % 3));
  if (choice % 4 == 2) return rotation_exp(bytes.tiny(17.0) * Vec3::Unit((choice / 4) % 3));
  const double x = bytes.fraction(), y = bytes.fraction(), z = bytes.fraction();
  return rotation_exp(std::numbers::pi * Vec3(x, y, z));
}

}  // namespace

PairInput decode(const std::uint8_t* data, std::size_t size)
{
  Bytes bytes(data, size);
  PairInput in;
  in.a = torus(bytes);
  in.b = torus(bytes);
  const int place = bytes.byte();
  // On the axis, in the plane, or anywhere.
  for (int k = 0; k < 3; ++k) {
    const bool used = place % 3 == 0 ? k == 2 : place % 3 == 1 ? k == 0 : true;
    if (used) in.b.center[k] = length(bytes, in.a, in.b);
  }
  in.b.axes = rotation(bytes);
  in.clearance = 0.1 * bytes.tiny(12.0) * std::min(1.0, in.b.R / in.a.R);
  in.frame.rotation = rotation(bytes);
  for (int k = 0; k < 3; ++k) in.frame.position[k] = 10.0 * bytes.fraction();
  for (const int element : {0, 1}) {
    const double far = 4.0 * bytes.tiny(8.0), turn = 4.0 * bytes.tiny(8.0);
    for (int k = 0; k < 6; ++k) {
      const int unknown = 3 + 6 * element + k;
      in.step[unknown] = (k < 3 ? far : turn) * bytes.fraction();
    }
  }
  const double strain = 0.5 * bytes.tiny(8.0);
  for (std::size_t k = 0; k < 3; ++k) in.step[k] = strain * bytes.fraction();
  const double scale = bytes.factor(6.0);
  const int extras = bytes.byte();
  in.turned = extras % 2 == 1;
  in.dear = extras >= 240;
  in.published = extras == 255;
  for (brute::Torus* t : {&in.a, &in.b}) {
    t->R *= scale;
    t->r0 *= scale;
    t->r1 *= scale;
    t->center *= scale;
  }
  return in;
}

std::string describe(const PairInput& in)
{
  std::string text;
  for (const brute::Torus* t : {&in.a, &in.b}) {
    const Eigen::AngleAxisd turn(t->axes);
    text += fmt::format(
        "  R {:.17g}, r0 {:.17g}, r1 {:.17g} at ({:.17g}, {:.17g}, {:.17g}), turned by {:.17g} about "
        "({:.17g}, {:.17g}, {:.17g})\n",
        t->R, t->r0, t->r1, t->center.x(), t->center.y(), t->center.z(), turn.angle(), turn.axis().x(),
        turn.axis().y(), turn.axis().z());
  }
  text += fmt::format("  clearance {:.17g}, step", in.clearance);
  for (const double x : in.step) text += fmt::format(" {:.17g}", x);
  return text;
}

}  // namespace hauberk::fuzz
