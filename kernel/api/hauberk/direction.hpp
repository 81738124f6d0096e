#pragma once
/// A direction of loading.

#include <array>
#include <compare>
#include <cstddef>
#include <span>
#include <string>

namespace hauberk {

/// Most macroscopic unknowns a load case may declare (six strains).
inline constexpr int max_macro = 6;

/// Where a load pulls: along an angle in the plane of the sheet, or along any direction of the macroscopic
/// unknowns, given by its components. An angle has two senses (stretch and compress); components have one,
/// further along them, and their length does not matter. A value: nothing is owned, copies are independent.
class Direction {
 public:
  /// The angle 0.
  Direction() = default;
  /// An angle as files give it; it is kept, so that it can be written again.
  static Direction at_degrees(double degrees);
  /// An angle as load cases take it.
  static Direction at_radians(double theta);
  /// Components in the order of the load case's unknowns. Throws InputError unless there are 1 to max_macro
  /// of them, all finite and not all zero.
  static Direction along(std::span<const double> components);

  bool is_angle() const { return count_ == 0; }
  /// The angle; 0 for components.
  double degrees() const { return degrees_; }
  double theta() const { return theta_; }
  /// The components as given; empty for an angle.
  std::span<const double> components() const { return {components_.data(), count_}; }
  /// For people: "30 degrees", or "(0.5, 0.5, 0)" with six digits.
  std::string text() const;

  friend auto operator<=>(const Direction&, const Direction&) = default;

 private:
  double degrees_ = 0.0, theta_ = 0.0;
  std::array<double, max_macro> components_{};
  std::size_t count_ = 0;
};

/// A limit in words: "stretch at 30 degrees", "along (1, 0, 0)".
std::string limit_name(const std::string& sense, const Direction& direction);

}  // namespace hauberk
