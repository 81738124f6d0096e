/// Results whose surfaces plugins alone know: what the check finds in them, and says where it cannot ask.

#include "document/json_text.hpp"
#include "program.hpp"
#include "stored.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <cmath>
#include <string>

namespace hauberk::test {
namespace {

namespace json = boost::json;

json::value results_of(const std::string& experiment, const std::vector<std::string>& more = {})
{
  const WorkFolder folder;
  std::vector<std::string> words{"run", experiment, "-o", folder / "out"};
  words.insert(words.end(), more.begin(), more.end());
  const Outcome run = run_program(words);
  EXPECT_EQ(run.code, 0) << run.err;
  return read_results(folder / "out");
}

json::value squares() { return results_of(HAUBERK_SOURCE_DIR "/shapes/strut_frame/example.json"); }

json::value solid_chain()
{
  const WorkFolder folder;
  return results_of(folder.write("chain.json", solid_chain_text()), {"--plugin-path", HAUBERK_SOLID_SHAPES});
}

Outcome verified(const json::value& results, const std::vector<std::string>& more = {})
{
  const WorkFolder folder;
  std::vector<std::string> words{"verify", folder.write("results.json", write_json(results))};
  words.insert(words.end(), more.begin(), more.end());
  return run_program(words);
}

void add(json::value& results, const std::string& pointer, double change)
{
  results.at_pointer(pointer) = number_at(results, pointer) + change;
}

/// Cages of the experiments: all that is claimed of them holds.
TEST(SolidResults, OfCagesPass)
{
  for (const char* name : {"tetrahedra", "cubes"}) {
    const json::value results =
        results_of(HAUBERK_SOURCE_DIR "/share/experiments/" + std::string(name) + ".json");
    const Outcome o = verified(results);
    EXPECT_EQ(o.code, 0) << o.out;
    EXPECT_TRUE(o.out.starts_with("PASS /limits/0 (0 deg, stretch): locked 0.")) << o.out;
    EXPECT_NE(o.out.find("\nPASS /scene: "), std::string::npos) << o.out;
    EXPECT_NE(o.out.find(" passed, 0 failed, "), std::string::npos) << o.out;
    EXPECT_EQ(o.out.find("surfaces of solids"), std::string::npos) << o.out;
  }
}

/// Both elements pushed into each other by 1e-5 of their size, so that the mean stays: the forces, which know
/// nothing of it, would not tell.
TEST(SolidResults, PushedIntoEachOtherFail)
{
  for (json::value results : {squares(), solid_chain()}) {
    const double push = 0.5e-5 * number_at(results, "/scene/length");
    add(results, "/limits/0/poses/0/position/0", -push);
    add(results, "/limits/0/poses/1/position/0", push);
    const std::string text = verify(results, {}, stored_shapes()).text();
    EXPECT_TRUE(text.starts_with("FAIL /limits/0 ")) << text;
    EXPECT_NE(text.find("closer than the clearance"), std::string::npos) << text;
    EXPECT_NE(text.find("off its surface"), std::string::npos) << text;
  }
}

TEST(SolidResults, WithALinkLostFail)
{
  json::value results = squares();
  add(results, "/limits/0/poses/0/position/2", 40.0);
  add(results, "/limits/0/poses/1/position/2", -40.0);
  const Outcome o = verified(results);
  EXPECT_EQ(o.code, 1) << o.out;
  EXPECT_NE(o.out.find("linking number of elements 0 and 1"), std::string::npos) << o.out;
}

TEST(SolidResults, OfAnotherSizeFail)
{
  json::value results = squares();
  add(results, "/scene/elements/0/primitives/2/parameters/h", 1e-6);
  const Outcome o = verified(results);
  EXPECT_EQ(o.code, 1) << o.out;
  EXPECT_NE(o.out.find("elements/0: primitives are not what its shape makes of its parameters"),
            std::string::npos)
      << o.out;
  json::value other = squares();
  other.at_pointer("/experiment/elements/square/polyhedron") = "cubes";
  const Outcome refused = verified(other);
  EXPECT_EQ(refused.code, 1) << refused.out;
  EXPECT_NE(refused.out.find("FAIL /experiment/elements/square: the shape 'strut_frame' does not take"),
            std::string::npos)
      << refused.out;
}

TEST(SolidResults, AreCheckedWhereTheirPluginIs)
{
  const json::value results = solid_chain();
  const Outcome there = verified(results, {"--plugin-path", HAUBERK_SOLID_SHAPES});
  EXPECT_EQ(there.code, 0) << there.out;
  EXPECT_TRUE(there.out.starts_with("PASS /limits/0 ")) << there.out;
  EXPECT_EQ(there.out.find("/limits/*/sensitivity"), std::string::npos)
      << "two contacts hold the chain: " << there.out;
  const Outcome gone = verified(results);
  EXPECT_EQ(gone.code, 0) << gone.out;
  EXPECT_TRUE(gone.out.starts_with("NONE /scene: ")) << gone.out;
  EXPECT_NE(gone.out.find("solid_rings"), std::string::npos) << gone.out;
  EXPECT_NE(gone.out.find("\nfields: "), std::string::npos) << gone.out;
}

}  // namespace
}  // namespace hauberk::test
