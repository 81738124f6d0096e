/// Reports of designs that are made up, so that every figure is known.

#include "report/report.hpp"

#include "document/json_text.hpp"
#include "results/document.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>

namespace hauberk {
namespace {

namespace json = boost::json;
using Row = std::map<std::string, std::string>;

/// A design of curvatures towards 0.02, 0.02, 0.04 and 0.04 in 0, 45, 90 and 135 degrees, which reached
/// 0.021, 0.02, 0.037 and nothing.
json::value made_up()
{
  json::value out = parse_json(R"({
  "format": "hauberk-results/2",
  "experiment": { "name": "bent|sheet", "task": "design", "length_unit": "mm",
    "load_case": { "plugin": "paraboloid_bending", "directions_deg": [0] }, "solver": { "clearance": 0.1 },
    "design": {
      "published": { "source": "a book", "iterations": 10, "seconds_per_iteration": 2.5 },
      "targets": [ { "direction_deg": 135, "value": 0.04 },
        { "direction_deg": -180, "value": 0.02, "published": 0.0215 },
        { "direction_deg": 45, "value": 0.02 },
        { "direction_deg": 90, "value": 0.04, "published": 0.042 } ] } },
  "provenance": { "threads": 2, "peak_memory_bytes": 30000000 },
  "scene": { "elements": [ { "parameters": { "ring.R": 5.1 } } ] },
  "limits": [], "profiles": [],
  "design": { "quantity": "curvature", "status": "converged", "iterations": 4, "evaluations": 1234567890123,
    "seconds": 9, "history": [ { "seconds": 1 }, { "seconds": 6 } ], "targets": [],
    "initial": { "limits": [] } }
})",
                               "made up");
  const std::vector<std::array<double, 3>> reached{
      {0, 0.02, 0.021}, {45, 0.02, 0.02}, {90, 0.04, 0.037}, {135, 0.04, 0}};
  for (const std::array<double, 3>& row : reached) {
    const double degrees = row[0], target = row[1], value = row[2];
    const json::value number = value > 0.0 ? json::value(value) : json::value(nullptr);
    out.at("design").at("targets").as_array().push_back({{"direction_deg", degrees},
                                                         {"target", target},
                                                         {"initial", 10.0 * target},
                                                         {"provisional", number},
                                                         {"recomputed", number},
                                                         {"better_state", degrees == 90},
                                                         {"met", degrees == 0}});
    const auto limit = [&](const json::value& x) {
      return json::object{{"direction_deg", degrees},
                          {"sense", "up"},
                          {"status", x.is_null() ? "stalled" : "locked"},
                          {"value", x},
                          {"better_state", false}};
    };
    out.at("limits").as_array().push_back(limit(number));
    out.at_pointer("/design/initial/limits").as_array().push_back(limit(10.0 * target));
    out.at("profiles")
        .as_array()
        .push_back({{"direction_deg", degrees}, {"e_s", number}, {"e_c", nullptr}, {"eta", nullptr}});
  }
  return out;
}

/// The limits of its scene, larger by 0.001 everywhere.
json::value recheck_of(json::value document)
{
  document.at("design") = nullptr;
  document.at_pointer("/experiment/task") = "limits";
  document.at_pointer("/experiment/load_case/directions_deg").as_array().push_back(45);
  for (json::value& point : document.at("profiles").as_array()) {
    json::value& e_s = point.at("e_s");
    if (!e_s.is_null()) e_s = e_s.as_double() + 0.001;
  }
  return document;
}

std::vector<Row> rows_of(const std::string& csv)
{
  std::istringstream lines(csv);
  std::vector<std::string> header;
  std::vector<Row> out;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream rest(line + ",");
    for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
    if (header.empty()) {
      header = cells;
      continue;
    }
    EXPECT_EQ(cells.size(), header.size()) << line;
    out.emplace_back();
    for (std::size_t k = 0; k < cells.size() && k < header.size(); ++k) out.back()[header[k]] = cells[k];
  }
  return out;
}

std::string message_of(const std::function<void()>& what)
{
  try {
    what();
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Report, FiguresOfADesign)
{
  const std::vector<ReportEntry> entries{read_report_entry(made_up(), "d/results.json")};
  const std::vector<Row> rows = rows_of(report_csv(entries));
  ASSERT_EQ(rows.size(), 6U) << "design, four directions, total";
  Row design = rows[0];
  EXPECT_EQ(design["row"], "design");
  EXPECT_EQ(design["unit"], "1/mm");
  // In parts of the mean target, 0.03; three directions have values, two of them published ones.
  EXPECT_EQ(design["values"], "3");
  EXPECT_NEAR(std::stod(design["rms_percent"]), 100.0 * std::sqrt((1e-6 + 9e-6) / 3.0) / 0.03, 1e-10);
  EXPECT_NEAR(std::stod(design["worst_percent"]), 10.0, 1e-10);
  EXPECT_EQ(design["published_values"], "2");
  EXPECT_NEAR(std::stod(design["rms_there_percent"]), 100.0 * std::sqrt((1e-6 + 9e-6) / 2.0) / 0.03, 1e-10);
  EXPECT_NEAR(std::stod(design["published_rms_percent"]), 100.0 * std::sqrt((2.25e-6 + 4e-6) / 2.0) / 0.03,
              1e-10);
  EXPECT_NEAR(std::stod(design["published_worst_percent"]), 100.0 * 0.002 / 0.03, 1e-10);
  EXPECT_EQ(design["rechecked_rms_percent"], "");
  EXPECT_EQ(design["targets_met"], "1");
  EXPECT_EQ(design["evaluations"], "1234567890123");
  EXPECT_EQ(design["seconds_per_iteration"], "1.5") << "of the search that gave the design";
  EXPECT_EQ(design["published_seconds"], "25");
  Row last = rows[4];
  EXPECT_EQ(last["recomputed"] + last["deviation"], "") << "no value";
  EXPECT_EQ(rows[1].at("published"), "0.0215") << "found at 0 degrees although it stands at -180";
  EXPECT_EQ(rows[3].at("better_state"), "true");
  Row total = rows[5];
  EXPECT_EQ(total["row"], "total");
  EXPECT_EQ(total["targets"] + " " + total["targets_met"] + " " + total["seconds"], "4 1 9");
}

TEST(Report, RangeThatIsPublishedBoundsTheDeviation)
{
  json::value document = made_up();
  json::object& published = document.at_pointer("/experiment/design/published").as_object();
  published["lowest"] = 0.01;
  published["highest"] = 0.041;
  const auto worst = [&document] {
    return std::stod(
        rows_of(report_csv(std::vector{read_report_entry(document, "d")}))[0]["published_worst_percent"]);
  };
  EXPECT_NEAR(worst(), 100.0 * 0.002 / 0.03, 1e-10) << "targets differ: a range says nothing";
  for (json::value& target : document.at_pointer("/design/targets").as_array()) target.at("target") = 0.03;
  EXPECT_NEAR(worst(), 100.0 * 0.02 / 0.03, 1e-10);
}

/// A bound that is kept has no deviation, one that is broken has the difference, in the table, its sums and
/// the text.
TEST(Report, BoundsThatAreKeptHaveNoDeviation)
{
  json::value document = made_up();
  json::array& targets = document.at_pointer("/design/targets").as_array();
  targets[0].as_object()["aim"] = "no_further";  // 0.021 for 0.02
  targets[2].as_object()["aim"] = "no_further";  // 0.037 for 0.04
  const std::vector entries{read_report_entry(document, "d")};
  const std::vector<Row> rows = rows_of(report_csv(entries));
  EXPECT_EQ(rows[1].at("aim"), "no_further");
  EXPECT_EQ(rows[2].at("aim"), "reach");
  EXPECT_NEAR(std::stod(rows[1].at("deviation")), 0.001, 1e-12);
  EXPECT_EQ(std::stod(rows[3].at("deviation")), 0.0);
  EXPECT_NEAR(std::stod(rows[0].at("rms_percent")), 100.0 * std::sqrt(1e-6 / 3.0) / 0.03, 1e-10);
  const std::string text = report_text(entries);
  EXPECT_NE(text.find("| 0.02 or nearer |"), std::string::npos) << text;
  EXPECT_EQ(text.find("-7.50"), std::string::npos)
      << "what 90 degrees would miss as a value to reach: " << text;
  targets[0].as_object()["aim"] = "sideways";
  EXPECT_THROW(read_report_entry(document, "d"), InputError);
}

TEST(Report, RecheckIsEnteredDirectionByDirection)
{
  std::vector<ReportEntry> entries{read_report_entry(made_up(), "d/results.json")};
  enter_recheck(entries[0], recheck_of(made_up()), "d/recheck/results.json");
  const std::vector<Row> rows = rows_of(report_csv(entries));
  EXPECT_EQ(std::stod(rows[1].at("rechecked")), 0.021 + 0.001);
  EXPECT_NEAR(std::stod(rows[3].at("recheck_change")), 0.001, 1e-12);
  EXPECT_EQ(rows[4].at("rechecked"), "");
  EXPECT_NEAR(std::stod(rows[0].at("recheck_worst_change_percent")), 100.0 / 30.0, 1e-10);
  EXPECT_NEAR(std::stod(rows[0].at("rechecked_rms_percent")),
              100.0 * std::sqrt((4e-6 + 1e-6 + 4e-6) / 3.0) / 0.03, 1e-10);
}

TEST(Report, RecheckOfAnotherSceneIsRefused)
{
  const std::string refused =
      "r: these are no limits of the scene that d designed; run the designed.json beside it anew, with the "
      "same load case and clearance";
  ReportEntry entry = read_report_entry(made_up(), "d");
  json::value other = recheck_of(made_up());
  other.at_pointer("/scene/elements/0/parameters/ring.R") = 5.2;
  EXPECT_EQ(message_of([&] { enter_recheck(entry, other, "r"); }), refused);
  other = recheck_of(made_up());
  other.at_pointer("/experiment/solver/clearance") = 0.0;
  EXPECT_EQ(message_of([&] { enter_recheck(entry, other, "r"); }), refused);
  EXPECT_EQ(message_of([&] { enter_recheck(entry, made_up(), "r"); }), refused) << "a design";
  EXPECT_FALSE(entry.design->rechecked);
  ReportEntry limits = read_report_entry(recheck_of(made_up()), "l");
  EXPECT_EQ(message_of([&] { enter_recheck(limits, recheck_of(made_up()), "r"); }),
            "r: l is no design: there is nothing to recheck");
}

TEST(Report, TextHasTablesWhoseRowsAreWhole)
{
  const ReportEntry design = read_report_entry(made_up(), "a/results.json");
  ReportEntry same = design;
  same.file = "b/results.json";
  const ReportEntry limits = read_report_entry(recheck_of(made_up()), "c/results.json");
  const std::string text = report_text(std::vector{design, same, limits});
  EXPECT_NE(text.find("## bent\\|sheet (a/results.json)\n"), std::string::npos) << "names that occur twice";
  EXPECT_NE(text.find("| 90        |   0.04 |     0.042 |     0.4 |       0.037 |     0.037\u2020 |          "
                      "        -7.50 |"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("| 135       | stalled |    - |\n"), std::string::npos)
      << "limits say why there is none";
  EXPECT_NE(text.find("The 2 designs with published times: 18 s here, 50 s published.\n"), std::string::npos);
  std::istringstream lines(text);
  std::size_t tables = 0, bars = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("|")) {
      bars = 0;
      continue;
    }
    std::size_t found = 0;
    for (std::size_t k = 0; k < line.size(); ++k)
      found += line[k] == '|' && (k == 0 || line[k - 1] != '\\') ? 1 : 0;
    tables += bars == 0 ? 1 : 0;
    if (bars == 0) bars = found;
    EXPECT_EQ(found, bars) << line;
  }
  EXPECT_EQ(tables, 5U) << "deviations, costs, two designs, limits";
}

TEST(Report, PublishedProfileAndMeasuredRangesAreDrawnBehindOurs)
{
  json::value document = made_up();
  json::object& published = document.at_pointer("/experiment/design/published").as_object();
  published["profile"] = json::array{{0, 0.02}, {20, 0.03}, {40, 0.02}};
  published["measured"] = json::array{{0, 0.01, 0.02}, {90, 0.02, 0.05}};
  const std::string svg = report_svg(std::vector{read_report_entry(document, "d")});
  const auto count = [&svg](const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = svg.find(what); at != std::string::npos; at = svg.find(what, at + what.size())) ++n;
    return n;
  };
  EXPECT_EQ(count("stroke-dasharray=\"1.5,3\""), 3U) << "both halves of the profile, and the legend";
  EXPECT_EQ(count("stroke=\"#2e8b57\""), 3U * 5U)
      << "two ranges twice and the legend, a bar with two ends each";
  EXPECT_LT(svg.find("stroke-dasharray=\"1.5,3\""), svg.find("fill=\"#c00000\"")) << "behind the targets";

  published["measured"] = json::array{{0, 0.01}};
  EXPECT_THROW(read_report_entry(document, "d"), InputError);
}

TEST(Report, PageHasAPanelForEachResult)
{
  std::vector<ReportEntry> entries(4, read_report_entry(made_up(), "d"));
  const std::string svg = report_svg(entries);
  const auto count = [&svg](const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = svg.find(what); at != std::string::npos; at = svg.find(what, at + what.size())) ++n;
    return n;
  };
  EXPECT_EQ(count(">bent|sheet (d)</text>"), 4U);
  EXPECT_EQ(count(">published</text>"), 4U);
  EXPECT_EQ(count("r=\"5.00\" fill=\"#c00000\""), 36U) << "four targets twice, and the legend";
  // Ten times as large as what matters: not a reason for another scale.
  EXPECT_EQ(count(">up, initial (beyond the scale: up to 0.4)</text>"), 4U);
  EXPECT_EQ(svg.find("<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"1290\""),
            svg.find("<svg "))
      << "three in a row";
  EXPECT_EQ(svg, report_svg(entries));
}

TEST(Report, InitialValuesThatFitAreDrawn)
{
  json::value document = made_up();
  for (json::value& limit : document.at_pointer("/design/initial/limits").as_array())
    limit.at("value") = 0.05;
  const std::string svg = report_svg(std::vector{read_report_entry(document, "d")});
  EXPECT_EQ(svg.find("beyond the scale"), std::string::npos);
  EXPECT_NE(svg.find(">up, initial</text>"), std::string::npos);
}

TEST(Report, WhatIsNoResultIsRefusedWithItsPlace)
{
  const auto refused = [](const std::string& pointer, const json::value& value) {
    json::value document = made_up();
    document.at_pointer(pointer) = value;
    return message_of([&] { read_report_entry(document, "f"); });
  };
  EXPECT_EQ(message_of([] { read_report_entry(json::array{1}, "f"); }),
            "f: these are no results; give the results.json that `hauberk run` wrote, or its folder");
  EXPECT_EQ(refused("/format", "hauberk-results/9"),
            "f: /format: expected hauberk-results/2, found hauberk-results/9; give the results.json that "
            "`hauberk run` wrote, or its folder");
  EXPECT_EQ(refused("/experiment/task", "sweep"),
            "f: a report shows designs and limits, and these are results of task sweep; leave them out: "
            "their folder has a table and a picture of their own");
  const std::string way_out = "; give a results.json as `hauberk run` wrote it";
  EXPECT_EQ(refused("/design", nullptr), "f: 'design' is missing" + way_out);
  EXPECT_EQ(refused("/design/targets/1/target", "big"),
            "f: /design/targets/1/target: expected a number, found a string" + way_out);
  EXPECT_EQ(refused("/design/iterations", 1e300),
            "f: /design/iterations: expected an integer, found a number" + way_out);
  EXPECT_EQ(refused("/profiles", 3), "f: /profiles: expected an array, found a number" + way_out);
  EXPECT_EQ(refused("/experiment/load_case", true),
            "f: /experiment/load_case: expected an object, found true or false" + way_out);
  EXPECT_EQ(refused("/limits/0/status", "lost"), "f: /limits/0/status: 'lost' is no status of a limit");
}

}  // namespace
}  // namespace hauberk
