/// Unions of shapes in experiments: they are the same as one shape with the same primitives, loops that parts
/// close together are links, and limits, designs and checks are those of closed forms.

#include "document/json_text.hpp"
#include "program.hpp"

#include <gtest/gtest.h>
#include <boost/json/object.hpp>

#include <cmath>

namespace hauberk::test {
namespace {

namespace json = boost::json;

/// A chain of elements of two rings at right angles, left and right, whose tubes overlap at the origin.
std::string pairs_text(const std::string& element)
{
  return R"({
  "name": "pairs",
  "elements": { "pair": { )" +
         element + R"( } },
  "cell": { "vectors": [[15, 0], [0, 100]],
            "place": [ { "element": "pair", "position": [0, 0, 0] } ] },
  "load_case": { "plugin": "in_plane_periodic", "directions_deg": [0], "senses": ["stretch"] },
  "solver": { "preset": "accurate" }
})";
}

const char* one_shape = R"("shape": "torus_union",
    "tori": [ { "name": "left", "position": [-5, 0, 0] }, { "name": "right", "position": [4, 0, 0], "axis": [0, 1, 0] } ],
    "parameters": { "left.R": 5, "left.r0": 0.7, "left.r1": 0.6, "right.R": 4, "right.r0": 0.7, "right.r1": 0.7 })";
const char* two_parts = R"("shape": "union", "parts": [
      { "name": "left", "shape": "torus_union", "tori": [ { "name": "ring" } ], "position": [-5, 0, 0] },
      { "name": "right", "shape": "torus_union", "tori": [ { "name": "ring", "axis": [0, 1, 0] } ],
        "position": [4, 0, 0] } ],
    "parameters": { "left.ring.R": 5, "left.ring.r0": 0.7, "left.ring.r1": 0.6,
                    "right.ring.R": 4, "right.ring.r0": 0.7, "right.ring.r1": 0.7 })";
/// The right ring is turned with its part instead.
const char* turned_part = R"("shape": "union", "parts": [
      { "name": "left", "shape": "torus_union", "tori": [ { "name": "ring" } ], "position": [-5, 0, 0] },
      { "name": "right", "shape": "torus_union", "tori": [ { "name": "ring" } ], "position": [4, 0, 0],
        "rotation": { "axis": [1, 0, 0], "degrees": 90 } } ],
    "parameters": { "left.ring.R": 5, "left.ring.r0": 0.7, "left.ring.r1": 0.6,
                    "right.ring.R": 4, "right.ring.r0": 0.7, "right.ring.r1": 0.7 })";

/// A period of these is 5 + 4 between the centres, and 5 + 4 - (0.7 + 0.7) from there to the next.
constexpr double pairs_limit = (2.0 * 9.0 - 1.4) / 15.0 - 1.0;

json::value results_of(const WorkFolder& folder, const std::string& name, const std::string& text)
{
  const Outcome o = run_program({"run", folder.write(name + ".json", text), "-o", folder / name});
  EXPECT_EQ(o.code, 0) << o.err << o.out;
  const Outcome check = run_program({"verify", folder / (name + "/results.json")});
  EXPECT_EQ(check.code, 0) << check.out;
  EXPECT_EQ(check.out.find("primitives of shapes that are not known here"), std::string::npos) << check.out;
  return timeless(read_results(folder / name));
}

double sensitivity(const json::value& results, const std::string& parameter)
{
  return results.at_pointer("/limits/0/sensitivity/parameters").as_object().at(parameter).to_number<double>();
}

/// The first limit without derivatives in parameters, whose names differ.
json::object limit_alone(const json::value& results)
{
  json::object limit = results.at_pointer("/limits/0").as_object();
  for (const char* key : {"sensitivity", "sensitivity_one_sided"}) limit.erase(key);
  return limit;
}

TEST(Unions, AreTheSameAsOneShapeWithTheirPrimitives)
{
  const WorkFolder folder;
  const json::value one = results_of(folder, "one", pairs_text(one_shape));
  const json::value two = results_of(folder, "two", pairs_text(two_parts));
  EXPECT_NEAR(number_at(one, "/limits/0/value"), pairs_limit, 1e-9);
  EXPECT_EQ(write_json(limit_alone(two)), write_json(limit_alone(one)));
  EXPECT_EQ(two.at("plan"), one.at("plan"));
  for (const char* side : {"left", "right"})
    for (const char* radius : {".R", ".r0", ".r1"})
      EXPECT_EQ(sensitivity(two, std::string("0/") + side + ".ring" + radius),
                sensitivity(one, std::string("0/") + side + radius));
  const json::value turned = results_of(folder, "turned", pairs_text(turned_part));
  EXPECT_NEAR(number_at(turned, "/limits/0/value"), number_at(one, "/limits/0/value"), 1e-12);
}

/// Parts that nothing joins move as one, which nothing that is made does: whoever asks is told.
TEST(Unions, PartsThatNothingJoinsAreTold)
{
  const WorkFolder folder;
  const std::string text =
      with(union_text(), R"("position": [0, 0, 4], "axis": [1, 0, 0])",
           R"("position": [0, 0, 4], "axis": [1, 0, 0] }, { "name": "far", "position": [0, 0, 40])");
  const std::string apart = folder.write(
      "a.json", with(text, R"("parameters": {)",
                     R"("parameters": { "eye.far.R": 2, "eye.far.r0": 0.3, "eye.far.r1": 0.3,)"));
  const std::string warning = "the element 'link' is of 2 bodies that nothing joins (";
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"check", apart}, {"run", apart, "-o", folder / "out", "--quiet"}}) {
    const Outcome o = run_program(words);
    EXPECT_NE(o.err.find("hauberk: warning: "), std::string::npos) << o.err;
    EXPECT_NE(o.err.find(warning), std::string::npos) << o.err;
    EXPECT_NE(o.err.find("'eye.far'"), std::string::npos) << o.err;
  }
  const json::value told = parse_json(run_program({"check", apart, "--json"}).out, "check");
  EXPECT_TRUE(told.at("ok").as_bool());
  EXPECT_EQ(told.at("warnings").as_array().size(), 1U);
  const Outcome exported = run_program({"export", apart, "-o", folder / "a.stl"});
  EXPECT_NE(exported.out.find("of 2 bodies each that nothing joins"), std::string::npos) << exported.out;
  const Outcome whole = run_program({"check", folder.write("u.json", union_text())});
  EXPECT_EQ(whole.code, 0);
  EXPECT_EQ(whole.err, "");
}

TEST(Unions, AreDesignedAsOneShapeIs)
{
  const auto design = [](std::string text, const std::string& ring) {
    text = with(text, R"("name": "pairs",)", R"("name": "pairs", "task": "design",)");
    return with(text, R"("solver": { "preset": "accurate" })", R"("solver": { "preset": "accurate" },
  "design": {
    "optimizer": { "plugin": "sqp", "max_iterations": 3 }, "quantity": "stretch",
    "variables": [ { "parameters": "left)" + ring + R"(.R", "lower": 4, "upper": 6 },
                   { "parameters": "right)" + ring + R"(.r0", "lower": 0.4, "upper": 1 } ],
    "targets": [ { "direction_deg": 0, "value": 0.125 } ] })");
  };
  const WorkFolder folder;
  const json::value one = results_of(folder, "one", design(pairs_text(one_shape), ""));
  const json::value two = results_of(folder, "two", design(pairs_text(two_parts), ".ring"));
  for (const char* pointer : {"/design/variables/0/final", "/design/variables/1/final", "/limits/0/value"})
    EXPECT_EQ(number_at(two, pointer), number_at(one, pointer)) << pointer;
  EXPECT_GT(std::abs(number_at(two, "/design/variables/0/final") - 5.0), 1e-3);
}

/// The eye's place alone is free: 12 % of 15 become 20 % when it is moved by 8 % of 15.
TEST(Unions, PlacesOfPartsAreDesigned)
{
  std::string text = with(union_text(), R"("name": "union",)", R"("name": "union", "task": "design",)");
  text = with(text, R"("expect": [ { "pointer": "/limits/0/value", "value": 0.12, "abs": 1e-9 } ])",
              R"("design": {
    "optimizer": { "plugin": "sqp", "max_iterations": 20 }, "quantity": "stretch",
    "variables": [ { "parameters": "eye.x", "lower": -3, "upper": 3 } ],
    "targets": [ { "direction_deg": 0, "value": 0.2 } ] })");
  const WorkFolder folder;
  const json::value results = results_of(folder, "out", text);
  EXPECT_NEAR(number_at(results, "/design/variables/0/final"), 0.08 * 15.0, 1e-4);
  EXPECT_NEAR(number_at(results, "/limits/0/value"), 0.2, 1e-5);
}

TEST(Unions, SensitivitiesOfPlacesAreExact)
{
  const WorkFolder folder;
  const json::value results = results_of(folder, "out", union_text());
  const std::pair<const char*, double> expected[] = {
      {"0/eye.x", 1.0},        {"0/hook.x", -1.0}, {"0/eye.ring.R", 1.0},  {"0/hook.half_length", 1.0},
      {"0/eye.ring.r0", -1.0}, {"0/hook.r", -1.0}, {"0/eye.ring.r1", 0.0}, {"0/hook.half_width", 0.0}};
  for (const auto& [name, slope] : expected)
    EXPECT_NEAR(sensitivity(results, name), slope / 15.0, 1e-6) << name;
}

/// Squares of struts in each other's corners, each the union of two halves that have no window of their own:
/// a period of two is 2 sqrt(2) size - 4 sqrt(3) r, and only the loop of both halves holds it.
TEST(Unions, PartsCloseLoopsTogether)
{
  const WorkFolder folder;
  std::string text = read_text(HAUBERK_SOURCE_DIR "/shapes/strut_frame/example.json");
  text = with(text, R"("shape": "strut_frame", "polyhedron": "square",)", R"("shape": "union", "parts": [
        { "name": "a", "shape": "strut_frame", "nodes": [[1, -1, 0], [1, 1, 0], [-1, 1, 0]], "struts": [[0, 1], [1, 2]] },
        { "name": "b", "shape": "strut_frame", "nodes": [[-1, 1, 0], [-1, -1, 0], [1, -1, 0]], "struts": [[0, 1], [1, 2]] }
      ],)");
  text = with(text, R"("size": 10, "r": 0.5)", R"("a.size": 5, "a.r": 0.5, "b.size": 5, "b.r": 0.5)");
  const Outcome o = run_program({"run", folder.write("squares.json", text), "-o", folder / "out"});
  ASSERT_EQ(o.code, 0) << o.err << o.out;
  const json::value results = read_results(folder / "out");
  EXPECT_NEAR(number_at(results, "/limits/0/value"),
              (20.0 * std::sqrt(2.0) - 2.0 * std::sqrt(3.0)) / 22.0 - 1.0, 1e-7);
  const Outcome plan = run_program({"plan", folder / "squares.json"});
  EXPECT_NE(plan.out.find("links per element: 2 each"), std::string::npos) << plan.out;
}

TEST(Unions, ResultsWithAnotherPlaceOfAPartFailTheCheck)
{
  const WorkFolder folder;
  json::value results = results_of(folder, "out", union_text());
  EXPECT_EQ(results.at_pointer("/scene/elements/0/primitives/1/name"), "hook.tube");
  for (const char* pointer : {"/experiment/elements/link/parts/1/rotation/degrees",
                              "/experiment/elements/link/parameters/hook.x"}) {
    json::value other = results;
    json::value& v = other.at_pointer(pointer);
    v = v.to_number<double>() + 0.01;
    EXPECT_EQ(run_program({"verify", folder.write("results.json", write_json(other))}).code, 1) << pointer;
  }
}

TEST(Unions, AreListedAndDescribed)
{
  const Outcome list = run_program({"plugins", "list"});
  EXPECT_NE(list.out.find("Rigid union of parts of any shapes; built in."), std::string::npos) << list.out;
  const Outcome one = run_program({"plugins", "describe", "union"});
  EXPECT_EQ(one.code, 0);
  EXPECT_NE(one.out.find("## `/elements/NAME/parts/*`"), std::string::npos) << one.out;
}

}  // namespace
}  // namespace hauberk::test
