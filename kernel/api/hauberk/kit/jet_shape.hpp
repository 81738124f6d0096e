#pragma once
/// A shape from one template over the number type: its primitives by numbers, their Jacobians by numbers that
/// carry derivatives.
///
///     struct FigureEight {
///       enum { R, r, waist, parameter_count };
///       static std::vector<ParameterInfo> parameters();  // parameter_count, in that order
///       static void check(const double* p);              // optional: throws InputError
///       template <class S>
///       void primitives(const S* p, std::vector<kit::Piece<S>>& out) const;
///     };
///
/// `kit::JetShape<FigureEight>` is the shape. S is double or a jet (hauberk/kit/jet.hpp), so the template
/// uses arithmetic, sqrt, hypot and square, found without std:: (using std::sqrt), and no branch on a value
/// of p that makes the primitives jump. Solids and triangle meshes have no pieces: theirs is
/// hauberk/kit/solid_shape.hpp, or a Shape as it is.

#include <hauberk/kit/jet.hpp>
#include <hauberk/shape.hpp>

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hauberk::kit {

/// A primitive whose position, size and curve are of the number type S (see Primitive).
template <class S>
struct Piece {
  std::string name;
  PrimitiveKind kind = PrimitiveKind::circle_tube;
  Mat3 rotation = Mat3::Identity();  ///< does not depend on parameters
  std::array<S, 3> position{};
  std::array<S, 3> size{};                ///< R, r0, r1
  std::vector<std::array<S, 6>> curve{};  ///< of a curve tube, for k = 1, 2, ...: c_k, then s_k
};

/// Immutable; thread safe where the author's calls are.
template <class Author>
class JetShape final : public Shape {
 public:
  explicit JetShape(Author author = {}) : author_(std::move(author)), parameters_(Author::parameters()) {}

 protected:
  static constexpr int count = Author::parameter_count;
  using J = Jet<double, count, 1>;

  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }

  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override
  {
    if constexpr (requires { author_.check(p.data()); }) author_.check(p.data());
    std::vector<Piece<double>> pieces;
    author_.template primitives<double>(p.data(), pieces);
    const auto vector = [](const auto& x, std::size_t at) { return Vec3(x[at], x[at + 1], x[at + 2]); };
    for (Piece<double>& piece : pieces) {
      Primitive primitive;
      primitive.name = std::move(piece.name);
      primitive.kind = piece.kind;
      primitive.position = vector(piece.position, 0);
      primitive.rotation = piece.rotation;
      primitive.size = piece.size;
      for (const auto& harmonic : piece.curve)
        primitive.curve.push_back({vector(harmonic, 0), vector(harmonic, 3)});
      out.push_back(std::move(primitive));
    }
  }

  /// Rows are position, size and the harmonics of the curve; columns are the parameters.
  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override
  {
    std::array<J, count> q;
    for (int k = 0; k < count; ++k) q[k] = J::variable(p[k], k);
    std::vector<Piece<J>> pieces;
    author_.template primitives<J>(q.data(), pieces);
    for (const Piece<J>& piece : pieces) {
      PrimitiveJacobian rows;
      const auto add = [&rows](const auto& numbers) {
        for (const J& number : numbers)
          for (int k = 0; k < count; ++k) rows.push_back(number.slope(k));
      };
      add(piece.position);
      add(piece.size);
      for (const auto& harmonic : piece.curve) add(harmonic);
      out.push_back(std::move(rows));
    }
  }

 private:
  Author author_;
  std::vector<ParameterInfo> parameters_;
};

}  // namespace hauberk::kit
