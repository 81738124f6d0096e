/// Charts checked: their results from the file alone, and their mistakes before anything is run.

#include "chart_fixture.hpp"
#include "document/json_text.hpp"

#include <boost/json/object.hpp>

#include <algorithm>

namespace hauberk::test {
namespace {

namespace json = boost::json;

class ChartCheck : public ChartFixture {};

TEST_F(ChartCheck, IsVerifiedFromTheFile)
{
  const Outcome good = run_program({"verify", *folder_ / "out"});
  EXPECT_EQ(good.code, 0) << good.out;
  EXPECT_TRUE(holds(good.out, "PASS /chart: 14 points, as asked for\n"));
  EXPECT_TRUE(holds(good.out, "PASS /chart/points/0 (chain, nearest, 0.01): error 0.000435"));
  EXPECT_TRUE(holds(good.out, "NONE /chart/points/8 (chain, arc, hasty): failed, no error\n"));
  const auto after = [&](const std::string& pointer, const json::value& value) {
    json::value wrong = results_;
    wrong.at_pointer(pointer) = value;
    const WorkFolder folder;
    const Outcome o = run_program({"verify", folder.write("results.json", write_json(wrong))});
    EXPECT_EQ(o.code, 1) << pointer;
    return o.out;
  };
  const auto changed = [&](const std::string& pointer, double factor) {
    return after(pointer, number_at(results_, pointer) * factor);
  };
  const std::string first = "FAIL /chart/points/0 (chain, nearest, 0.01): ";
  EXPECT_TRUE(holds(changed("/chart/points/0/error", 1.0 + 1e-9), first + "error "));
  EXPECT_TRUE(holds(changed("/chart/points/0/values/0", 1.0 + 1e-12), first + "error "));
  EXPECT_TRUE(holds(after("/chart/points/0/error", nullptr), first + "error null reported"));
  EXPECT_TRUE(holds(changed("/chart/points/0/seconds/median", 1.5), first + "seconds/median "));
  EXPECT_TRUE(holds(changed("/chart/points/0/seconds/runs/0", 1e3), first + "seconds/m"));
  EXPECT_TRUE(holds(after("/chart/points/0/seconds/runs", json::array{1.0}), first + "1 runs, 2 expected"));
  EXPECT_TRUE(holds(after("/chart/points/0/pareto_work", !point(results_, 0).at("pareto_work").as_bool()),
                    first + "pareto_work is wrong"));
  EXPECT_TRUE(holds(after("/chart/points/0/pareto", !point(results_, 0).at("pareto").as_bool()),
                    first + "pareto is wrong"));
  EXPECT_TRUE(
      holds(changed("/chart/points/1/evaluations", 1.5), "not what /chart/points/0 gave with 1 threads"));
  EXPECT_TRUE(holds(changed("/chart/scenes/0/exact/0", 1.0 + 1e-9), "/chart/scenes/0/exact: not what"));
  EXPECT_TRUE(holds(changed("/chart/scenes/1/exact/0", 1.0 + 1e-9), "/chart/scenes/1/exact: not what"));
  EXPECT_TRUE(holds(changed("/chart/scenes/1/floor", 2.0), "/chart/scenes/1/floor: "));
  EXPECT_TRUE(holds(after("/chart/points/8/status", "done"), "counts/done: 13 expected, found 12"));
  EXPECT_TRUE(holds(after("/chart/points/8/status", "done"), "done, but without an error"));
  EXPECT_TRUE(holds(after("/chart/points/3/method", "arc"), "points/3: 'chain' by 'nearest' with 2 threads"));
  EXPECT_TRUE(holds(after("/chart/points/2/setting", "0.01"), "points/2: the same as points/0"));
  EXPECT_TRUE(holds(after("/chart/points", json::array{}), "points: 14 expected, found 0"));
  EXPECT_TRUE(holds(after("/chart", json::object{}), "FAIL /chart"));
}

TEST(ChartInput, MistakesOfTheFileAreBadInput)
{
  const WorkFolder folder;
  const auto errors = [&](const std::string& from, const std::string& to) {
    const Outcome o =
        run_program({"check", folder.write("c.json", with(chart_text(), from, to)), "--thorough"});
    EXPECT_EQ(o.code, 2) << o.out;
    return o.err;
  };
  EXPECT_TRUE(holds(errors("\"exact\": 0.43333333333333335", "\"exact\": [0.4, 0.4]"),
                    "c.json:16: /chart/scenes/0/exact: expected 1 exact values, one per limit, found 2\n"));
  EXPECT_TRUE(
      holds(errors(R"({ "/solver/contact": "arc" })", R"({ "/load_case/directions_deg": [30] })"),
            "c.json:22: /chart/methods/1: method 'arc' has other limits than scene 'chain': it may set how "
            "they are found, not which they are\n"));
  EXPECT_TRUE(
      holds(errors("\"/elements/link/parameters/ring.r0\": 0.6", "\"/elements/link/parameters/ring.r0\": 6"),
            "c.json:17: /chart/scenes/1: scene 'thin, both ways': /elements/link/parameters"));
  const std::string wrong = errors(R"({ "/solver/contact": "arc" })", R"({ "/solver/contact": "ark" })");
  EXPECT_TRUE(
      holds(wrong, "scene 'chain', method 'arc', setting 'coarse': expected one of auto, nearest, arc"));
  EXPECT_EQ(std::count(wrong.begin(), wrong.end(), '\n'), 1) << "once, not for every setting:\n" << wrong;
  const Outcome good = run_program({"check", folder.write("c.json", chart_text()), "--thorough"});
  EXPECT_EQ(good.out, folder / "c.json: no problems; 2 scenes, 2 methods, 14 points of 2 runs\n");
}

TEST(ChartInput, RefusedPointsAndFailedReferencesSaySo)
{
  const WorkFolder folder;
  // The reference stalls; a method whose clearance leaves no room at rest is refused.
  const std::string file = folder.write(
      "c.json", with(with(chart_text(),
                          R"("reference": { "set": { "/solver/contact": "arc", "/solver/tolerance": 1e-8 })",
                          R"("reference": { "set": { "/solver/max_iterations": 1 })"),
                     R"("set": { "/solver/contact": "arc" })", R"("set": { "/solver/clearance": 4.5 })"));
  const Outcome o = run_program({"run", file, "-o", folder / "out", "--set", "/expect=[]"});
  EXPECT_EQ(o.code, 1) << "without its reference a scene says nothing";
  const json::value r = read_results(folder / "out");
  EXPECT_EQ(text(r.at_pointer("/chart/scenes/1/reference/status")), "failed");
  EXPECT_TRUE(r.at_pointer("/chart/scenes/1/exact").is_null());
  EXPECT_TRUE(holds(text(point(r, 10).at("message")),
                    "nothing to compare with: the reference failed: stretch at 0 degrees stalled"));
  EXPECT_TRUE(point(r, 10).at("seconds").is_null()) << "not solved in vain";
  EXPECT_EQ(text(point(r, 4).at("status")), "refused");
  EXPECT_TRUE(point(r, 4).at("seconds").is_null());
  EXPECT_EQ(number_at(r, "/chart/counts/refused"), 6.0);
  const Outcome verified = run_program({"verify", folder / "out"});
  EXPECT_EQ(verified.code, 0) << verified.out;
  EXPECT_EQ(run_program({"run", file, "-o", folder / "out", "--set", "/expect=[]", "--resume"}).code, 1);
}

}  // namespace
}  // namespace hauberk::test
