/// Limits of elements whose parts are turned by parameters, and their derivatives, in closed form.

#include "limits/limits.hpp"
#include "scenes.hpp"
#include "turned.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hauberk::test {
namespace {

constexpr double R = 3.0, r = 0.5, arm = 4.0, bend = 0.7;

Primitive ring(const char* name, double at)
{
  Primitive out;
  out.name = name;
  out.position = Vec3(at, 0, 0);
  out.size = {R, r, r};
  return out;
}

/// Two rings in one plane, the arms from the element's origin to their centres bent by the angle `bend`, in
/// an element whose frame is turned by `frame`; and upright rings that join it to its images. Rings are 0.5
/// less far apart than they can be.
struct BentLinks {
  explicit BentLinks(const Mat3& frame)
      : of_left(rotation_log(frame)), of_right(rotation_log(frame * rotation_exp({0, 0, bend})))
  {
    const double c = std::cos(0.5 * bend), s = std::sin(0.5 * bend);
    period = 2.0 * arm * c + 2.0 * (2.0 * R - 2.0 * r - 0.5);
    scene.types = {{"bent", std::make_shared<Turned>(std::vector{ring("left", -arm), ring("right", arm)})},
                   {"ring", std::make_shared<Rings>()}};
    std::vector<double> w(of_left.begin(), of_left.end());
    w.insert(w.end(), of_right.begin(), of_right.end());
    const Mat3 level = rotation_exp({0, 0, -0.5 * bend}) * frame.transpose();
    scene.elements.push_back({0, w, {Vec3(0, -arm * s, 0), level}});
    scene.elements.push_back(
        {1, {R, r, r}, {Vec3(0.5 * period, 0, 0), rotation_exp({0.5 * std::numbers::pi, 0, 0})}});
    scene.lattice = {Vec3(period, 0, 0), Vec3(0, 200, 0)};
    scene.length = R;
  }
  /// The chain is taut where all centres are on a line: the centres of linked rings are 2 R - 2 r apart,
  /// those of both rings of an element 2 arm cos(bend/2).
  double limit() const { return (2.0 * arm * std::cos(0.5 * bend) + 4.0 * (R - r)) / period - 1.0; }
  double slope() const { return -arm * std::sin(0.5 * bend) / period; }

  Vec3 of_left, of_right;  ///< parameters
  double period = 0.0;
  SceneSpec scene;
};

class TurnedParts : public ::testing::TestWithParam<ContactChoice> {};

TEST_P(TurnedParts, LimitAndItsDerivativesAreThoseOfTheAngle)
{
  for (const Vec3& turn : {Vec3(0, 0, 0), Vec3(0.3, -0.4, 0.5)}) {
    const Mat3 frame = rotation_exp(turn);
    const BentLinks links(frame);
    const Sheet load(3);
    const Model model = make_model(links.scene, load, 0.0);
    LimitSettings settings;
    settings.contact = GetParam();
    const LimitResult found =
        compute_limits(model, links.scene, {{Direction::at_degrees(0.0), Sense::positive}}, settings, 1)[0];
    ASSERT_EQ(found.status, LimitStatus::locked) << found.message;
    EXPECT_NEAR(*found.value, links.limit(), 1e-8);
    // In turns of the parts by small rotations in the element frame: dw = J^-1 omega.
    ASSERT_EQ(found.sensitivity_parameters.size(), 9U);
    Vec3 left, right;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      EXPECT_EQ(found.sensitivity_parameters[k].first, std::string("0/left.w") + "xyz"[k]);
      left[i] = found.sensitivity_parameters[k].second;
      right[i] = found.sensitivity_parameters[3 + k].second;
    }
    left = rotation_exp_jacobian(links.of_left).transpose().inverse() * left;
    right = rotation_exp_jacobian(links.of_right).transpose().inverse() * right;
    // A turn of both is none, as the element is free to turn; that of one about the common normal is the
    // angle's, and those about other axes keep the distance of the centres to first order.
    EXPECT_LT((left + right).norm(), 2e-6);
    EXPECT_LT((right - links.slope() * frame.col(2)).norm(), 2e-6);
    EXPECT_GT(std::abs(links.slope()), 0.05);
  }
}

INSTANTIATE_TEST_SUITE_P(Contacts, TurnedParts,
                         ::testing::Values(ContactChoice::nearest, ContactChoice::constrained),
                         [](const auto& info) {
                           return info.param == ContactChoice::nearest ? "nearest" : "constrained";
                         });

}  // namespace
}  // namespace hauberk::test
