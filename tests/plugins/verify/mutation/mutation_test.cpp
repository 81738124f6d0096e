/// Every field of what the program writes is caught when it is changed, or listed as not checked.

#include "mutations.hpp"
#include "program.hpp"
#include "stored.hpp"

#include <hauberk/verify/verify.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <boost/json/object.hpp>

#include <cstdlib>

namespace hauberk::test {
namespace {

/// Of every pattern; HAUBERK_MUTATIONS sets another number, for a complete count.
std::size_t fields_per_pattern()
{
  constexpr std::size_t few = 1;
  const char* given = std::getenv("HAUBERK_MUTATIONS");
  return given != nullptr ? std::strtoul(given, nullptr, 10) : few;
}

struct Case {
  const char* name;
  std::vector<std::string> arguments;  ///< of `run`
};

std::string share(const char* file) { return std::string(HAUBERK_SOURCE_DIR "/share/experiments/") + file; }

std::vector<Case> cases()
{
  return {
      {"chain", {share("chain.json")}},
      {"fourfold",
       {share("fourfold_limits.json"), "--set", "/load_case/directions_deg=[20]", "--set", "/solver/starts=1",
        "--set", "/solver/neighbours=0", "--set", "/expect=[]"}},
      {"bent",
       {HAUBERK_SOURCE_DIR "/loadcases/paraboloid_bending/example.json", "--set",
        "/load_case/hold=[\"places\"]", "--set", "/load_case/directions_deg=[0]", "--set", "/expect=[]"}},
      // Forces of contact nearest balance more closely than those of arc, and at 10 degrees no reaction is
      // zero by symmetry, so that a thousandth of one counts.
      {"rolled",
       {HAUBERK_SOURCE_DIR "/loadcases/cylinder_roll/example.json", "--set",
        "/load_case/hold=[\"places\", \"twist\", \"transverse\"]", "--set", "/load_case/directions_deg=[10]",
        "--set", "/solver/contact=\"nearest\"", "--set", "/expect=[]"}},
      {"rolled_free",
       {HAUBERK_SOURCE_DIR "/loadcases/cylinder_roll/example.json", "--set",
        "/load_case/out_of_plane=\"free\"", "--set", "/load_case/directions_deg=[0]", "--set", "/expect=[]"}},
      {"no_sheet", {HAUBERK_SOURCE_DIR "/tests/experiments/scenes/hairpin.json", "--set", "/expect=[]"}},
      {"tubes", {share("oval_links.json"), "--set", "/expect=[]"}},
      {"solid",
       {HAUBERK_SOURCE_DIR "/loadcases/volumetric_periodic/example.json", "--set",
        "/load_case/directions=[[1, 0, 0, 0, 0, 0]]", "--set", "/expect=[]"}},
      {"struts", {HAUBERK_SOURCE_DIR "/shapes/strut_frame/example.json", "--set", "/expect=[]"}},
      // A design that is short: one variable, one target, one step.
      {"design",
       {share("chain.json"), "--set", "/expect=[]", "--set", "/task=design", "--set",
        "/load_case={\"plugin\": \"in_plane_periodic\", \"directions_deg\": [0], \"senses\": [\"stretch\"]}",
        "--set",
        "/design={\"quantity\": \"stretch\", \"variables\": [{\"parameters\": \"ring.R\", \"per\": \"all\", "
        "\"lower\": 4, "
        "\"upper\": 6}], \"targets\": [{\"direction_deg\": 0, \"value\": 0.5}], \"max_iterations\": 1}"}},
  };
}

void expect_nothing_missed(const std::string& name, const boost::json::value& results)
{
  const VerifyShapes shapes = stored_shapes();
  const VerifyReport whole = verify(results, {}, shapes);
  ASSERT_TRUE(whole.ok) << whole.text();
  const MutationCounts counts = mutate(results, fields_per_pattern(), shapes);
  fmt::print("{}: {} fields, {} changed, {} caught, {} listed, {} missed\n", name, counts.fields,
             counts.tried, counts.caught, counts.listed, counts.missed.size());
  EXPECT_TRUE(counts.missed.empty()) << fmt::format("{}", fmt::join(counts.missed, "\n"));
  EXPECT_TRUE(counts.pretended.empty()) << fmt::format("{}", fmt::join(counts.pretended, "\n"));
  EXPECT_GT(counts.caught, counts.tried / 4) << "more is listed than a reader would expect";
}

class Mutation : public ::testing::TestWithParam<Case> {};

TEST_P(Mutation, IsCaughtOrListed)
{
  const WorkFolder folder;
  std::vector<std::string> words{"run"};
  words.insert(words.end(), GetParam().arguments.begin(), GetParam().arguments.end());
  words.insert(words.end(), {"-o", folder / "out"});
  const Outcome run = run_program(words);
  ASSERT_EQ(run.code, 0) << run.err;
  expect_nothing_missed(GetParam().name, read_results(folder / "out"));
}

INSTANTIATE_TEST_SUITE_P(Results, Mutation, ::testing::ValuesIn(cases()),
                         [](const auto& info) { return std::string(info.param.name); });

/// Experiments that are texts of the tests.
void mutate_text(const std::string& name, const std::string& text, int code = 0)
{
  const WorkFolder folder;
  const Outcome run = run_program(
      {"run", folder.write("e.json", text), "-o", folder / "out", "--plugin-path", HAUBERK_SOLID_SHAPES});
  ASSERT_EQ(run.code, code) << run.err;
  expect_nothing_missed(name, read_results(folder / "out"));
}

TEST(MutationOfElements, Union) { mutate_text("union", union_text()); }
TEST(MutationOfSolids, OfTheKit) { mutate_text("rings", solid_chain_text()); }
TEST(MutationOfTables, Sweep) { mutate_text("sweep", sweep_text()); }
TEST(MutationOfTables, Chart) { mutate_text("chart", chart_text()); }
TEST(MutationOfTables, Stability) { mutate_text("stability", map_text()); }

}  // namespace
}  // namespace hauberk::test
