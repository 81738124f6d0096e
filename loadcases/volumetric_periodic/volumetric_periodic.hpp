#pragma once
/// A solid that repeats along three lattice vectors, under the six strains.

#include <hauberk/load_case.hpp>

#include <vector>

namespace hauberk {

/// x = F (X + T) + e, F = I + [[exx, exy, exz], [exy, eyy, eyz], [exz, eyz, ezz]]; unknowns in the order exx,
/// eyy, ezz, eyz, exz, exy. An angle theta pulls along (cos theta, sin theta, 0); its value is n . eps n.
class VolumetricPeriodic final : public LoadCase {
 public:
  VolumetricPeriodic();

 protected:
  const std::vector<MacroInfo>& do_macros() const override { return macros_; }
  int do_coordinate_count() const override { return 3; }
  int do_lattice_vectors() const override { return 3; }
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
  Boundedness do_boundedness(std::span<const double> load, std::span<const Vec3> cycles) const override;

 private:
  std::vector<MacroInfo> macros_;
};

}  // namespace hauberk
