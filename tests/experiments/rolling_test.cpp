/// Patches rolled onto a cylinder: symmetries, the independent check, and where a paraboloid says something
/// else.

#include "document/json_text.hpp"
#include "program.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <cmath>

namespace hauberk::test {
namespace {

namespace json = boost::json;

/// Seven threefold elements with oval tubes, all of a patch held but its curvature along the load.
std::string oval_patch(const std::string& plugin, const std::string& clearance)
{
  return R"({
  "name": "patch",
  "elements": {
    "threefold": { "shape": "torus_union",
      "tori": [
        { "name": "centre" },
        { "name": "side_270", "group": "side", "position": { "direction_deg": -90, "distance": ["centre.R", "side.R"] }, "axis": "tangential" },
        { "name": "side_30", "group": "side", "position": { "direction_deg": 30, "distance": ["centre.R", "side.R"] }, "axis": "tangential" },
        { "name": "side_150", "group": "side", "position": { "direction_deg": 150, "distance": ["centre.R", "side.R"] }, "axis": "tangential" } ],
      "parameters": { "centre.R": 4.25, "centre.r0": 0.95, "centre.r1": 1.5, "side.R": 2.575, "side.r0": 0.95, "side.r1": 1.4 } } },
  "cell": {
    "patch": { "vectors": [[9.591231359, 5.5375], [0, 11.075]], "outline": { "hexagon": 1 } },
    "place": [ { "element": "threefold", "position": [0, 0, 0] } ] },
  "load_case": { "plugin": ")" +
         plugin + R"(", "directions_deg": [0], "senses": ["up"], "hold": ["places", "twist", "transverse"] },
  "solver": { "preset": "accurate", "neighbours": 0, "clearance": )" +
         clearance + "} }";
}

/// Four rings in a row, 8.5 apart; linked ones are taut at 8.6.
std::string taut_row(const std::string& plugin)
{
  return R"({
  "name": "row",
  "elements": { "link": { "shape": "torus_union", "tori": [{ "name": "ring" }],
    "parameters": { "ring.R": 5, "ring.r0": 0.7, "ring.r1": 0.7 } } },
  "cell": {
    "patch": { "vectors": [[17, 0], [0, 100]], "outline": { "rectangle": [2, 1] } },
    "place": [ { "element": "link", "position": [0, 0, 0] },
      { "element": "link", "position": [8.5, 0, 0], "rotation": { "axis": [1, 0, 0], "degrees": 90 } } ] },
  "load_case": { "plugin": ")" +
         plugin + R"(", "directions_deg": [0], "senses": ["up"], "hold": ["places", "twist", "transverse"] }
})";
}

json::value results_of(const std::string& text)
{
  const WorkFolder folder;
  EXPECT_EQ(run_program({"run", folder.write("e.json", text), "-o", folder / "out"}).code, 0);
  return read_results(folder / "out");
}

double value_of(const std::string& text) { return number_at(results_of(text), "/limits/0/value"); }

/// The example in four directions and both senses, elements free to leave the sheet.
class Rolling : public ::testing::Test {
 protected:
  static void SetUpTestSuite()
  {
    const WorkFolder folder;
    ASSERT_EQ(
        run_program({"run", HAUBERK_SOURCE_DIR "/loadcases/cylinder_roll/example.json", "-o", folder / "out",
                     "--set", "/load_case/directions_deg=[0, 60, 120]", "--set",
                     "/load_case/senses=[\"up\", \"down\"]", "--set", "/load_case/out_of_plane=\"free\""})
            .code,
        0);
    results_ = read_results(folder / "out");
  }

  static void expect_caught(const json::value& results, const std::string& message)
  {
    const WorkFolder folder;
    const Outcome o = run_program({"verify", folder.write("results.json", write_json(results))});
    EXPECT_EQ(o.code, 1);
    EXPECT_NE(o.out.find(message), std::string::npos) << "missing: " << message << '\n' << o.out;
  }

  static inline json::value results_;
};

TEST_F(Rolling, HasTheSymmetriesOfThePatch)
{
  const double first = number_at(results_, "/limits/0/value");
  EXPECT_GT(first, 0.11);
  for (int k = 0; k < 6; ++k) {
    const std::string at = "/limits/" + std::to_string(k);
    EXPECT_EQ(results_.at_pointer(at + "/status").as_string(), "locked");
    const double sign = results_.at_pointer(at + "/sense").as_string() == "up" ? 1.0 : -1.0;
    EXPECT_NEAR(sign * number_at(results_, at + "/value"), first, 2e-9 * first) << at;
  }
}

TEST_F(Rolling, TheCheckSeesWhatIsNoStateOfIt)
{
  const WorkFolder folder;
  EXPECT_EQ(run_program({"verify", folder.write("results.json", write_json(results_))}).code, 0);
  json::value r = results_;
  for (int k = 0; k < 7; ++k) {  // a patch that left its roll as a whole
    const std::string at = "/limits/0/poses/" + std::to_string(k) + "/position/2";
    r.at_pointer(at) = number_at(r, at) + 1e-5;
  }
  expect_caught(r, "the patch moved against its roll");
  r = results_;
  r.at_pointer("/limits/0/contacts/0/force") = 1.01 * number_at(r, "/limits/0/contacts/0/force");
  expect_caught(r, "forces miss the load");
}

TEST_F(Rolling, TheCheckSeesWhatIsOffTheRoll)
{
  const json::value on = results_of(oval_patch("cylinder_roll", "0"));
  json::value r = on;
  r.at_pointer("/limits/0/poses/2/position/2") = number_at(r, "/limits/0/poses/2/position/2") + 1e-6;
  expect_caught(r, "off the roll");
  r = on;
  r.at_pointer("/limits/0/macro/kxx") = number_at(r, "/limits/0/macro/kxx") + 1e-6;
  expect_caught(r, "off the roll");
  r = on;
  r.at_pointer("/limits/0/poses/2/position/1") = number_at(r, "/limits/0/poses/2/position/1") + 1e-4;
  expect_caught(r, "element 2 is 0.0001 from its place");
}

/// Roll and paraboloid differ in second order, while what locks a patch does so in first: their limits differ
/// by a part that falls with curvature times size. The clearance leaves less and less room to bend.
TEST(RollAndParaboloid, AgreeWhereAPatchBendsLittle)
{
  constexpr double size = 11.075;
  double last = 1.0;
  for (const char* clearance : {"0", "0.1", "0.124"}) {
    const double roll = value_of(oval_patch("cylinder_roll", clearance)),
                 paraboloid = value_of(oval_patch("paraboloid_bending", clearance));
    const double difference = roll / paraboloid - 1.0;
    EXPECT_GT(difference, 0.05 * roll * size) << clearance;
    EXPECT_LT(difference, 0.1 * roll * size) << clearance;
    EXPECT_LT(difference, 0.5 * last) << clearance;
    last = difference;
  }
  EXPECT_LT(last, 5e-4);
}

/// Over places that are held a paraboloid is longer than they are: linked rings d apart are taut at the
/// latest where d^2 + (k d^2)^2 = 8.6^2. On a roll they come nearer to each other.
TEST(RollAndParaboloid, DifferWhereLinksAreNearlyTaut)
{
  constexpr double taut = 8.6, d = 8.5;
  const double bound = std::sqrt(taut * taut - d * d) / (d * d);
  const double paraboloid = value_of(taut_row("paraboloid_bending")),
               roll = value_of(taut_row("cylinder_roll"));
  EXPECT_LT(paraboloid, bound * (1.0 + 1e-8));
  EXPECT_GT(paraboloid, 0.99 * bound);
  EXPECT_GT(roll / paraboloid, 12.0);
  EXPECT_LT(2.0 / roll * std::sin(0.5 * roll * d), d);
}

/// A strip of European 4-in-1, its axis along the columns.
std::string strip(int rows, const std::string& more = "")
{
  return R"({
  "name": "strip", "length_unit": "mm",
  "cell": { "weave": { "name": "european_4in1" }, "strip": { "axis": [0, 1], "rows": )" +
         std::to_string(rows) + " }" + more + R"( },
  "load_case": { "plugin": "strip_roll", "directions_deg": [90] } })";
}

/// Two rings that meet as those of share/experiments/roll.json, with or without rings that repeat along the
/// axis, too far away to meet: (2/k) sin(k d/2) = 2 r.
TEST(StripRolling, IsThePatchWhereNothingRepeats)
{
  const json::value r = results_of(R"({
  "name": "idle", "length_unit": "mm",
  "elements": { "link": { "shape": "torus_union", "tori": [{ "name": "ring" }],
    "parameters": { "ring.R": 5, "ring.r0": 2.4, "ring.r1": 2.4 } } },
  "cell": { "vectors": [[100]], "place": [
    { "element": "link", "position": [0, -2.5, 0] },
    { "element": "link", "position": [0, 2.5, 0], "rotation": { "axis": [0, 1, 0], "degrees": 90 } } ] },
  "load_case": { "plugin": "strip_roll", "directions_deg": [90], "hold": ["places"] } })");
  constexpr double exact = 0.1971532730480749;
  EXPECT_NEAR(number_at(r, "/limits/0/value"), exact, 1e-8 * exact);
  EXPECT_NEAR(number_at(r, "/limits/1/value"), -exact, 1e-8 * exact);
}

/// Flat and upright rings are their own mirror images in the sheet, so that it bends as far down as up, also
/// where elements have slid far along it.
TEST(StripRolling, MirrorImagesBendAlike)
{
  const json::value r = results_of(R"({
  "name": "mirrored", "length_unit": "mm",
  "cell": { "weave": { "name": "japanese_4in1", "parameters": { "inner_diameter": 8, "wire_diameter": 2 } },
            "strip": { "axis": [0, 1], "rows": 3 } },
  "load_case": { "plugin": "strip_roll", "directions_deg": [90] } })");
  const double up = number_at(r, "/limits/0/value");
  EXPECT_GT(up, 0.25);
  EXPECT_NEAR(number_at(r, "/limits/1/value"), -up, 1e-7 * up);
}

class StripResults : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { results_ = results_of(strip(2)); }
  static inline json::value results_;
};

/// Half a turn about the axis' normal carries the strip onto itself, upside down: up and down are equal. A
/// cell of two periods has at least the state of one.
TEST_F(StripResults, KeepSymmetriesAndPeriods)
{
  const double up = number_at(results_, "/limits/0/value");
  EXPECT_GT(up, 0.11);
  EXPECT_NEAR(number_at(results_, "/limits/1/value"), -up, 1e-8 * up);
  const json::value twice = results_of(strip(2, R"(, "repeat": [2])"));
  EXPECT_GE(number_at(twice, "/limits/0/value"), up * (1.0 - 1e-7));
  EXPECT_EQ(twice.at_pointer("/scene/elements").as_array().size(), 8U);
}

TEST_F(StripResults, AreChecked)
{
  const WorkFolder folder;
  const auto verified = [&](const json::value& results) {
    return run_program({"verify", folder.write("results.json", write_json(results))});
  };
  const Outcome whole = verified(results_);
  EXPECT_EQ(whole.code, 0) << whole.out;
  EXPECT_EQ(whole.out.find("is not known to this check"), std::string::npos);
  const auto changed = [&](const char* place, double by) {
    json::value r = results_;
    r.at_pointer(place) = number_at(r, place) + by;
    return r;
  };
  const std::pair<const char*, const char*> wrong[] = {
      {"/limits/0/macro/k", "off the roll"},                 // the elements are on another cylinder
      {"/limits/0/macro/exx", "closer than the clearance"},  // and their images elsewhere
      {"/limits/0/poses/1/position/2", "off the roll"},
      {"/limits/0/poses/1/position/0", "moved against its roll"},
      {"/limits/0/value", "from macro"},
      {"/scene/cell_vectors/0/0", "not those of the experiment"}};
  for (const auto& [place, message] : wrong) {
    const Outcome o = verified(changed(place, 1e-5));
    EXPECT_EQ(o.code, 1) << place;
    EXPECT_NE(o.out.find(message), std::string::npos) << place << '\n' << o.out;
  }
}

/// A strip as its experiment says and as results hold it, written out, are the same scene.
TEST_F(StripResults, AreThoseOfTheStripWrittenOut)
{
  const json::value& cell = results_.at_pointer("/experiment/cell");
  EXPECT_FALSE(cell.as_object().contains("weave"));
  EXPECT_EQ(write_json(results_.at_pointer("/scene/cell_vectors")),
            write_json(results_of(write_json(results_.at("experiment"))).at_pointer("/scene/cell_vectors")));
}

/// Two rows whose tubes are designed for a curvature of 0.07.
std::string strip_design()
{
  std::string text = with(strip(2), "\"directions_deg\": [90]",
                          R"("directions_deg": [90], "senses": ["up"], "hold": ["places"])");
  text = with(text, "\"length_unit\": \"mm\",", R"("length_unit": "mm", "task": "design",
  "design": { "optimizer": { "plugin": "sqp", "max_iterations": 5 }, "quantity": "curvature", "tolerance": 0.01,
    "variables": [{ "parameters": ["ring.r0", "ring.r1"], "tied": true, "per": "all", "lower": 0.9, "upper": 1.2 }],
    "targets": [{ "direction_deg": 90, "value": 0.07 }] },)");
  return text;
}

/// A design of a strip leaves an experiment that is laid out, and that can be run.
TEST(StripRolling, CanBeDesigned)
{
  const WorkFolder folder;
  const std::string text = strip_design();
  ASSERT_EQ(run_program({"run", folder.write("d.json", text), "-o", folder / "out"}).code, 0);
  EXPECT_NEAR(number_at(read_results(folder / "out"), "/limits/0/value"), 0.07, 7e-4);
  EXPECT_EQ(run_program({"verify", folder / "out"}).code, 0);
  const Outcome designed = run_program({"run", folder / "out/designed.json", "-o", folder / "again"});
  ASSERT_EQ(designed.code, 0) << designed.err;
  EXPECT_NEAR(number_at(read_results(folder / "again"), "/limits/0/value"), 0.07, 7e-4);
  // The same as a strip, and with more rows, as another file extends it.
  const Outcome same = run_program({"run", folder / "out/designed_fabric.json", "-o", folder / "fabric"});
  ASSERT_EQ(same.code, 0) << same.err;
  EXPECT_NEAR(number_at(read_results(folder / "fabric"), "/limits/0/value"), 0.07, 7e-4);
  const std::string wider =
      R"({ "extends": "out/designed_fabric.json", "name": "wider", "cell": { "strip": { "rows": 3 } } })";
  ASSERT_EQ(run_program({"run", folder.write("wider.json", wider), "-o", folder / "wider"}).code, 0);
  EXPECT_EQ(read_results(folder / "wider").at_pointer("/scene/elements").as_array().size(),
            3 * read_results(folder / "out").at_pointer("/scene/elements").as_array().size() / 2);
  // The other load of the sheet that the strip was cut from.
  const std::string sheet =
      R"({ "extends": "out/designed_fabric.json", "name": "sheet", "cell": { "strip": null },
    "load_case": { "plugin": "in_plane_periodic", "directions_deg": [0], "senses": ["stretch"], "hold": [] } })";
  const Outcome stretched = run_program({"run", folder.write("sheet.json", sheet), "-o", folder / "sheet"});
  ASSERT_EQ(stretched.code, 0) << stretched.err;
  EXPECT_EQ(read_results(folder / "sheet").at_pointer("/scene/elements/0/parameters/ring.r0"),
            read_results(folder / "out").at_pointer("/scene/elements/0/parameters/ring.r0"));
}

TEST(StripRolling, SaysWhatIsNoStrip)
{
  const WorkFolder folder;
  const auto refused = [&](const std::string& text, const std::string& message) {
    const Outcome o = run_program({"check", folder.write("e.json", text)});
    EXPECT_EQ(o.code, 2);
    EXPECT_NE(o.err.find(message), std::string::npos) << o.err;
  };
  const std::string good = strip(2);
  EXPECT_EQ(run_program({"check", folder.write("e.json", good)}).code, 0);
  refused(with(good, R"("strip": { "axis": [0, 1], "rows": 2 })", R"("repeat": [1, 1])"),
          "'strip_roll' loads cells with 1 vector, and there are 2: cut one with cell.strip");
  refused(with(good, "strip_roll", "in_plane_periodic"),
          "'in_plane_periodic' loads cells with 2 vectors, and there is 1");
  refused(with(good, "[90]", "[0, 90, 180]"),
          "/load_case/directions_deg/0: 'strip_roll' has no load at 0 degrees");
  refused(with(strip_design(), R"("direction_deg": 90)", R"("direction_deg": 0)"),
          "/design/targets/0/direction_deg: 'strip_roll' has no load at 0 degrees");
  refused(with(good, "[0, 1]", "[2, 4]"),
          "/cell/strip/axis: expected two whole numbers without a common factor, found 2 and 4");
  refused(with(good, R"("rows": 2 })", R"("rows": 2 }, "repeat": [1, 2])"),
          "/cell/repeat: expected one number for each of the 1 vectors, found 2");
  refused(with(good, R"("directions_deg": [90])", R"("directions": [[0, 1]])"),
          "the unknowns of 'strip_roll' do not have the unit of its value");
}

}  // namespace
}  // namespace hauberk::test
