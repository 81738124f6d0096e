/// Preset `paper`: the published method from the experiment file to the results.

#include "document/json_text.hpp"
#include "program.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <boost/json/object.hpp>

namespace hauberk::test {
namespace {

namespace json = boost::json;

/// The chain of two rings (R 5, r 0.7 mm; period 12, locked at 17.2), its numbers in `unit`.
std::string chain_in(const std::string& unit, double per_mm, const std::string& solver)
{
  const auto n = [per_mm](double mm) { return fmt::format("{:.17g}", mm * per_mm); };
  return fmt::format(
      R"({{ "name": "chain", "length_unit": "{}",
  "elements": {{ "link": {{ "shape": "torus_union",
    "tori": [ {{ "name": "ring", "position": [0, 0, 0], "axis": [0, 0, 1] }} ],
    "parameters": {{ "ring.R": {}, "ring.r0": {}, "ring.r1": {} }} }} }},
  "cell": {{ "vectors": [[{}, 0], [0, {}]],
    "place": [ {{ "element": "link", "position": [0, 0, 0] }},
      {{ "element": "link", "position": [{}, 0, 0], "rotation": {{ "axis": [1, 0, 0], "degrees": 90 }} }} ] }},
  "load_case": {{ "plugin": "in_plane_periodic", "directions_deg": [0], "senses": ["stretch"], "measure": "equation_12", "hold": [] }},
  "solver": {{ {} }} }})",
      unit, n(5.0), n(0.7), n(0.7), n(12.0), n(100.0), n(6.0), solver);
}

json::value run_chain(const std::string& unit, double per_mm, const std::string& solver,
                      const std::vector<std::string>& more = {})
{
  const WorkFolder folder;
  std::vector<std::string> arguments{"run", folder.write("c.json", chain_in(unit, per_mm, solver)), "-o",
                                     folder / "out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome o = run_program(arguments);
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  const Outcome verified = run_program({"verify", (folder.path() / "out/results.json").string()});
  EXPECT_EQ(verified.code, 0) << verified.out;
  return read_results(folder / "out");
}

TEST(Paper, ChainLocksWithinTheActivationDistance)
{
  const json::value r = run_chain("mm", 1.0, R"("preset": "paper")");
  EXPECT_EQ(r.at_pointer("/limits/0/status").as_string(), "locked");
  EXPECT_EQ(r.at_pointer("/limits/0/contact").as_string(), "published");
  EXPECT_EQ(number_at(r, "/limits/0/finite_target"), 10.0);
  // Two contacts a period, each open by less than the published 0.1 mm, and as far as reported.
  const double period = 12.0 * (1.0 + number_at(r, "/limits/0/value"));
  const double gap = number_at(r, "/limits/0/min_gap");
  EXPECT_GT(period, 17.2 - 2.0 * 0.1);
  EXPECT_LT(period, 17.2);
  EXPECT_GT(gap, 0.0);
  EXPECT_NEAR(period, 17.2 - 2.0 * gap, 0.05 * gap);
  // The path was not certified, and says so.
  const std::string certificate(r.at_pointer("/limits/0/certificate").as_string());
  EXPECT_NE(certificate.find("nothing certified"), std::string::npos) << certificate;
}

TEST(Paper, ThresholdsAreAbsoluteLengths)
{
  const double mm = number_at(run_chain("mm", 1.0, R"("preset": "paper")"), "/limits/0/value");
  EXPECT_NEAR(number_at(run_chain("m", 1e-3, R"("preset": "paper")"), "/limits/0/value"), mm, 1e-9);
  EXPECT_NEAR(number_at(run_chain("um", 1e3, R"("preset": "paper")"), "/limits/0/value"), mm, 1e-9);
  // A chain ten times larger, the same 0.1 mm: its gaps are smaller parts of it.
  const double large = number_at(run_chain("mm", 10.0, R"("preset": "paper")"), "/limits/0/value");
  EXPECT_GT(large, mm + 1e-5);
}

TEST(Paper, PartsCanBeChosenOneByOne)
{
  const std::string certified = R"("preset": "paper", "ccd": "certified", "closest_points": "certified")";
  const json::value a = run_chain("mm", 1.0, certified);
  const json::value b = run_chain("mm", 1.0, R"("preset": "paper")");
  EXPECT_NEAR(number_at(a, "/limits/0/value"), number_at(b, "/limits/0/value"), 1e-8);
  const json::value c = run_chain("mm", 1.0, R"("preset": "accurate", "contact": "published")");
  EXPECT_EQ(c.at_pointer("/limits/0/contact").as_string(), "published");
  EXPECT_FALSE(c.at_pointer("/limits/0").as_object().contains("finite_target"));
  EXPECT_NEAR(number_at(c, "/limits/0/value"), 17.2 / 12.0 - 1.0, 1e-8);
}

TEST(Paper, SameResultsForAnyNumberOfThreads)
{
  const std::string solver = R"("preset": "paper", "starts": 3)";
  EXPECT_EQ(write_json(timeless(run_chain("mm", 1.0, solver, {"--threads", "1"}))),
            write_json(timeless(run_chain("mm", 1.0, solver, {"--threads", "2"}))));
}

TEST(Paper, WhatItCannotDoIsRefused)
{
  const WorkFolder folder;
  const auto refusal = [&](const std::string& text) {
    const std::string file = folder.write("bad.json", text);
    const Outcome o = run_program({"check", file, "--thorough"});
    EXPECT_EQ(o.code, 2);
    return o.err.substr(file.size());
  };
  EXPECT_EQ(
      refusal(chain_in("um", 1.0, R"("preset": "paper")")),
      ":9: /solver/preset: the activation distance of preset 'paper' is 0.1 mm, 20 times the median ring "
      "radius of this scene; expected 1e-11 .. 0.1: use preset accurate, or correct length_unit\n");
  EXPECT_EQ(
      refusal(chain_in("mm", 1.0, R"("closest_points": "sampled")")),
      ":9: /solver/closest_points: sampled closest points belong to contact 'published'; remove this or "
      "choose that contact\n");
  EXPECT_EQ(refusal(with(design_text(), R"("tolerance": 1e-3)", R"("preset": "paper")")),
            ":12: /solver/preset: preset 'paper' computes limits only in this version; use accurate for a "
            "design\n");
}

}  // namespace
}  // namespace hauberk::test
