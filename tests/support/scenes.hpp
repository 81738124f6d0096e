#pragma once
/// Small scenes for tests, built without any plugin or file.

#include "model/model.hpp"

#include <memory>
#include <random>

namespace hauberk::test {

/// One torus (R, r0, r1) at the origin about z, or a list of tori sharing nothing.
class Rings final : public Shape {
 public:
  struct Ring {
    Vec3 position = Vec3::Zero();
    Mat3 rotation = Mat3::Identity();
  };
  Rings() : Rings(std::vector<Ring>(1)) {}
  explicit Rings(std::vector<Ring> rings);

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override;
  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override;

 private:
  std::vector<Ring> rings_;
  std::vector<ParameterInfo> parameters_;
};

/// Periodic sheet: exx, eyy, exy; x = F (X + T) + u; `coordinates` 2 (z fixed) or 3.
class Sheet : public LoadCase {
 public:
  explicit Sheet(int coordinates = 2) : coordinates_(coordinates) {}

 protected:
  const std::vector<MacroInfo>& do_macros() const override;
  int do_coordinate_count() const override { return coordinates_; }
  int do_lattice_vectors() const override { return 2; }
  void do_position(std::span<const double> macro, std::span<const double> e, const Vec3& X, const Vec3& T,
                   PositionMap& out) const override;
  bool do_admissible(std::span<const double> macro) const override;
  std::pair<double, double> do_stretch_range(std::span<const double> macro) const override;
  void do_load(double theta, std::span<double> t) const override;
  double do_value(double theta, std::span<const double> macro) const override;
  std::string do_measure() const override { return "tensor"; }
  int do_value_length_power() const override { return 0; }
  std::pair<std::string, std::string> do_sense_names() const override { return {"stretch", "compress"}; }
  void do_metric(std::span<double> m) const override;
  bool do_transform(const Mat3& O, std::span<const double> macro, std::span<double> out) const override;
  Boundedness do_boundedness(std::span<const double>, std::span<const Vec3>) const override
  {
    return Boundedness::attained;
  }

 private:
  int coordinates_;
};

/// Two rings (R, r0, r1) linked into a chain along x with the given period; the second turned by 90 degrees.
SceneSpec chain(std::array<double, 3> first, std::array<double, 3> second, double period);

/// Published 4-in-1 chainmail (R 4.9, r 1.15, tilt 36.5 degrees), m x n of its two-ring cell.
SceneSpec chainmail(int m, int n, double tilt_degrees = 36.5, double r1 = 1.15);

/// Threefold element with round tubes, one per cell: a centre ring (R 4.25) about z and three side rings
/// (R 2.575) at azimuths -90, 30 and 150 degrees, distance 6.825, whose planes hold the radial direction and
/// z; all tubes r 0.95; lattice spacing 11.075. Each side ring links with the centre ring of a neighbour.
/// Parameters: R, r0, r1 of the centre, then of the sides (positions do not follow the radii).
SceneSpec threefold_round();
inline constexpr double threefold_spacing = 11.075;

/// The scene with all lengths multiplied by `factor` and turned by `angle` (radians) about z.
SceneSpec scaled_and_turned(const SceneSpec& scene, double factor, double angle);

/// Rotation with uniform axis and angle up to `largest`.
Mat3 random_rotation(std::mt19937_64& rng, double largest = std::numbers::pi);

}  // namespace hauberk::test
