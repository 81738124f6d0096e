#include "results/document.hpp"

#include "document/json_text.hpp"
#include "results/csv.hpp"
#include "results/designed_experiment.hpp"
#include "sample_run.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>
#include <boost/json/value.hpp>

#include <cmath>
#include <numbers>

namespace hauberk {
namespace {

namespace json = boost::json;

json::value sample_document(const RunResult& run)
{
  return results_document(run, test::sample_experiment(), {"exx", "eyy", "exy"});
}

TEST(Document, HasTheKeysOfTheContractInOrder)
{
  const json::value document = sample_document(test::sample_run());
  std::string keys;
  for (const auto& [key, value] : document.as_object()) keys += std::string(key) + ' ';
  EXPECT_EQ(keys, "format experiment provenance plan scene limits profiles design files ");
  EXPECT_EQ(document.at("format").as_string(), "hauberk-results/2");
  keys.clear();
  for (const auto& [key, value] : document.at_pointer("/limits/0").as_object())
    keys += std::string(key) + ' ';
  EXPECT_EQ(
      keys,
      "load_case direction_deg sense measure value line_stretch macro status message infimum iterations "
      "evaluations seconds min_gap error_estimate links_kept z_range contact certificate starts better_state "
      "confidence sensitivity kink poses contacts force_balance hold reactions ");
}

TEST(Document, SceneHasPrimitivesAndUnitQuaternions)
{
  const json::value document = sample_document(test::sample_run());
  EXPECT_EQ(document.at_pointer("/scene/cell_vectors"), json::value({{12.0, 0.0}, {0.0, 100.0}}));
  EXPECT_EQ(document.at_pointer("/scene/length").as_double(), 4.5);
  const json::value& second = document.at_pointer("/scene/elements/1");
  EXPECT_EQ(second.at_pointer("/primitives/0/kind").as_string(), "circle_tube");
  EXPECT_EQ(second.at_pointer("/primitives/0/parameters/r0").as_double(), 0.6);
  EXPECT_EQ(second.at_pointer("/parameters/ring.R").as_double(), 4.0);
  const json::array& q = second.at_pointer("/rest/quaternion").as_array();
  EXPECT_NEAR(q[0].as_double(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(q[1].as_double(), std::sqrt(0.5), 1e-15);
  EXPECT_EQ(q[2].as_double(), 0.0);
}

TEST(Document, QuaternionsHaveNonNegativeW)
{
  RunResult run = test::sample_run();
  for (const double degrees : {190.0, 350.0, 180.0, -180.0, 0.0}) {
    run.limits[0].poses[0].rotation = rotation_exp({0.0, 0.0, degrees * degree});
    const json::value document = sample_document(run);
    const json::array& q = document.at_pointer("/limits/0/poses/0/quaternion").as_array();
    double norm = 0.0;
    for (const json::value& c : q) norm += c.as_double() * c.as_double();
    EXPECT_GE(q[0].as_double(), 0.0);
    EXPECT_NEAR(norm, 1.0, 1e-15);
    EXPECT_NEAR(2.0 * std::atan2(std::abs(q[3].as_double()), q[0].as_double()),
                std::abs(std::remainder(degrees * degree, 2.0 * std::numbers::pi)), 1e-12);
  }
}

TEST(Document, AbsentAndNotFiniteAreNull)
{
  RunResult run = test::sample_run();
  run.limits[0].value.reset();
  run.limits[0].min_gap = std::nan("");
  run.limits[0].macro.clear();
  const json::value document = sample_document(run);
  EXPECT_TRUE(document.at_pointer("/limits/0/value").is_null());
  EXPECT_TRUE(document.at_pointer("/limits/0/min_gap").is_null());
  EXPECT_TRUE(document.at_pointer("/limits/0/macro").is_null());
  EXPECT_TRUE(document.at_pointer("/limits/0/error_estimate").is_null());
  EXPECT_TRUE(document.at("plan").is_null());
  EXPECT_TRUE(document.at("design").is_null());
  EXPECT_EQ(document.at_pointer("/limits/0/starts/0/macro/eyy").as_double(), 0.1);
}

TEST(Document, ExperimentNumbersAreNotTouched)
{
  const json::value document = sample_document(test::sample_run());
  EXPECT_EQ(document.at_pointer("/experiment/load_case/step").as_double(), 12.323883579598581);
  EXPECT_NE(write_json(document).find("12.323883579598581"), std::string::npos);
  EXPECT_NE(write_json(document).find("12345678901234567890"), std::string::npos);
}

TEST(Document, DesignCarriesItsStart)
{
  const json::value document = sample_document(test::sample_design());
  EXPECT_EQ(document.at_pointer("/design/variables/0/final").as_double(), 5.25);
  EXPECT_EQ(document.at_pointer("/design/targets").as_array().size(), 6u);
  EXPECT_TRUE(document.at_pointer("/design/targets/0/recomputed").is_null());
  EXPECT_EQ(document.at_pointer("/design/initial/limits").as_array().size(), 24u);
  EXPECT_EQ(document.at_pointer("/design/initial/scene/elements").as_array().size(), 2u);
}

TEST(Csv, OneRowPerLimitWithExactNumbers)
{
  RunResult run = test::sample_run();
  run.limits.resize(2);
  run.limits[1].value.reset();
  run.limits[1].companions.clear();
  run.limits[1].macro[0].second = 1.0 / 3.0;
  run.limits[1].load_case = "a,\"b\"";
  EXPECT_EQ(
      limits_csv(run.limits, {"exx", "eyy", "exy"}),
      "load_case,direction_deg,sense,measure,value,line_stretch,exx,eyy,exy,status,iterations,evaluations,"
      "min_gap,error_estimate,links_kept,z_range,better_state,confidence,force_balance,starts,"
      "contacts\n"
      "in_plane_periodic,0,stretch,tensor,0.16,0.16,0.16,0.1,0,locked,0,0,1e-09,,true,0,false,none,,1,1\n"
      "\"a,\"\"b\"\"\",0,compress,tensor,,,0.3333333333333333,0.1,0,locked,0,0,1e-09,,true,0,false,none,,1,"
      "1\n");
}

TEST(Csv, HasAllColumnsWhereNoLimitHasAState)
{
  RunResult run = test::sample_run();
  run.limits.resize(1);
  LimitResult& limit = run.limits[0];
  limit = {};
  limit.load_case = "in_plane_periodic";
  limit.status = LimitStatus::unbounded;
  limit.companions = {{"line_stretch", std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_EQ(
      limits_csv(run.limits, {"exx", "eyy", "exy"}),
      "load_case,direction_deg,sense,measure,value,line_stretch,exx,eyy,exy,status,iterations,evaluations,"
      "min_gap,error_estimate,links_kept,z_range,better_state,confidence,force_balance,starts,"
      "contacts\n"
      "in_plane_periodic,0,,,,,,,,unbounded,0,0,,,false,0,false,none,,0,0\n");
}

TEST(DesignedExperiment, DescribesTheFinalSceneAlone)
{
  const RunResult run = test::sample_design();
  const json::value out = designed_experiment(test::sample_experiment(), run.scene);
  EXPECT_EQ(out.at("name").as_string(), "chain_designed");
  EXPECT_EQ(out.at("task").as_string(), "limits");
  EXPECT_EQ(out.as_object().count("design") + out.as_object().count("expect"), 0u);
  EXPECT_EQ(out.at_pointer("/cell/vectors"), json::value({{12.0, 0.0}, {0.0, 100.0}}));
  EXPECT_EQ(out.at_pointer("/cell/repeat"), json::value({1, 1}));
  EXPECT_EQ(out.at("elements").as_object().size(), 2u);
  EXPECT_EQ(out.at_pointer("/elements/link_1/parameters/ring.R").as_double(), 4.0);
  EXPECT_EQ(out.at_pointer("/elements/link_0/parameters/ring.r").as_double(), 0.7);
  EXPECT_EQ(out.at_pointer("/elements/link_1/shape").as_string(), "torus_union");
  EXPECT_EQ(out.at_pointer("/cell/place/1/element").as_string(), "link_1");
  EXPECT_EQ(out.at_pointer("/cell/place/1/position"), json::value({6.0, 0.0, 0.0}));
  EXPECT_NEAR(out.at_pointer("/cell/place/1/rotation/degrees").as_double(), 90.0, 1e-12);
  EXPECT_NEAR(out.at_pointer("/cell/place/1/rotation/axis/0").as_double(), 1.0, 1e-15);
}

/// Equal elements have one entry; the name of a type that another type's elements would get stays its own.
TEST(DesignedExperiment, EqualElementsHaveOneEntry)
{
  SceneSpec scene = test::sample_run().scene;
  scene.types.push_back(scene.types[0]);
  scene.types[1].name = "link_0";
  PlacedElement other = scene.elements[0];
  other.type = 1;
  PlacedElement wide = scene.elements[0];
  wide.parameters[0] *= 1.5;
  scene.elements = {scene.elements[0], other, scene.elements[0], wide, other};
  json::object sample = parse_json(test::sample_experiment(), "sample").as_object();
  sample["elements"].as_object()["link_0"] = sample["elements"].at("link");
  const json::value out = designed_experiment(write_json(sample), scene);
  std::vector<std::string> placed;
  for (const json::value& one : out.at_pointer("/cell/place").as_array())
    placed.emplace_back(one.at("element").as_string());
  EXPECT_EQ(placed, (std::vector<std::string>{"link_0_", "link_0", "link_0_", "link_3", "link_0"}));
  EXPECT_EQ(out.at("elements").as_object().size(), 3U);
  EXPECT_EQ(out.at_pointer("/elements/link_3/parameters/ring.R").as_double(), wide.parameters[0]);
  EXPECT_EQ(out.at_pointer("/elements/link_0_/parameters/ring.R").as_double(), other.parameters[0]);
}

TEST(DesignedExperiment, APatchIsOneCellWithEveryElement)
{
  SceneSpec scene = test::sample_run().scene;
  scene.lattice.clear();
  json::object patched = parse_json(test::sample_experiment(), "sample").as_object();
  patched["cell"] = {
      {"patch", {{"vectors", {{12, 0}, {0, 100}}}, {"outline", {{"hexagon", 2}}}, {"tile", {2, 2}}}},
      {"place", json::array{}}};
  const json::value out = designed_experiment(write_json(patched), scene);
  EXPECT_EQ(out.at_pointer("/cell/patch/outline"), (json::value{{"rectangle", {1, 1}}}));
  EXPECT_EQ(out.at_pointer("/cell/patch/tile"), (json::value{1, 1}));
  EXPECT_FALSE(out.at("cell").as_object().contains("vectors"));
  EXPECT_EQ(out.at_pointer("/cell/place").as_array().size(), scene.elements.size());
}

}  // namespace
}  // namespace hauberk
