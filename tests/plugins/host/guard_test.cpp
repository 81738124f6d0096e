#include "support.hpp"

#include <hauberk/error.hpp>
#include <hauberk/host/guard.hpp>

#include <cfenv>
#include <memory>
#include <stdexcept>

namespace hauberk::test {
namespace {

const Guard guard("sqp");

/// Restores the mode even when an assertion ends the test.
struct ModeRestorer {
  FloatingPointMode before = floating_point_mode();
  ~ModeRestorer() { set_floating_point_mode(before); }
};

TEST(Guard, ResultsComeThrough)
{
  int value = 7;
  EXPECT_EQ(guard("f", [] { return 3; }), 3);
  EXPECT_EQ(&guard("f", [&]() -> int& { return value; }), &value);
  EXPECT_EQ(*guard("f", [] { return std::make_unique<int>(5); }), 5);
  guard("f", [&] { value = 8; });
  EXPECT_EQ(value, 8);
}

TEST(Guard, ForeignExceptionsGetAName)
{
  EXPECT_EQ(message_of<PluginError>([] { guard("minimize", []() -> int { throw std::logic_error("no"); }); }),
            "plugin 'sqp': minimize failed: no");
  EXPECT_EQ(message_of<PluginError>([] { guard("minimize", [] { throw 42; }); }),
            "plugin 'sqp': minimize failed: it threw something that is no std::exception");
  EXPECT_EQ(message_of<PluginError>([] { guard("minimize", [] { throw PluginError("wrong size"); }); }),
            "plugin 'sqp': minimize failed: wrong size");
}

TEST(Guard, OwnErrorsPassThrough)
{
  EXPECT_EQ(message_of<InputError>([] { guard("f", [] { throw InputError("bad"); }); }), "bad");
  EXPECT_EQ(message_of<ComputationError>([] { guard("f", [] { throw ComputationError("stuck"); }); }),
            "stuck");
}

TEST(Guard, ChangedRoundingIsReportedAndUndone)
{
  const ModeRestorer restorer;
  EXPECT_EQ(
      message_of<PluginError>([] {
        guard("primitives", [] {
          std::fesetround(FE_DOWNWARD);
          return 1;
        });
      }),
      "plugin 'sqp': primitives changed the floating-point mode (rounding); it was restored, but what the "
      "call computed cannot be used");
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
  EXPECT_EQ(floating_point_mode(), restorer.before);
}

TEST(Guard, ModeIsRestoredAfterAnException)
{
  const ModeRestorer restorer;
  EXPECT_EQ(message_of<PluginError>([] {
              guard("f", [] {
                std::fesetround(FE_UPWARD);
                throw std::runtime_error("no");
              });
            }),
            "plugin 'sqp': f failed: no");
  EXPECT_EQ(floating_point_mode(), restorer.before);
}

TEST(Guard, ModeOfTheCallerIsKept)
{
  // What is restored is the mode at the call, not the default.
  const ModeRestorer restorer;
  std::fesetround(FE_UPWARD);
  EXPECT_NO_THROW(guard("f", [] { return 0; }));
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
}

TEST(Guard, StatusFlagsAreNoChange)
{
  std::feclearexcept(FE_ALL_EXCEPT);
  EXPECT_NO_THROW(guard("f", [] {
    volatile double zero = 0.0;
    volatile double infinite = 1.0 / zero;
    (void)infinite;
  }));
  EXPECT_TRUE(std::fetestexcept(FE_DIVBYZERO));
}

TEST(FloatingPoint, ChangesAreNamed)
{
#if defined(__x86_64__)
  const FloatingPointMode normal{0x1f80, 0x37f};
  EXPECT_EQ(describe_change(normal, normal), "");
  EXPECT_EQ(describe_change(normal, {0x9f80, 0x37f}), "flush-to-zero");
  EXPECT_EQ(describe_change(normal, {0x1fc0, 0x37f}), "flush-to-zero");  // denormals are zero
  EXPECT_EQ(describe_change(normal, {0x3f80, 0x37f}), "rounding");
  EXPECT_EQ(describe_change(normal, {0x1f80, 0x27f}), "rounding");  // x87 precision
  EXPECT_EQ(describe_change(normal, {0x1f00, 0x37f}), "trapped exceptions");
  EXPECT_EQ(describe_change(normal, {0xff00, 0x37f}), "flush-to-zero, rounding, trapped exceptions");
#endif
}

}  // namespace
}  // namespace hauberk::test
