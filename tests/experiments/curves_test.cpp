/// Tubes around curves in experiments: sensitivities and designs against exact ones, the independent check,
/// symmetry of a fabric of knots, and what does not know them.

#include "document/json_text.hpp"
#include "program.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <boost/json/object.hpp>

#include <array>
#include <cmath>

namespace hauberk::test {
namespace {

namespace json = boost::json;

/// A chain of an oval link and a racetrack: its period locks at 2 (a1 + a2) - 2 (r1 + r2).
std::string links_text()
{
  return R"({
  "name": "links",
  "elements": {
    "oval": { "shape": "closed_tube", "curve": "oval",
              "parameters": { "half_length": 10, "half_width": 4, "r": 0.75 } },
    "track": { "shape": "closed_tube", "curve": "racetrack",
               "parameters": { "half_length": 9, "half_width": 4, "r": 0.7 } } },
  "cell": { "vectors": [[32, 0], [0, 100]],
    "place": [
      { "element": "oval", "position": [0, 0, 0] },
      { "element": "track", "position": [16, 0, 0], "rotation": { "axis": [1, 0, 0], "degrees": 90 } } ] },
  "load_case": { "plugin": "in_plane_periodic", "directions_deg": [0], "senses": ["stretch"] },
  "solver": { "preset": "accurate" }
})";
}

constexpr double period = 2.0 * (10.0 + 9.0) - 2.0 * (0.75 + 0.7);

TEST(Curves, SensitivitiesOfAChainAreExact)
{
  const WorkFolder folder;
  const Outcome o = run_program({"run", folder.write("links.json", links_text()), "-o", folder / "out"});
  ASSERT_EQ(o.code, 0) << o.err;
  const json::value results = read_results(folder / "out");
  EXPECT_NEAR(number_at(results, "/limits/0/value"), period / 32.0 - 1.0, 1e-9);
  const std::string at = "/limits/0/sensitivity";
  EXPECT_NEAR(number_at(results, at + "/clearance"), -2.0 / 32.0, 1e-6);
  const auto parameter = [&](const std::string& name) {
    return results.at_pointer(at + "/parameters").as_object().at(name).to_number<double>();
  };
  EXPECT_NEAR(parameter("0/half_length"), 2.0 / 32.0, 1e-6);
  EXPECT_NEAR(parameter("1/half_length"), 2.0 / 32.0, 1e-6);
  EXPECT_NEAR(parameter("0/r"), -2.0 / 32.0, 1e-6);
  EXPECT_NEAR(parameter("1/r"), -2.0 / 32.0, 1e-6);
  EXPECT_NEAR(parameter("1/half_width"), 0.0, 1e-6);
  EXPECT_EQ(run_program({"verify", folder / "out/results.json"}).code, 0);
}

TEST(Curves, ResultsWithAnotherCurveFailTheCheck)
{
  const WorkFolder folder;
  ASSERT_EQ(run_program({"run", folder.write("links.json", links_text()), "-o", folder / "out"}).code, 0);
  const json::value results = read_results(folder / "out");
  const auto verdict = [&](const std::string& pointer, double value) {
    json::value other = results;
    other.at_pointer(pointer) = value;
    return run_program({"verify", folder.write("results.json", write_json(other))});
  };
  const std::string first = "/scene/elements/0/primitives/0";
  const Outcome o = verdict(first + "/curve/0/cos/0", 10.2);
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.out.find("not the mean radius of the curve"), std::string::npos) << o.out;
  // A limit that was moved on: the tubes overlap.
  EXPECT_EQ(verdict("/limits/0/poses/1/position/0", 16.5).code, 1);
}

/// The limit of the meshes nears that of the tubes as the square of their edges; sensitivities are those of
/// the meshes, and their points are recomputed by other means.
TEST(Curves, MeshesConverge)
{
  const WorkFolder folder;
  const std::string file = folder.write("links.json", links_text());
  const auto limit = [&](int facets, double half_length) {
    const std::string out = folder / ("out" + std::to_string(facets));
    const Outcome o =
        run_program({"run", file, "-o", out, "--force", "--set", "/solver/contact=mesh", "--set",
                     "/solver/facets=" + std::to_string(facets), "--set",
                     fmt::format("/elements/oval/parameters/half_length={:.17g}", half_length)});
    EXPECT_EQ(o.code, 0) << o.err;
    return read_results(out);
  };
  const auto error = [&](int facets) {
    return number_at(limit(facets, 10.0), "/limits/0/value") - (period / 32.0 - 1.0);
  };
  const std::array<double, 3> errors{error(10), error(20), error(40)};
  EXPECT_GT(std::abs(errors[0]), 1e-3);
  EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.8);
  EXPECT_NEAR(errors[1] / errors[2], 4.0, 0.4);
  const Outcome check = run_program({"verify", folder / "out20/results.json"});
  EXPECT_EQ(check.code, 0) << check.out;

  const json::value now = limit(20, 10.0);
  const double h = 1e-4;
  const double slope = (number_at(limit(20, 10.0 + h), "/limits/0/value") -
                        number_at(limit(20, 10.0 - h), "/limits/0/value")) /
                       (2.0 * h);
  EXPECT_NEAR(
      now.at_pointer("/limits/0/sensitivity/parameters").as_object().at("0/half_length").to_number<double>(),
      slope, 1e-5);
  EXPECT_GT(slope, 0.05);
}

/// Of curves out of every plane, so that frames are turned back along them.
TEST(Curves, MeshesOfWavyRingsAreRecomputed)
{
  std::string text = with(links_text(), R"("curve": "oval",)", R"("curve": "knot", "turns": [1, 2],)");
  text = with(text, R"("half_length": 10, "half_width": 4, "r": 0.75)",
              R"("R": 9, "a": 0.7, "b": 1.6, "r": 0.75)");
  const WorkFolder folder;
  const Outcome o = run_program({"run", folder.write("wavy.json", text), "-o", folder / "out", "--set",
                                 "/solver/contact=mesh", "--set", "/solver/facets=14"});
  ASSERT_EQ(o.code, 0) << o.err;
  const Outcome check = run_program({"verify", folder / "out/results.json"});
  EXPECT_EQ(check.code, 0) << check.out;
  json::value tampered = read_results(folder / "out");
  json::value& v = tampered.at_pointer("/limits/0/contacts/0/points/0/2");
  v = v.to_number<double>() + 0.05;
  const Outcome caught = run_program({"verify", folder.write("t.json", write_json(tampered))});
  EXPECT_EQ(caught.code, 1);
  EXPECT_NE(caught.out.find("off its mesh"), std::string::npos) << caught.out;
}

TEST(Curves, ADesignFindsTheLengthsThatGiveALimit)
{
  std::string text = with(links_text(), R"("name": "links",)", R"("name": "links", "task": "design",)");
  text = with(text, R"("solver": { "preset": "accurate" })", R"("solver": { "preset": "accurate" },
  "design": {
    "optimizer": { "plugin": "sqp", "max_iterations": 20 },
    "quantity": "stretch",
    "variables": [ { "parameters": "half_length", "lower": 8, "upper": 14 } ],
    "targets": [ { "direction_deg": 0, "value": 0.15 } ] })");
  const WorkFolder folder;
  const Outcome o = run_program({"run", folder.write("design.json", text), "-o", folder / "out"});
  ASSERT_EQ(o.code, 0) << o.err << o.out;
  const json::value results = read_results(folder / "out");
  // 2 (a1 + a2) - 2 (0.75 + 0.7) = 1.15 x 32
  EXPECT_NEAR(
      number_at(results, "/design/variables/0/final") + number_at(results, "/design/variables/1/final"),
      0.5 * (1.15 * 32.0 + 2.9), 2e-3);
  EXPECT_NEAR(number_at(results, "/limits/0/value"), 0.15, 1e-4);
  const Outcome check = run_program({"verify", folder / "out/results.json"});
  EXPECT_EQ(check.code, 0) << check.out;
}

TEST(Curves, TrefoilsRepeatEverySixtyDegrees)
{
  const WorkFolder folder;
  const std::string file = std::string(HAUBERK_SOURCE_DIR) + "/share/experiments/trefoils.json";
  ASSERT_EQ(run_program({"run", file, "-o", folder / "out", "--set", "/solver/preset=accurate"}).code, 0);
  const json::value results = read_results(folder / "out");
  const double at_0 = number_at(results, "/limits/0/value"), at_60 = number_at(results, "/limits/2/value");
  EXPECT_NEAR(at_0, at_60, 1e-7);
  EXPECT_GT(at_0, number_at(results, "/limits/1/value"));
  const Outcome check = run_program({"verify", folder / "out/results.json"});
  EXPECT_EQ(check.code, 0) << check.out;
}

TEST(Curves, WhatKnowsToriOnlySaysSo)
{
  const WorkFolder folder;
  const std::string file = folder.write("links.json", links_text());
  for (const char* setting : {"/solver/contact=published", "/solver/ccd=sampled", "/solver/preset=paper"}) {
    const Outcome o = run_program({"run", file, "-o", folder / "out", "--set", setting});
    EXPECT_EQ(o.code, 2) << setting;
    EXPECT_NE(o.err.find("know tori only"), std::string::npos) << setting << o.err;
  }
  // So of struts, where nothing but their plugin knows the surface.
  const std::string struts = HAUBERK_SOURCE_DIR "/shapes/strut_frame/example.json";
  for (const char* setting : {"/solver/contact=published", "/solver/ccd=sampled", "/solver/preset=paper"}) {
    const Outcome o = run_program({"check", struts, "--set", setting, "--thorough"});
    EXPECT_EQ(o.code, 2) << setting;
    EXPECT_NE(o.err.find("this scene has solids, and"), std::string::npos) << setting << o.err;
  }
  const Outcome thick =
      run_program({"check", file, "--set", "/elements/oval/parameters/r=1.7", "--thorough"});
  EXPECT_EQ(thick.code, 2);
  EXPECT_NE(thick.err.find("parameter 'r' = 1.7 is too thick: the curve bends with a radius of 1.6"),
            std::string::npos)
      << thick.err;
}

}  // namespace
}  // namespace hauberk::test
