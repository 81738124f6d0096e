/// Limits along components, through the whole program.

#include "document/json_text.hpp"
#include "result_files.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <functional>

namespace hauberk::test {
namespace {

namespace json = boost::json;
namespace fs = std::filesystem;

/// The threefold element with round tubes; it locks along a lattice direction at 0.06094808126411.
std::string threefold_text(const std::string& directions)
{
  return R"({
  "name": "boundary",
  "elements": {
    "threefold": { "shape": "torus_union",
      "tori": [
        { "name": "centre" },
        { "name": "side_270", "group": "side", "position": { "direction_deg": -90, "distance": ["centre.R", "side.R"] }, "axis": "tangential" },
        { "name": "side_30", "group": "side", "position": { "direction_deg": 30, "distance": ["centre.R", "side.R"] }, "axis": "tangential" },
        { "name": "side_150", "group": "side", "position": { "direction_deg": 150, "distance": ["centre.R", "side.R"] }, "axis": "tangential" } ],
      "parameters": { "centre.R": 4.25, "centre.r0": 0.95, "centre.r1": 0.95, "side.R": 2.575, "side.r0": 0.95, "side.r1": 0.95 } } },
  "cell": { "vectors": [[9.59123136, 5.5375], [0, 11.075]], "place": [ { "element": "threefold", "position": [0, 0, 0] } ] },
  "load_case": { "plugin": "in_plane_periodic", "directions": )" +
         directions + R"( },
  "solver": { "preset": "accurate" }
})";
}

constexpr const char* three = "[[0, 2, 0], [0, -1, 0], [0.3, -0.5, 0.2]]";

class Boundary : public ::testing::Test {
 protected:
  static void SetUpTestSuite()
  {
    folder_ = std::make_unique<WorkFolder>();
    file_ = folder_->write("b.json", threefold_text("{ \"sphere\": 1 }"));
    run_ = run_program({"run", file_, "-o", *folder_ / "out"});
    ASSERT_EQ(run_.code, 0) << run_.out << run_.err;
    results_ = read_results(*folder_ / "out");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static Outcome verify(const json::value& results)
  {
    const WorkFolder folder;
    return run_program({"verify", folder.write("results.json", write_json(results))});
  }

  static void expect_caught(const std::string& message, const std::function<void(json::value&)>& tamper)
  {
    json::value results = results_;
    tamper(results);
    const Outcome o = verify(results);
    EXPECT_EQ(o.code, 1);
    EXPECT_NE(o.out.find(message), std::string::npos) << "missing: " << message << '\n' << o.out;
  }

  static inline std::unique_ptr<WorkFolder> folder_;
  static inline std::string file_;
  static inline Outcome run_;
  static inline json::value results_;
};

TEST_F(Boundary, LeavesTableSurfaceAndPicture)
{
  EXPECT_EQ(results_.at("limits").as_array().size(), 12U);
  EXPECT_TRUE(results_.at("profiles").as_array().empty());
  EXPECT_EQ(results_.at_pointer("/files/boundary").as_string(), "boundary.ply");
  EXPECT_EQ(results_.at_pointer("/files/picture").as_string(), "boundary.svg");
  EXPECT_EQ(results_.at_pointer("/boundary/triangles").as_array().size(), 20U);
  EXPECT_TRUE(results_.at_pointer("/boundary/shortfalls").as_array().empty());
  EXPECT_EQ(results_.at_pointer("/plan/bounded/0/direction").as_array().size(), 3U);
  EXPECT_FALSE(fs::exists(*folder_ / "out/profile.svg"));
  const std::string ply = read_text(*folder_ / "out/boundary.ply");
  EXPECT_NE(ply.find("element vertex 12\n"), std::string::npos);
  EXPECT_NE(ply.find("element face 20\n"), std::string::npos);
  EXPECT_NE(read_text(*folder_ / "out/boundary.svg").find("<polygon "), std::string::npos);
  EXPECT_NE(run_.out.find("(0.850651, 0, 0.371748)"), std::string::npos) << run_.out;
}

TEST_F(Boundary, IsVerified)
{
  const Outcome o = verify(results_);
  EXPECT_EQ(o.code, 0) << o.out;
  EXPECT_NE(o.out.find("PASS boundary: 20 triangles; 0 limits fall short"), std::string::npos) << o.out;
}

TEST_F(Boundary, SpoiltValuesDirectionsAndSurfacesAreCaught)
{
  expect_caught("from macro", [](json::value& r) {
    r.at_pointer("/limits/3/value") = number_at(r, "/limits/3/value") * (1.0 + 1e-9);
  });
  // Another direction has another value and another load.
  expect_caught("from macro", [](json::value& r) { r.at_pointer("/limits/3/direction/2") = 0.4; });
  expect_caught("/limits/3/direction: not all zeros expected", [](json::value& r) {
    r.at_pointer("/limits/3/direction") = {0, 0, 0};
  });
  expect_caught("/limits/3/direction: three numbers expected", [](json::value& r) {
    r.at_pointer("/limits/3/direction") = {1, 0};
  });
  expect_caught("no limit along components has the index 12",
                [](json::value& r) { r.at_pointer("/boundary/triangles/0/0") = 12; });
  expect_caught("falls short of the state of 2 by 0.5 reported", [](json::value& r) {
    r.at_pointer("/boundary/shortfalls") = {{{"limit", 1}, {"state", 2}, {"by", 0.5}}};
  });
}

TEST_F(Boundary, AStateFurtherThanALimitMustBeNamed)
{
  expect_caught("falls short by", [](json::value& r) {
    // A nearer state that is consistent in itself is one of the others': that of the opposite direction.
    for (const char* key : {"macro", "poses", "contacts", "starts"})
      r.at_pointer("/limits/3").as_object()[key] = r.at_pointer("/limits/2").as_object()[key];
  });
}

TEST_F(Boundary, SameForAnyNumberOfThreadsAndResumed)
{
  const WorkFolder folder;
  ASSERT_EQ(run_program({"run", file_, "-o", folder / "one", "--threads", "1"}).code, 0);
  EXPECT_EQ(timeless(read_results(folder / "one")), timeless(results_));
  EXPECT_EQ(read_text(fs::path(folder / "one") / "boundary.ply"), read_text(*folder_ / "out/boundary.ply"));
  // Two limits as if they had not been done.
  json::value partial = read_results(folder / "one");
  for (const char* at : {"/limits/4", "/limits/7"}) {
    json::object& limit = partial.at_pointer(at).as_object();
    limit["status"] = "interrupted";
    limit["value"] = limit["macro"] = nullptr;
    for (const char* key : {"poses", "contacts", "starts"}) limit[key] = json::array{};
  }
  fs::remove_all(folder / "one");
  fs::create_directory(folder / "one");
  write_partial_results(folder / "one", partial);
  const Outcome o = run_program({"run", file_, "-o", folder / "one", "--resume"});
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  EXPECT_NE(o.err.find("finished limits are kept"), std::string::npos) << o.err;
  EXPECT_EQ(timeless(read_results(folder / "one")), timeless(results_));
  EXPECT_EQ(read_text(fs::path(folder / "one") / "boundary.ply"), read_text(*folder_ / "out/boundary.ply"));
}

TEST(BoundaryList, GivesTheLimitsOfAnglesAndLeavesNoFaces)
{
  const WorkFolder folder;
  const std::string file = folder.write("l.json", threefold_text(three));
  const Outcome o = run_program({"run", file, "-o", folder / "out"});
  ASSERT_EQ(o.code, 0) << o.out << o.err;
  const json::value r = read_results(folder / "out");
  EXPECT_NEAR(number_at(r, "/limits/0/value"), 0.06094808126411, 2e-9);
  EXPECT_NEAR(number_at(r, "/limits/0/macro/eyy"), 0.06094808126411, 2e-9);
  EXPECT_GT(number_at(r, "/limits/1/value"), 0.06) << "compression, along its direction";
  EXPECT_LT(number_at(r, "/limits/1/macro/eyy"), -0.06);
  EXPECT_NE(read_text(fs::path(folder / "out") / "boundary.ply").find("element face 0\n"), std::string::npos);
  EXPECT_EQ(run_program({"verify", folder / "out/results.json"}).code, 0);
  const Outcome plan = run_program({"plan", file});
  EXPECT_NE(plan.out.find("along attained: (0, 2, 0), (0, -1, 0), (0.3, -0.5, 0.2)\n"), std::string::npos)
      << plan.out;
}

/// A chain holds its own direction only: shear would be approached as the chain turns, were there no contact
/// on the way; spreading is unbounded.
TEST(BoundaryList, SaysWhichDirectionsLinksDoNotHold)
{
  const WorkFolder folder;
  // Neither tiny nor huge components lose their direction.
  const std::string text = with(with(chain_text(), R"("directions_deg": [0])",
                                     R"("directions": [[1e-320,0,0],[0,0,1],[1e300,1e300,0],[1,-1,0]])"),
                                R"(, "senses": ["stretch"])", "");
  const Outcome o = run_program({"run", folder.write("c.json", text), "-o", folder / "out"});
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  const json::value r = read_results(folder / "out");
  EXPECT_NEAR(number_at(r, "/limits/0/value"), 17.2 / 12.0 - 1.0, 1e-8);
  EXPECT_EQ(r.at_pointer("/limits/1/status").as_string(), "locked") << "links do not stop it, contact does";
  EXPECT_EQ(r.at_pointer("/limits/2/status").as_string(), "unbounded");
  EXPECT_EQ(r.at_pointer("/limits/3/status").as_string(), "locked");
  EXPECT_EQ(run_program({"verify", folder / "out/results.json"}).code, 0);
}

TEST(BoundaryList, CurvaturesHaveTheirOwnMetric)
{
  const WorkFolder folder;
  std::string text = threefold_text("[[1, 0, 0], [2, 2, 0]]");
  text = with(text, "in_plane_periodic", "paraboloid_bending");
  text = with(text, R"("vectors": [[9.59123136, 5.5375], [0, 11.075]])",
              R"("patch": { "vectors": [[9.59123136, 5.5375], [0, 11.075]], "outline": { "hexagon": 1 } })");
  text = with(text, R"("preset": "accurate")", R"("tolerance": 1e-3)");
  const Outcome o = run_program({"run", folder.write("p.json", text), "-o", folder / "out"});
  ASSERT_EQ(o.code, 0) << o.out << o.err;
  const json::value r = read_results(folder / "out");
  // A alone is half the curvature along x, whose load is 2 A; (1, 1, 0) is a bowl.
  EXPECT_EQ(number_at(r, "/limits/0/value"), number_at(r, "/limits/0/macro/A"));
  EXPECT_NEAR(number_at(r, "/limits/1/value"),
              (number_at(r, "/limits/1/macro/A") + number_at(r, "/limits/1/macro/B")) / std::sqrt(2.0),
              1e-15);
  EXPECT_EQ(run_program({"verify", folder / "out/results.json"}).code, 0);
}

TEST(BoundaryList, MistakesAreBadInput)
{
  const WorkFolder folder;
  const std::string file = folder.write("b.json", threefold_text("[[1, 0, 0], [0, 0, 0]]"));
  const Outcome o = run_program({"check", file, "--thorough"});
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("/load_case/directions/1: expected a direction, found all zeros"), std::string::npos)
      << o.err;
  EXPECT_EQ(run_program({"run", file, "-o", folder / "out"}).code, 2);
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(BoundaryList, RowsOfASweepTakeDirections)
{
  const WorkFolder folder;
  const std::string text = with(threefold_text(three), "\"solver\"", R"("task": "sweep",
  "sweep": { "vary": [ { "name": "r", "pointers": [{ "pointer": "/elements/threefold/parameters/side.r0" },
                                                    { "pointer": "/elements/threefold/parameters/side.r1" }],
                         "values": [0.9, 0.95] } ] },
  "solver")");
  const Outcome o = run_program({"run", folder.write("s.json", text), "-o", folder / "out"});
  ASSERT_EQ(o.code, 0) << o.out << o.err;
  const json::value r = read_results(folder / "out");
  const json::object& measured = r.at_pointer("/sweep/rows/1/measured").as_object();
  EXPECT_NEAR(measured.at("along (0, 2, 0)").as_double(), 0.06094808126411, 2e-9);
  EXPECT_EQ(run_program({"verify", folder / "out/results.json"}).code, 0);
}

}  // namespace
}  // namespace hauberk::test
