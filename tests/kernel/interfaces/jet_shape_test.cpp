/// Shapes from one template over the number type.

#include <hauberk/error.hpp>
#include <hauberk/kit/jet_shape.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace hauberk::test {
namespace {

/// A tube around an ellipse of half axes a and a b, its middle at (a^2, sqrt(b), 0), beside a ring.
struct Oval {
  enum { a, b, parameter_count };
  double radius;

  static std::vector<ParameterInfo> parameters()
  {
    return {{"a", "length", 2.0, 0.1, 10.0, "half axis"}, {"b", "1", 1.0, 0.1, 10.0, "ratio of the axes"}};
  }
  static void check(const double* p)
  {
    if (p[b] > p[a]) throw InputError("'b' is too large");
  }
  template <class S>
  void primitives(const S* p, std::vector<kit::Piece<S>>& out) const
  {
    using std::sqrt;
    kit::Piece<S> tube;
    tube.name = "tube";
    tube.kind = PrimitiveKind::curve_tube;
    tube.position = {square(p[a]), sqrt(p[b]), S(0.0)};
    tube.size = {S(1.0), S(radius), S(radius)};
    tube.curve = {{p[a], S(0.0), S(0.0), S(0.0), p[a] * p[b], S(0.0)}};
    out.push_back(tube);
    kit::Piece<S> ring;
    ring.name = "ring";
    ring.kind = PrimitiveKind::revolved_ellipse;
    ring.size = {p[a], 0.5 * p[b], 0.25 / p[b]};
    out.push_back(ring);
  }
  static double square(double x) { return x * x; }
  template <class S>
  static S square(const S& x)
  {
    return x * x;
  }
};

TEST(JetShape, HasValuesAndExactDerivativesOfOneTemplate)
{
  const kit::JetShape<Oval> shape(Oval{0.125});
  const std::vector<double> p{3.0, 0.25};
  const std::vector<Primitive> made = shape.primitives(p);
  ASSERT_EQ(made.size(), 2U);
  EXPECT_EQ(made[0].name, "tube");
  EXPECT_EQ(made[0].kind, PrimitiveKind::curve_tube);
  EXPECT_EQ(made[0].position, Vec3(9.0, 0.5, 0.0));
  EXPECT_EQ(made[0].r0(), 0.125);  // R is the kernel's: the curve's mean radius
  ASSERT_EQ(made[0].curve.size(), 1U);
  EXPECT_EQ(made[0].curve[0].c, Vec3(3.0, 0.0, 0.0));
  EXPECT_EQ(made[0].curve[0].s, Vec3(0.0, 0.75, 0.0));
  EXPECT_EQ(made[1].size, (std::array{3.0, 0.125, 1.0}));

  const std::vector<PrimitiveJacobian> J = shape.jacobians(p);
  const PrimitiveJacobian tube{6.0, 0.0, 0.0,  1.0, 0.0, 0.0,   // position
                               0.0, 0.0, 0.0,  0.0, 0.0, 0.0,   // size
                               1.0, 0.0, 0.0,  0.0, 0.0, 0.0,   // c
                               0.0, 0.0, 0.25, 3.0, 0.0, 0.0,   // s
                               0.0, 0.0, 0.0,  0.0, 0.0, 0.0};  // no turn
  const PrimitiveJacobian ring{0.0, 0.0, 0.0, 0.0, 0.0, 0.0,    // position
                               1.0, 0.0, 0.0, 0.5, 0.0, -4.0,   // size
                               0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(J[0], tube);
  EXPECT_EQ(J[1], ring);

  EXPECT_THROW(shape.primitives(std::vector<double>{1.0, 2.0}), InputError);
}

}  // namespace
}  // namespace hauberk::test
