/// Scenes with sparse Hessians have the limits of small ones.

#include "program.hpp"

#include <gtest/gtest.h>
#include <boost/json/value.hpp>

namespace hauberk::test {
namespace {

/// 64 rings in one cell lock at the period of two.
TEST(ManyElements, ChainOf64)
{
  const WorkFolder folder;
  const std::string file =
      folder.write("c.json", with(chain_text(), "\"place\": [", "\"repeat\": [32, 1], \"place\": ["));
  const Outcome plan = run_program({"plan", file});
  EXPECT_NE(plan.out.find("sparse L D L^T"), std::string::npos) << plan.out;
  const Outcome o = run_program({"run", file, "-o", folder / "out"});  // expects the limit to 1e-8
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(run_program({"verify", folder / "out/results.json"}).code, 0);
  EXPECT_EQ(run_program({"plan", folder.write("s.json", chain_text())}).out.find("sparse"),
            std::string::npos);
}

/// A bent patch, whose place is held by conditions that couple all rings: forces balance and conditions hold
/// by the independent check, and the limit is that of the dense method.
TEST(ManyElements, BentPatchOf54)
{
  const WorkFolder folder;
  const std::vector<std::string> patch{HAUBERK_SOURCE_DIR "/share/experiments/speed/bending.json", "--set",
                                       "/cell/patch/outline={\"rectangle\": [3, 9]}", "--set",
                                       "/solver/clearance=0.05"};
  const auto with_patch = [&patch](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin() + 1, patch.begin(), patch.end());
    return arguments;
  };
  const Outcome o = run_program(with_patch({"run", "-o", folder / "out"}));
  ASSERT_EQ(o.code, 0) << o.err;
  const boost::json::value results = read_results(folder / "out");
  EXPECT_EQ(results.at_pointer("/plan/linear_solver").as_string(),
            "sparse L D L^T (multifrontal, ordered by CHOLMOD)");
  constexpr double dense = 0.1859225935452;
  EXPECT_NEAR(number_at(results, "/limits/0/value"), dense, 1e-9);
  EXPECT_EQ(run_program({"verify", folder / "out/results.json"}).code, 0);
}

}  // namespace
}  // namespace hauberk::test
