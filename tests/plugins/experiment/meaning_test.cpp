/// Messages about meaning: references, geometry, bounds, clearances. One edit of a correct file each.

#include "fake_plugins.hpp"
#include "tasks/design/design_section.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

std::string after(const std::string& from, const std::string& to)
{
  return problems_of(with(valid_text(), from, to));
}

std::string design(const std::string& to)
{
  return after("{ \"parameters\": \"ring.R\", \"lower\": 4.0, \"upper\": 6.5 }", to);
}

TEST(Meaning, Plugins)
{
  EXPECT_EQ(after("\"shape\": \"rings\"", "\"shape\": \"ringz\""),
            "t.json:4: /elements/link/shape: no plugin 'ringz' here");
  // Nothing can be said about the keys of a plugin that is missing.
  EXPECT_EQ(after("\"plugin\": \"plane\"", "\"plugin\": \"plain\", \"anything\": 1"),
            "t.json:13: /load_case/plugin: no plugin 'plain' here");
  EXPECT_EQ(after("\"search\"", "\"plane\""), "t.json:16: /design/optimizer/plugin: no plugin 'plane' here");
  EXPECT_EQ(after("\"name\": \"ring\"", "\"name\": \"bad\""),
            "t.json:4: /elements/link/rings/0/name: no ring can be called 'bad'");
  EXPECT_NE(after("\"name\": \"ring\"", "\"name\": \"throw\"").find("out of rings"), std::string::npos);
}

TEST(Meaning, Elements)
{
  EXPECT_EQ(after("\"ring.r\": 0.7", "\"ring.q\": 0.7"),
            "t.json:5: /elements/link/parameters/ring.q: unknown parameter 'ring.q'; did you mean 'ring.R'?");
  EXPECT_EQ(after("\"ring.r\": 0.7", "\"ring.r\": -0.7"),
            "t.json:5: /elements/link/parameters/ring.r: expected a number in [0, 1000000], found -0.7");
  EXPECT_EQ(after("\"ring.r\": 0.7", "\"ring.r\": 5.0"),
            "t.json:5: /elements/link/parameters: ring 'ring' has no hole");
  EXPECT_EQ(after("\"ring.R\": 5.0, ", ""),
            "t.json:10: /cell/place/0: parameter 'ring.R' has no value and no default: give it in "
            "/elements/link/parameters");
  EXPECT_EQ(after("\"link\": { \"shape\"",
                  "\"3/x\": { \"shape\": \"rings\", \"rings\": [{\"name\": \"a\"}] }, \"link\": { \"shape\""),
            "t.json:4: /elements/3~1x: expected a name that starts with a letter and has only letters, "
            "digits, '_', '-' and '.', found '3/x'");
}

/// The element of the valid file as a union of two parts.
std::string of_parts(const std::string& parts)
{
  const std::string text = with(valid_text(), R"("shape": "rings", "rings": [ { "name": "ring" } ])",
                                R"("shape": "union", "parts": )" + parts);
  return problems_of(with(text, R"("ring.R": 5.0, "ring.r": 0.7)", R"("a.ring.R": 5.0, "b.ring.R": 4.0)"));
}

TEST(Meaning, Unions)
{
  const std::string a = R"({ "name": "a", "shape": "rings", "rings": [ { "name": "ring" } ] })";
  const auto with_b = [&](const std::string& b) { return of_parts("[" + a + ", " + b + "]"); };
  const std::string rings = R"("shape": "rings", "rings": [ { "name": "ring" } ])";
  const std::string at = "t.json:4: /elements/link/parts";
  // "design" of the file varies ring.R, which the element has no longer.
  const std::string then =
      "\nt.json:17: /design/variables/0/parameters: no element has a parameter 'ring.R'; did you mean "
      "'a.ring.R'?";
  EXPECT_EQ(with_b(R"({ "name": "b", )" + rings + " }"), then.substr(1));
  EXPECT_EQ(with_b(R"({ "name": "b", "shape": "ringz" })"), at + "/1/shape: no plugin 'ringz' here");
  EXPECT_EQ(with_b(R"({ "name": "b" })"), at + "/1: missing key 'shape': expected a string");
  EXPECT_EQ(with_b(R"({ "name": "a", )" + rings + " }"),
            at + "/1/name: there are two parts named 'a'; give each its own name");
  EXPECT_EQ(with_b(R"({ "name": "b.c", )" + rings + " }"),
            at + "/1/name: expected a name of letters, digits, '_' and '-', found 'b.c'");
  EXPECT_EQ(with_b(R"({ "name": "b", "shape": "rings" })"),
            at + "/1: missing key 'rings': expected an array of at least 1 objects");
  EXPECT_EQ(with_b(R"({ "name": "b", "shape": "union", "parts": [] })"),
            at + "/1/shape: a part cannot be a union itself: list its parts beside this one");
  EXPECT_EQ(with_b(R"({ "name": "b", "rotation": { "axis": [0, 0, 0], "degrees": 1 }, )" + rings + " }"),
            at + "/1/rotation/axis: expected a direction, found all zeros");
  EXPECT_EQ(of_parts("[]"), at + ": expected an array of at least 1 objects, found an empty array");
  EXPECT_EQ(with_b(R"({ "name": "b", "rings": [ { "name": "bad" } ], "shape": "rings" })"),
            at + "/1/rings/0/name: no ring can be called 'bad'");
  EXPECT_EQ(with_b(R"({ "name": "b", "shape": "moved" })"),
            at + "/1/shape: shape 'moved' has a parameter 'x', which places parts, so it cannot be one");
  EXPECT_EQ(
      with_b(R"({ "name": "b", "shape": "placed" })"),
      at +
          "/1/shape: shape 'placed' cannot be a part: it has a field 'position' of its own, which is one of parts");
  // These leave a shape whose parameters are known.
  EXPECT_EQ(
      with_b(R"({ "name": "b", "colour": 1, )" + rings + " }"),
      at + "/1/colour: unknown key 'colour'; known: 'name', 'shape', 'position', 'rotation', 'rings'" + then);
  EXPECT_EQ(with_b(R"({ "name": "b", "position": [1, 2], )" + rings + " }"),
            at + "/1/position: expected an array of 3 numbers, found an array of 2 values" + then);
}

TEST(Meaning, GeometryOfPartsOfUnions)
{
  const std::string text =
      with(valid_text(), R"("rings", "rings": [ { "name": "ring" } ])",
           R"("union", "parts": [ { "name": "a", "shape": "rings", "rings": [ { "name": "ring" } ] } ])");
  const auto parameters = [&](const std::string& values) {
    return problems_of(with(with(text, R"("ring.R": 5.0, "ring.r": 0.7)", values), R"("ring.R", "lower")",
                            R"("a.ring.R", "lower")"));
  };
  EXPECT_EQ(parameters(R"("a.ring.R": 5.0, "a.x": -3)"), "");
  EXPECT_EQ(parameters(R"("a.ring.R": 5.0, "a.ring.r": 6)"),
            "t.json:5: /elements/link/parameters: part 'a': ring 'ring' has no hole");
  EXPECT_EQ(parameters(R"("a.ring.R": 5.0, "a.w": 6)"),
            "t.json:5: /elements/link/parameters/a.w: unknown parameter 'a.w'; did you mean 'a.x'?");
  EXPECT_EQ(parameters(R"("a.ring.r": 0.2)"),
            "t.json:10: /cell/place/0: parameter 'a.ring.R' has no value and no default: give it in "
            "/elements/link/parameters");
}

TEST(Meaning, AMistakeInAShapeHidesNoOther)
{
  const std::string text = with(valid_text(), "\"name\": \"ring\"", "\"name\": \"ring\", \"colour\": 1");
  EXPECT_EQ(problems_of(with(text, "\"ring.r\": 0.7", "\"ring.r\": -0.7")),
            "t.json:4: /elements/link/rings/0/colour: unknown key 'colour'; known: 'name'\n"
            "t.json:5: /elements/link/parameters/ring.r: expected a number in [0, 1000000], found -0.7");
  // Without its rings nothing can be said about the shape's parameters.
  const std::string broken = with(valid_text(), "\"name\": \"ring\"", "\"name\": 3");
  EXPECT_EQ(problems_of(with(broken, "\"ring.r\": 0.7", "\"ring.r\": -0.7")),
            "t.json:4: /elements/link/rings/0/name: expected a string, found 3");
}

TEST(Meaning, Placement)
{
  EXPECT_EQ(after("\"position\": [0, 0, 0]", "\"position\": [0, 0, 0], \"parameters\": { \"ring.x\": 1 }"),
            "t.json:10: /cell/place/0/parameters/ring.x: unknown parameter 'ring.x'; did you mean 'ring.R'?");
  EXPECT_EQ(after("\"position\": [0, 0, 0]", "\"position\": [0, 0, 0], \"parameters\": { \"ring.r\": 6 }"),
            "t.json:10: /cell/place/0/parameters: ring 'ring' has no hole");
  EXPECT_EQ(after("\"axis\": [1, 0, 0]", "\"axis\": [0, 0, 0]"),
            "t.json:11: /cell/place/1/rotation/axis: expected a direction, found all zeros");
  EXPECT_EQ(after(", \"degrees\": 90", ""),
            "t.json:11: /cell/place/1/rotation: expected either axis and degrees, or quaternion");
}

TEST(Meaning, Cell)
{
  EXPECT_EQ(after("[[12, 0], [0, 100]]", "[[12, 1], [-24, -2]]"),
            "t.json:8: /cell/vectors: expected two vectors that span the plane, found [12, 1] and [-24, -2], "
            "which are linearly dependent");
  EXPECT_EQ(after("\"vectors\": [[12, 0], [0, 100]],", ""),
            "t.json:7: /cell: missing key 'vectors': expected an array of 2 arrays of 2 numbers");
  EXPECT_EQ(after("\"place\": [", "\"repeat\": [1000, 1000], \"place\": ["),
            "t.json:9: /cell/repeat: expected at most 300000 placed elements, found 2000000");
}

TEST(Meaning, Patch)
{
  const auto patch = [](const std::string& outline) {
    return after("\"vectors\": [[12, 0], [0, 100]],",
                 "\"patch\": { \"vectors\": [[12, 0], [0, 100]], \"outline\": " + outline + " },");
  };
  EXPECT_EQ(patch("{ \"disk\": 50 }"),
            "t.json:13: /load_case/plugin: 'plane' loads a cell that repeats, and cell.patch is finite: use "
            "cell.vectors and cell.repeat, or a load case for patches");
  EXPECT_EQ(patch("{}"),
            "t.json:8: /cell/patch/outline: expected exactly one of disk, hexagon and rectangle\n"
            "t.json:13: /load_case/plugin: 'plane' loads a cell that repeats, and cell.patch is finite: use "
            "cell.vectors and cell.repeat, or a load case for patches");
  EXPECT_EQ(
      after("\"plugin\": \"plane\"", "\"plugin\": \"bend\"").substr(0, 90),
      std::string("t.json:13: /load_case/plugin: 'bend' loads a finite patch: use cell.patch instead of "
                  "cell.vectors and cell.repeat")
          .substr(0, 90));
}

TEST(Meaning, TaskAndLoadCase)
{
  EXPECT_EQ(after("\"name\": \"pair\"", "\"name\": \"pair\", \"task\": \"chart\""),
            "t.json:1: missing key 'chart': task chart needs it");
  EXPECT_EQ(after(", \"directions_deg\": [0, 30]", ""),
            "t.json:13: /load_case: missing key 'directions_deg': expected an array of at least 1 numbers, "
            "or key 'directions'");
  EXPECT_EQ(after("[0, 30]", "[0, 30, 0]"),
            "t.json:13: /load_case/directions_deg/2: direction 0 is given twice");
  EXPECT_EQ(after("[0, 30]", "[170, -10]"),
            "t.json:13: /load_case/directions_deg/1: direction -10 is the same as 170: directions count "
            "modulo 180 degrees");
  EXPECT_EQ(after("[0, 30]", "[0, 30], \"senses\": [\"stretch\", \"compres\", \"stretch\"]"),
            "t.json:13: /load_case/senses/1: expected one of stretch, compress, found \"compres\"; did you "
            "mean 'compress'?\n"
            "t.json:13: /load_case/senses/2: sense 'stretch' is given twice");
  EXPECT_EQ(after("\"pair\"", "\"\""), "t.json:2: /name: expected a name, found \"\"");
  const std::string text =
      with(valid_text(), "\"name\": \"pair\"", "\"name\": \"pair\", \"task\": \"design\"");
  EXPECT_EQ(
      problems_of(with(text, "\"design\": {", "\"x\": {")),
      "t.json:1: missing key 'design': task design needs it\n"
      "t.json:15: /x: unknown key 'x'; known: '$schema', 'extends', 'name', 'description', 'task', 'length_unit', "
      "'values', 'seed', 'elements', 'cell', 'load_case', 'solver', 'design', 'sweep', 'chart', 'stability', "
      "'transition', 'expect'");
}

TEST(Meaning, DesignQuantityAndTargets)
{
  EXPECT_EQ(after("\"quantity\": \"eta\"", "\"quantity\": \"curvature\""),
            "t.json:16: /design/quantity: 'curvature' needs a load case that bends; this one reports "
            "'tensor' in the senses stretch and compress");
  EXPECT_EQ(
      after("\"plugin\": \"plane\"", "\"plugin\": \"bend\""),
      "t.json:13: /load_case/plugin: 'bend' loads a finite patch: use cell.patch instead of cell.vectors and "
      "cell.repeat\n"
      "t.json:16: /design/quantity: 'eta' needs a load case that stretches and compresses; this one reports "
      "'normal_curvature' in the senses up and down");
  EXPECT_EQ(after("\"value\": 0.05 }", "\"value\": 0.05 }, { \"direction_deg\": 180, \"value\": 0.1 }"),
            "t.json:18: /design/targets/1/direction_deg: direction 180 is the same as 0: directions count "
            "modulo 180 degrees");
  const std::string text = with(valid_text(), "\"quantity\": \"eta\"", "\"quantity\": \"compress\"");
  EXPECT_EQ(problems_of(text),
            "t.json:18: /design/targets/0/value: expected a number <= 0 and > -1 for compress, found 0.05");
}

TEST(Meaning, DesignClearances)
{
  const std::string text = with(valid_text(), "\"tolerance\": 1e-3", "\"clearance\": 0.2");
  EXPECT_EQ(
      problems_of(with(text, "\"quantity\": \"eta\",",
                       "\"quantity\": \"eta\", \"hole_clearance\": 0.1, \"rest_clearance\": 0.15,")),
      "t.json:16: /design/hole_clearance: expected at least solver.clearance, which is 0.2, found 0.1\n"
      "t.json:16: /design/rest_clearance: expected at least solver.clearance, which is 0.2, found 0.15");
  const Experiment experiment = read_ok(text);
  EXPECT_EQ(experiment.section<ExperimentDesign>()->hole_clearance, 0.2);
  EXPECT_EQ(experiment.section<ExperimentDesign>()->rest_clearance, 0.2);
}

TEST(Meaning, DesignVariables)
{
  EXPECT_EQ(design("{ \"parameters\": \"ring.q\", \"lower\": 4, \"upper\": 6 }"),
            "t.json:17: /design/variables/0/parameters: no element has a parameter 'ring.q'; did you mean "
            "'ring.R'?");
  EXPECT_EQ(design("{ \"parameters\": \"ring.R\", \"lower\": 6, \"upper\": 6 }"),
            "t.json:17: /design/variables/0: expected lower < upper, found lower 6 and upper 6");
  EXPECT_EQ(design("{ \"parameters\": \"ring.R\", \"lower\": 5.5, \"upper\": 6 }"),
            "t.json:17: /design/variables/0/parameters: the initial value 5 of '0/ring.R' is outside [5.5, "
            "6], and so are 1 more");
  EXPECT_EQ(
      design("{ \"parameters\": \"ring.R\", \"per\": \"all\", \"lower\": 5.5, \"upper\": 6 }"),
      "t.json:17: /design/variables/0/parameters: the initial value 5 of '*/ring.R' is outside [5.5, 6]");
  EXPECT_EQ(design("{ \"parameters\": \"ring.R\", \"lower\": -1, \"upper\": 2e6 }"),
            "t.json:17: /design/variables/0/lower: expected at least 0, the least 'ring.R' may be, found -1\n"
            "t.json:17: /design/variables/0/upper: expected at most 1000000, the most 'ring.R' may be, found "
            "2000000");
  EXPECT_EQ(design("{ \"parameters\": \"count\", \"lower\": 1, \"upper\": 2 }"),
            "t.json:17: /design/variables/0/parameters: parameter 'count' of element 'link' cannot be "
            "designed: the shape does not depend on it smoothly");
}

TEST(Meaning, OverlappingVariables)
{
  EXPECT_EQ(
      design("{ \"parameters\": [\"ring.R\", \"ring.R\"], \"lower\": 4, \"upper\": 6 }"),
      "t.json:17: /design/variables/0/parameters/1: parameter 'ring.R' of placed element 0 is listed twice");
  EXPECT_EQ(design("{ \"parameters\": \"ring.R\", \"per\": \"all\", \"lower\": 4, \"upper\": 6 },\n"
                   "{ \"parameters\": \"ring.R\", \"per\": \"type\", \"lower\": 4, \"upper\": 6 }"),
            "t.json:18: /design/variables/1/parameters: parameter 'ring.R' of placed element 0 is already "
            "varied by /design/variables/0");
}

TEST(Meaning, TiedElementsMustStartEqual)
{
  const std::string text = with(valid_text(), "\"position\": [0, 0, 0]",
                                "\"position\": [0, 0, 0], \"parameters\": { \"ring.R\": 5.25 }");
  EXPECT_EQ(problems_of(text), "");
  EXPECT_EQ(problems_of(with(text, "\"lower\": 4.0", "\"per\": \"type\", \"lower\": 4.0")),
            "t.json:17: /design/variables/0/parameters: 'link/ring.R' varies elements whose values differ: "
            "5.25 (placed element 0) and 5 (1); give them one value, or use per element");
}

TEST(Meaning, Expectations)
{
  const auto expect = [](const std::string& entry) {
    return after("\"solver\":", "\"expect\": [ " + entry + " ],\n  \"solver\":");
  };
  EXPECT_EQ(expect("{ \"pointer\": \"/limits/0/value\" }"),
            "t.json:14: /expect/0: expected at least one of value, min, max");
  EXPECT_EQ(
      expect("{ \"pointer\": \"limits\", \"value\": 1 }"),
      "t.json:14: /expect/0/pointer: expected a JSON pointer such as /limits/0/value, found \"limits\"");
  EXPECT_EQ(expect("{ \"pointer\": \"/a\", \"value\": \"locked\", \"rel\": 1e-3 }"),
            "t.json:14: /expect/0/rel: 'rel' needs a number in 'value'");
  EXPECT_EQ(expect("{ \"pointer\": \"/a\", \"abs\": 1 }"),
            "t.json:14: /expect/0/abs: 'abs' needs a number in 'value'");
  EXPECT_EQ(expect("{ \"pointer\": \"/a\", \"min\": 2, \"max\": 1 }"),
            "t.json:14: /expect/0: expected min <= max, found min 2 and max 1");
  EXPECT_EQ(expect("{ \"pointer\": \"/a\", \"value\": true, \"min\": 2 }"),
            "t.json:14: /expect/0/min: 'min' needs a number in 'value', or no 'value'");
}

}  // namespace
}  // namespace hauberk::test
