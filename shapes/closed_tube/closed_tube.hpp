#pragma once
/// A tube of constant radius around a closed curve whose Fourier coefficients are linear in the parameters.

#include <hauberk/section.hpp>
#include <hauberk/shape.hpp>

#include <memory>
#include <span>
#include <vector>

namespace hauberk {

/// One term of the core: coefficient `weight` times parameter `parameter` in component `axis` of harmonic k.
struct CurveTerm {
  int k = 1;          ///< 1, 2, ...
  bool sine = false;  ///< of sin k u, else of cos k u
  int axis = 0;       ///< 0, 1, 2
  std::size_t parameter = 0;
  double weight = 1.0;
};

/// x(u) = sum of the terms. The last parameter is the tube's radius.
class ClosedTube final : public Shape {
 public:
  ClosedTube(std::vector<ParameterInfo> parameters, std::vector<CurveTerm> terms);

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  /// Throws InputError naming the radius where the tube is too thick for its curve: where that bends more
  /// tightly, or comes back to itself closer than the tube is thick.
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override;
  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override;

 private:
  std::vector<ParameterInfo> parameters_;
  std::vector<CurveTerm> terms_;
  std::size_t harmonics_ = 1;
};

/// The fields of the shape's section of an experiment.
void closed_tube_fields(std::vector<Field>& out);

/// Builds the shape from a section checked against these fields.
std::unique_ptr<Shape> make_closed_tube(const Node& section, Problems& problems);

}  // namespace hauberk
