/// Task design through the program.

#include "document/json_text.hpp"
#include "program.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;
namespace json = boost::json;

TEST(Design, MovesTheLimitToItsTarget)
{
  const WorkFolder folder;
  const std::string file = folder.write("mail.json", design_text());
  const std::string out = folder / "out";
  const Outcome o = run_program({"run", file, "-o", out});
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  const json::value r = read_results(out);
  const json::value& d = r.at("design");
  EXPECT_LT(number_at(d, "/objective"), 0.5 * number_at(d, "/objective_initial"));
  EXPECT_TRUE(d.at_pointer("/targets/0/met").as_bool());
  // Targets first, then the directions of the profile that are not among them.
  EXPECT_EQ(number_at(d, "/targets/0/recomputed"), number_at(r, "/limits/0/value"));
  EXPECT_EQ(number_at(d, "/targets/0/initial"), number_at(r, "/design/initial/limits/0/value"));
  EXPECT_EQ(r.at("limits").as_array().size(), 3U);
  EXPECT_EQ(d.at_pointer("/initial/limits").as_array().size(), 3U);
  // The scene has the variables' values.
  EXPECT_EQ(number_at(r, "/scene/elements/2/parameters/ring.R"), number_at(d, "/variables/0/final"));
  EXPECT_EQ(number_at(d, "/variables/0/initial"), 4.9);
  EXPECT_GE(d.at("history").as_array().size(), 2U);
  EXPECT_NE(o.out.find("Design of stretch: "), std::string::npos) << o.out;
  EXPECT_EQ(run_program({"verify", out + "/results.json"}).code, 0);

  // The designed scene is an experiment that gives the same limits.
  const Outcome again = run_program({"run", out + "/designed.json", "-o", folder / "again"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NEAR(number_at(read_results(folder / "again"), "/limits/0/value"), number_at(r, "/limits/0/value"),
              1e-3);
}

TEST(Design, OfAWeaveThatIsAlsoSweptRunsByItself)
{
  const WorkFolder folder;
  const std::string file = folder.write("w.json", R"({ "name": "w", "task": "design",
  "cell": { "weave": { "name": "chain", "parameters": { "inner_diameter": 8 } } },
  "load_case": { "plugin": "in_plane_periodic", "directions_deg": [0], "senses": ["stretch"] },
  "design": { "quantity": "stretch", "optimizer": { "plugin": "sqp", "max_iterations": 1 },
    "variables": [{ "parameters": "ring.R", "lower": 4, "upper": 5 }],
    "targets": [{ "direction_deg": 0, "value": 0.4 }] },
  "sweep": { "vary": [{ "name": "inner diameter", "pointers": ["/cell/weave/parameters/inner_diameter"],
                        "values": [7, 8] }] } })");
  const Outcome o = run_program({"run", file, "-o", folder / "out"});
  ASSERT_EQ(o.code, 0) << o.out << o.err;
  const Outcome again = run_program({"run", folder / "out/designed.json", "-o", folder / "again"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_NEAR(number_at(read_results(folder / "again"), "/limits/0/value"),
              number_at(read_results(folder / "out"), "/limits/0/value"), 1e-6);
}

/// The wire of threefold elements moves both their limits.
class DesignBounds : public ::testing::TestWithParam<const char*> {};

TEST_P(DesignBounds, MoveWhatBreaksThemAndNothingElse)
{
  constexpr double wire = 0.95;
  const WorkFolder folder;
  const std::string sense = GetParam();
  const auto designed = [&](const std::string& name, double bound, const std::string& aim) {
    const std::string file =
        folder.write(name + ".json", fmt::format(R"({{ "extends": "{0}/threefold_round.json",
  "name": "bound", "task": "design", "load_case": {{ "directions_deg": [90], "senses": ["{1}"] }},
  "solver": {{ "starts": 2, "lessons": false }},
  "design": {{ "quantity": "{1}", "tolerance": 0.001, "perturbation": 0,
    "variables": [{{ "parameters": ["centre.r0", "centre.r1", "side.r0", "side.r1"], "tied": true, "per": "all",
                     "lower": 0.85, "upper": 1.05 }}],
    "targets": [{{ "direction_deg": 90, "value": {2}, "aim": "{3}" }}] }} }})",
                                                 HAUBERK_SOURCE_DIR "/share/experiments", sense, bound, aim));
    const std::string out = folder / name;
    const Outcome o = run_program({"run", file, "-o", out});
    EXPECT_EQ(o.code, 0) << o.out << o.err;
    const Outcome checked = run_program({"verify", out});
    EXPECT_EQ(checked.code, 0) << checked.out;
    json::value results = read_results(out);
    EXPECT_TRUE(results.at_pointer("/design/targets/0/met").as_bool()) << o.out;
    EXPECT_EQ(results.at_pointer("/design/targets/0/aim").as_string(), aim);
    return results;
  };
  const json::value kept = designed("kept", sense == "stretch" ? 0.9 : -0.9, "no_further");
  EXPECT_EQ(number_at(kept, "/design/variables/0/final"), wire) << "a bound that is kept moves nothing";
  EXPECT_EQ(number_at(kept, "/design/objective"), 0.0);
  const double free = number_at(kept, "/design/targets/0/recomputed");
  for (const double share : {0.9, 1.1}) {
    const double bound = share * free;
    const std::string broken = share < 1.0 ? "no_further" : "no_nearer",
                      whole = share < 1.0 ? "no_nearer" : "no_further";
    const json::value moved = designed(fmt::format("moved_{}", share), bound, broken);
    // Limits are nearer at the stages that the search begins with, so that it may go beyond what it must not
    // fall short of.
    EXPECT_NEAR(number_at(moved, "/design/targets/0/recomputed"), bound, 0.005 * std::abs(bound)) << broken;
    EXPECT_NE(number_at(moved, "/design/variables/0/final"), wire);
    const json::value same = designed(fmt::format("same_{}", share), bound, whole);
    EXPECT_EQ(number_at(same, "/design/variables/0/final"), wire) << whole;
  }
}

INSTANTIATE_TEST_SUITE_P(Senses, DesignBounds, ::testing::Values("stretch", "compress"));

/// Two bounds in one direction are of one limit, which is computed once, and end up on either side of it.
TEST(Design, ABandOfTwoBoundsIsKept)
{
  const WorkFolder folder;
  const auto text = [](const std::string& targets) {
    return fmt::format(R"({{ "extends": "{0}/threefold_round.json", "name": "band", "task": "design",
  "load_case": {{ "senses": ["stretch"] }}, "solver": {{ "starts": 2, "lessons": false }},
  "design": {{ "quantity": "stretch", "tolerance": 0.001, "perturbation": 0,
    "variables": [{{ "parameters": ["centre.r0", "centre.r1", "side.r0", "side.r1"], "tied": true, "per": "all",
                     "lower": 0.85, "upper": 1.05 }}],
    "targets": [{1}] }} }})",
                       HAUBERK_SOURCE_DIR "/share/experiments", targets);
  };
  const auto band = [](double nearest, double furthest) {
    return fmt::format(R"({{ "direction_deg": 90, "value": {}, "aim": "no_nearer" }},
      {{ "direction_deg": -90, "value": {}, "aim": "no_further" }})",
                       nearest, furthest);
  };
  const std::string out = folder / "free";
  ASSERT_EQ(run_program({"run", folder.write("free.json", text(band(0.001, 0.9))), "-o", out}).code, 0);
  const json::value free = read_results(out);
  ASSERT_EQ(free.at("limits").as_array().size(), 1U);
  EXPECT_EQ(number_at(free, "/design/objective"), 0.0);
  const double value = number_at(free, "/limits/0/value");
  EXPECT_EQ(number_at(free, "/design/targets/0/recomputed"), value);
  EXPECT_EQ(number_at(free, "/design/targets/1/recomputed"), value);
  for (const auto& [nearest, furthest] : {std::pair(0.8, 0.9), std::pair(1.1, 1.2)}) {
    const std::string moved = folder / fmt::format("moved_{}", nearest);
    const std::string file = folder.write("moved.json", text(band(nearest * value, furthest * value)));
    ASSERT_EQ(run_program({"run", file, "-o", moved}).code, 0);
    EXPECT_EQ(run_program({"verify", moved}).code, 0);
    const json::value r = read_results(moved);
    EXPECT_TRUE(r.at_pointer("/design/targets/0/met").as_bool());
    EXPECT_TRUE(r.at_pointer("/design/targets/1/met").as_bool());
    EXPECT_GT(number_at(r, "/limits/0/value"), 0.995 * nearest * value);
    EXPECT_LT(number_at(r, "/limits/0/value"), 1.005 * furthest * value);
  }
  const auto refusal = [&](const std::string& targets) {
    const Outcome o = run_program({"check", folder.write("bad.json", text(targets))});
    EXPECT_EQ(o.code, 2);
    return o.err;
  };
  EXPECT_NE(refusal(band(0.3, 0.2))
                .find("/design/targets/1/value: nothing is between the bounds of this "
                      "direction: no_nearer than 0.3 and no_further than 0.2"),
            std::string::npos);
  for (const char* third : {R"("value": 0.15)", R"("value": 0.15, "aim": "no_further")"})
    EXPECT_NE(refusal(band(0.1, 0.2) + fmt::format(R"(, {{ "direction_deg": 90, {} }})", third))
                  .find("/design/targets/2/direction_deg: direction 90 is given twice"),
              std::string::npos);
}

TEST(Design, ABoundOfZeroIsRefused)
{
  const WorkFolder folder;
  const std::string file = folder.write("mail.json", design_text());
  const Outcome o = run_program({"run", file, "-o", folder / "out", "--set",
                                 "/design/targets/0/aim=no_further", "--set", "/design/targets/0/value=0"});
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("expected a bound other than 0 for aim no_further; aim reach takes 0"),
            std::string::npos)
      << o.err;
}

TEST(Design, PlainValuesMoveTheLimitToItsTarget)
{
  const WorkFolder folder;
  const std::string file = folder.write("mail.json", design_text());
  ASSERT_EQ(run_program({"run", file, "-o", folder / "less"}).code, 0);
  ASSERT_EQ(run_program({"run", file, "-o", folder / "plain", "--set", "/design/value=plain"}).code, 0);
  const json::value less = read_results(folder / "less"), plain = read_results(folder / "plain");
  EXPECT_TRUE(plain.at_pointer("/design/targets/0/met").as_bool());
  // The search saw other values, and both limits are the target's to within a stage's bias.
  EXPECT_NE(number_at(plain, "/design/variables/0/final"), number_at(less, "/design/variables/0/final"));
  EXPECT_NEAR(number_at(plain, "/limits/0/value"), number_at(less, "/limits/0/value"), 3e-3);
}

TEST(Design, EachSearchEndsWithTheFirstIterateThatMeetsItsTargets)
{
  constexpr double tolerance = 0.02;
  const WorkFolder folder;
  const std::string file = folder.write("mail.json", design_text());
  ASSERT_EQ(run_program({"run", file, "-o", folder / "on"}).code, 0);
  ASSERT_EQ(run_program({"run", file, "-o", folder / "out", "--set", "/design/tolerance=0.02"}).code, 0);
  const json::value on = read_results(folder / "on"), r = read_results(folder / "out");
  const json::value& d = r.at("design");
  EXPECT_EQ(d.at("status").as_string(), "targets_met");
  EXPECT_NE(on.at_pointer("/design/status").as_string(), "targets_met");
  const json::array& history = d.at("history").as_array();
  EXPECT_LT(history.size(), on.at_pointer("/design/history").as_array().size());
  const double target = number_at(d, "/targets/0/target");
  int searches = 0;
  for (std::size_t k = 0; k < history.size(); ++k) {
    const bool last = k + 1 == history.size() || number_at(history[k + 1], "/step") == 0.0;
    const double value = number_at(history[k], "/values/0");
    EXPECT_EQ(std::abs(value - target) <= tolerance * target, last) << k << ": " << value;
    searches += last ? 1 : 0;
  }
  EXPECT_EQ(searches, 2);
  EXPECT_NEAR(number_at(d, "/targets/0/recomputed"), target, 2.0 * tolerance * target);
}

/// The values that a search ends with are those of the states that its limits are recomputed as, and it goes
/// on where a thorough look at its end finds others than those that it followed.
TEST(Design, EndsWithTheLimitsThatItsDesignHas)
{
  const WorkFolder folder;
  ASSERT_EQ(run_program({"run", HAUBERK_DESIGNS "/folds_further.json", "-o", folder / "out"}).code, 0);
  const json::value r = read_results(folder / "out");
  const json::value& d = r.at("design");
  // Values of designs leave the last stage's gaps out, to first order.
  EXPECT_NEAR(number_at(d, "/targets/0/provisional"), number_at(d, "/targets/0/recomputed"), 1e-4);
  const json::array& history = d.at("history").as_array();
  // The last search begins where the one before ended, with another value.
  std::size_t last = history.size() - 1;
  while (number_at(history[last], "/step") != 0.0) --last;
  ASSERT_GE(last, 2U);
  EXPECT_NEAR(number_at(d, "/targets/0/recomputed"), -0.0225, 1e-4);
  EXPECT_EQ(history[last].at("variables"), history[last - 1].at("variables"));
  EXPECT_LT(number_at(history[last], "/values/0"), number_at(history[last - 1], "/values/0") - 1e-3);
  EXPECT_FALSE(history[last].at("changed").as_array().empty());
  // Times are those of one search.
  const json::value timings = parse_json(read_text(folder.path() / "out/timings.json"), "timings");
  double before = 0.0;
  for (std::size_t k = 0; k < history.size(); ++k) {
    const double now = timings.at("seconds").at("/design/history/" + std::to_string(k)).to_number<double>();
    EXPECT_GE(now, before) << k;
    before = now;
  }
}

TEST(Design, SameResultsForAnyNumberOfThreads)
{
  const WorkFolder folder;
  const std::string file = folder.write("mail.json", design_text());
  std::string first;
  for (const char* n : {"1", "2", "5"}) {
    const std::string out = folder / (std::string("out") + n);
    ASSERT_EQ(run_program({"run", file, "-o", out, "--threads", n}).code, 0);
    const std::string text = write_json(timeless(read_results(out)));
    if (first.empty()) first = text;
    EXPECT_EQ(text, first);
  }
}

TEST(Design, AnInterruptLeavesTheBestSoFar)
{
  const WorkFolder folder;
  // So many starts that it cannot end before the signal.
  const std::string text =
      with(design_text(), R"("perturbation": 0,)", R"("starts": 100000, "perturbation": 0.1,)");
  Process process({"run", folder.write("mail.json", text), "-o", folder / "out", "--threads", "1"}, folder);
  const fs::path progress = folder.path() / "stderr";
  for (int k = 0; k < 2400 && read_text(progress).find("iteration 1,") == std::string::npos; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  process.signal(SIGINT);
  const Outcome o = process.wait();
  EXPECT_EQ(o.code, 130) << o.err;
  const json::value r = read_results(folder / "out");
  EXPECT_EQ(r.at_pointer("/design/status").as_string(), "interrupted");
  EXPECT_FALSE(r.at_pointer("/design/history").as_array().empty());
  EXPECT_NE(number_at(r, "/design/variables/0/final"), 4.9);
  EXPECT_EQ(number_at(r, "/scene/elements/0/parameters/ring.R"), number_at(r, "/design/variables/0/final"));
  // Nothing looks finished, and nothing is not a number.
  EXPECT_FALSE(fs::exists(folder.path() / "out" / "designed.json"));
  EXPECT_EQ(o.out.find("nan"), std::string::npos) << o.out;
  EXPECT_EQ(r.at_pointer("/files/best_so_far").as_string(), "best_so_far.json");
  EXPECT_EQ(run_program({"check", folder / "out/best_so_far.json", "--thorough"}).code, 0);
  // What the search cost is what its log says: lines of "E", the number of variables, the variables, the
  // cost.
  std::ifstream log(folder.path() / "out" / ".hauberk-evaluations");
  double cost = 0.0;
  for (std::string line; std::getline(log, line);) {
    std::istringstream words(line);
    std::string mark, word;
    std::size_t variables = 0;
    if (!(words >> mark >> variables) || mark != "E") continue;
    for (std::size_t k = 0; k <= variables; ++k) words >> word;
    cost += std::stod(word);
  }
  EXPECT_GT(cost, 0.0);
  EXPECT_EQ(number_at(r, "/design/evaluations"), cost);
}

}  // namespace
}  // namespace hauberk::test
