/// Scenes with sparse Hessians have the limits of small ones.

#include "program.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

/// 64 rings in one cell lock at the period of two.
TEST(ManyElements, ChainOf64)
{
  const TemporaryFolder folder;
  const std::string file =
      folder.write("c.json", with(chain_text(), "\"place\": [", "\"repeat\": [32, 1], \"place\": ["));
  const Outcome plan = run_program({"plan", file});
  EXPECT_NE(plan.out.find("sparse Cholesky"), std::string::npos) << plan.out;
  const Outcome o = run_program({"run", file, "-o", folder / "out"});  // expects the limit to 1e-8
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(run_program({"verify", folder / "out/results.json"}).code, 0);
  EXPECT_EQ(run_program({"plan", folder.write("s.json", chain_text())}).out.find("sparse"),
            std::string::npos);
}

}  // namespace
}  // namespace hauberk::test
