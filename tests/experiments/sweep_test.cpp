/// `hauberk run` of sweeps, from the file to a table.

#include "document/json_text.hpp"
#include "result_files.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;
namespace json = boost::json;

const json::value& row(const json::value& results, std::size_t k)
{
  return results.at_pointer("/sweep/rows").as_array().at(k);
}

std::string text(const json::value& v) { return std::string(v.as_string()); }

/// Rows with results, and those that are no scene.
constexpr std::size_t good_rows = 6, bad_rows = 3;

/// Two kinds of rings, the second half as large again as 5: its period is 2 (R_A + R_B - r_A - r_B).
TEST(SweepRun, ChainsFollowTheirFormula)
{
  const WorkFolder folder;
  const Outcome o = run_program({"run", folder.write("s.json", sweep_text()), "-o", folder / "out"});
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  const json::value r = read_results(folder / "out");
  ASSERT_EQ(r.at_pointer("/sweep/rows").as_array().size(), good_rows + bad_rows);
  std::size_t computed = 0;
  for (std::size_t k = 0; k < good_rows + bad_rows; ++k) {
    const json::value& x = row(r, k);
    const double R = number_at(x, "/values/R"), tube = number_at(x, "/values/r");
    if (R != 4.8 && R != 5.2) continue;
    ++computed;
    EXPECT_EQ(text(x.at("status")), "done");
    const double exact = 2.0 * (R + (0.5 * R + 2.5) - 2.0 * tube) / 12.0 - 1.0;
    EXPECT_NEAR(number_at(x, "/measured/stretch 0"), exact, 1e-9) << R << ' ' << tube;
    EXPECT_EQ(x.at_pointer("/result/limits/0/value"), x.at_pointer("/measured/stretch 0"));
    EXPECT_EQ(number_at(x, "/result/experiment/elements/b/parameters/ring.R"), 0.5 * R + 2.5);
  }
  EXPECT_EQ(computed, good_rows);
  EXPECT_EQ(number_at(r, "/sweep/counts/done"), good_rows);
  EXPECT_EQ(number_at(r, "/sweep/counts/refused"), bad_rows);
  EXPECT_NE(o.err.find("sweep: 9/9"), std::string::npos) << o.err;
  EXPECT_NE(o.out.find("all 1 expected results are met\n"), std::string::npos) << o.out;
}

/// A value that is varied carries with it everything that is made of it: the same rows as one pointer for
/// each.
TEST(SweepRun, NamedValuesAreVariedWithAllThatIsMadeOfThem)
{
  const WorkFolder folder;
  std::string text = with(sweep_text(), R"("cell": {)",
                          R"("values": { "R": 5, "r": 0.7, "other": "$R / 2 + 2.5" }, "cell": {)");
  const std::string sizes = R"("ring.R": 5.0, "ring.r0": 0.7, "ring.r1": 0.7)";
  for (const char* R : {"$R", "$other"})  // of a, then of b
    text.replace(text.find(sizes), sizes.size(),
                 std::string(R"("ring.R": ")") + R + R"(", "ring.r0": "$r", "ring.r1": "$r")");
  text = with(
      text,
      R"("/elements/a/parameters/ring.R", { "pointer": "/elements/b/parameters/ring.R", "factor": 0.5, "offset": 2.5 })",
      R"("/values/R")");
  text = with(
      text,
      R"("/elements/a/parameters/ring.r0", "/elements/a/parameters/ring.r1", "/elements/b/parameters/ring.r0", "/elements/b/parameters/ring.r1")",
      R"("/values/r")");
  const std::string file = folder.write("v.json", text), out = folder / "out";
  const Outcome o = run_program({"run", file, "-o", out});
  ASSERT_EQ(o.code, 0) << o.out << o.err;
  ASSERT_EQ(run_program({"run", folder.write("s.json", sweep_text()), "-o", folder / "plain"}).code, 0);
  const json::value r = read_results(out), plain = read_results(folder / "plain");
  for (std::size_t k = 0; k < good_rows + bad_rows; ++k) {
    EXPECT_EQ(row(r, k).at("measured"), row(plain, k).at("measured")) << k;
    EXPECT_EQ(row(r, k).at("status"), row(plain, k).at("status")) << k;
  }
  const Outcome verified = run_program({"verify", out});
  EXPECT_EQ(verified.code, 0) << verified.out;
  // The experiment in the results still knows what is made of what.
  EXPECT_EQ(r.at_pointer("/experiment/elements/b/parameters/ring.R").as_string(), "$other");
  const std::string kept = folder.write("kept.json", write_json(r.at("experiment")));
  ASSERT_EQ(run_program({"run", kept, "-o", folder / "kept"}).code, 0);
  const json::value kept_rows = read_results(folder / "kept");
  for (std::size_t k = 0; k < good_rows + bad_rows; ++k)
    EXPECT_EQ(row(kept_rows, k).at("measured"), row(r, k).at("measured")) << k;
}

TEST(SweepRun, BadRowsAreRowsWithAMessage)
{
  const WorkFolder folder;
  const std::string file = folder.write(
      "s.json",
      with(with(sweep_text(), R"([4.8, 5.2, 0.6])", R"([0.6, 5.0, 2, 5.6])"), "[0.5, 0.6, 0.7]", "[0.7]"));
  const Outcome checked = run_program({"check", file, "--thorough"});
  EXPECT_EQ(checked.out, file + ": no problems; 4 rows of 1 limits (1 refused as input)\n");
  ASSERT_EQ(run_program({"run", file, "-o", folder / "out", "--set", "/expect=[]"}).code, 0);
  const json::value r = read_results(folder / "out");
  EXPECT_EQ(text(row(r, 0).at("status")), "refused");
  EXPECT_NE(text(row(r, 0).at("message")).find("/elements/a/parameters"), std::string::npos)
      << "a tube thicker than the ring: " << row(r, 0).at("message");
  EXPECT_EQ(text(row(r, 1).at("status")), "done");
  EXPECT_NE(text(row(r, 2).at("message")).find("nothing is linked"), std::string::npos);
  EXPECT_NE(text(row(r, 3).at("message")).find("overlap at rest by"), std::string::npos);
  for (const std::size_t k : {0U, 2U, 3U}) {
    EXPECT_TRUE(row(r, k).at("result").is_null());
    EXPECT_TRUE(row(r, k).at_pointer("/measured/stretch 0").is_null());
  }
}

TEST(SweepRun, TableAndPicture)
{
  const WorkFolder folder;
  ASSERT_EQ(run_program({"run", folder.write("s.json", sweep_text()), "-o", folder / "out"}).code, 0);
  std::istringstream table(read_text(folder.path() / "out" / "sweep.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "R,r,status,stretch 0,evaluations,message");
  std::getline(table, line);
  EXPECT_TRUE(line.starts_with("4.8,0.5,done,0.4")) << line;
  const std::string picture = read_text(folder.path() / "out" / "sweep.svg");
  for (const char* label : {">r = 0.5<", ">r = 0.6<", ">r = 0.7<", ">stretch 0<", ">R<"})
    EXPECT_NE(picture.find(label), std::string::npos) << label;
  EXPECT_NE(picture.find("stroke-dasharray=\"8,4\""), std::string::npos) << "lines differ without colour";
  EXPECT_EQ(read_results(folder / "out").at_pointer("/files/sweep").as_string(), "sweep.csv");
}

/// What rows replace is not said of all of them.
TEST(SweepRun, PicturesNameNoSweptQuantityAbove)
{
  const WorkFolder folder;
  const auto picture = [&](const std::string& vary) {
    const std::string file = folder.write(
        "s.json",
        R"({ "name": "s", "task": "sweep", "length_unit": "mm", "cell": { "weave": { "name": "chain" } },
  "load_case": { "plugin": "in_plane_periodic", "directions_deg": [0], "senses": ["stretch"] },
  "values": { "gap": 0.05 }, "solver": { "clearance": "$gap" }, "sweep": { "vary": [ )" +
            vary + " ] } }");
    const Outcome ran = run_program({"run", file, "-o", folder / "out", "--force"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return read_text(folder.path() / "out" / "sweep.svg");
  };
  const std::string clearance =
      picture(R"({ "name": "gap", "pointers": ["/solver/clearance"], "values": [0, 0.1] })");
  EXPECT_NE(clearance.find(">in_plane_periodic, measure tensor<"), std::string::npos);
  const std::string measure =
      picture(R"({ "name": "m", "pointers": ["/load_case/measure"], "values": ["tensor", "equation_12"] })");
  EXPECT_NE(measure.find(">in_plane_periodic, clearance 0.05 mm<"), std::string::npos);
  const std::string unit =
      picture(R"({ "name": "unit", "pointers": ["/length_unit"], "values": ["mm", "m"] })");
  EXPECT_NE(unit.find(">in_plane_periodic, measure tensor<"), std::string::npos);
  const std::string value = picture(R"({ "name": "gap", "pointers": ["/values/gap"], "values": [0, 0.1] })");
  EXPECT_EQ(value.find("clearance"), std::string::npos);
  const std::string wire = picture(
      R"({ "name": "wire", "pointers": ["/cell/weave/parameters/wire_diameter"], "values": [1, 1.1] })");
  EXPECT_NE(wire.find(">in_plane_periodic, measure tensor, clearance 0.05 mm<"), std::string::npos);
}

TEST(SweepRun, ListsStandOnOneLine)
{
  const WorkFolder folder;
  const std::string file =
      folder.write("s.json", R"({ "name": "lists", "task": "sweep", "cell": { "weave": { "name": "chain" } },
  "load_case": { "plugin": "in_plane_periodic", "directions_deg": [0], "senses": ["stretch"] },
  "sweep": { "vary": [ { "name": "cells", "pointers": ["/cell/repeat"], "values": [[1, 1], [2, 1]] } ] } })");
  const Outcome o = run_program({"run", file, "-o", folder / "out"});
  ASSERT_EQ(o.code, 0) << o.err;
  std::istringstream lines(o.out);
  std::string line;
  std::size_t rows = 0;
  while (std::getline(lines, line)) {
    if (!line.ends_with(" done")) continue;
    ++rows;
    EXPECT_NE(line.find('['), std::string::npos) << o.out;
  }
  EXPECT_EQ(rows, 2U) << o.out;
}

TEST(SweepRun, SameResultsForAnyNumberOfThreads)
{
  const WorkFolder folder;
  const std::string file = folder.write("s.json", sweep_text());
  std::vector<std::string> texts;
  for (const char* n : {"1", "2", "5"}) {
    const std::string out = folder / (std::string("out") + n);
    ASSERT_EQ(run_program({"run", file, "-o", out, "--threads", n}).code, 0);
    texts.push_back(write_json(timeless(read_results(out))) + read_text(out + "/sweep.svg"));
  }
  EXPECT_EQ(texts[0], texts[1]);
  EXPECT_EQ(texts[0], texts[2]);
}

TEST(SweepRun, ResumesWhatIsMissing)
{
  const WorkFolder folder;
  const std::string file = folder.write("s.json", sweep_text()), out = folder / "out";
  ASSERT_EQ(run_program({"run", file, "-o", out}).code, 0);
  const json::value whole = read_results(out);
  json::value partial = whole;
  for (const char* k : {"1", "7"}) {
    json::value& missing = partial.at_pointer(std::string("/sweep/rows/") + k);
    missing.at("status") = "interrupted";
    missing.at("result") = nullptr;
  }
  // Marks a row that must not be computed again.
  partial.at_pointer("/sweep/rows/0/message") = "kept";
  write_partial_results(out, partial);
  const Outcome o = run_program({"run", file, "-o", out, "--resume"});
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  EXPECT_NE(o.err.find("resuming: finished rows are kept\n"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("sweep: 2/2"), std::string::npos) << o.err;
  json::value resumed = read_results(out);
  EXPECT_EQ(text(resumed.at_pointer("/sweep/rows/0/message")), "kept");
  resumed.at_pointer("/sweep/rows/0/message") = "";
  EXPECT_EQ(write_json(timeless(resumed)), write_json(timeless(whole)));
  EXPECT_EQ(run_program({"run", file, "-o", out, "--resume"}).out,
            out + "/results.json: complete already\nall 1 expected results are met\n");
}

TEST(SweepRun, InterruptKeepsWhatThereIs)
{
  const WorkFolder folder;
  // The second row is never done.
  const std::string file = folder.write(
      "s.json",
      with(
          with(
              sweep_text(),
              R"({ "name": "r", "pointers": ["/elements/a/parameters/ring.r0", "/elements/a/parameters/ring.r1", "/elements/b/parameters/ring.r0", "/elements/b/parameters/ring.r1"], "values": [0.5, 0.6, 0.7] })",
              R"({ "name": "starts", "pointers": ["/solver/starts"], "values": [1, 200000] })"),
          "[4.8, 5.2, 0.6]", "[5]"));
  const std::string out = folder / "out";
  Process process({"run", file, "-o", out, "--threads", "1", "--set", "/expect=[]"}, folder);
  for (int wait = 0; wait < 1200 && !fs::exists(out + "/results.json"); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  process.signal(SIGINT);
  const Outcome o = process.wait();
  EXPECT_EQ(o.code, 130) << o.err;
  const json::value r = read_results(out);
  EXPECT_EQ(text(row(r, 0).at("status")), "done");
  EXPECT_EQ(text(row(r, 1).at("status")), "interrupted");
  EXPECT_TRUE(row(r, 1).at("result").is_null());
}

TEST(SweepRun, RowsAreVerifiedFromTheFile)
{
  const WorkFolder folder;
  const std::string out = folder / "out";
  ASSERT_EQ(run_program({"run", folder.write("s.json", sweep_text()), "-o", out}).code, 0);
  const Outcome good = run_program({"verify", out});
  EXPECT_EQ(good.code, 0) << good.out;
  EXPECT_NE(good.out.find("PASS /sweep/rows/0/result/limits/0 (0 deg, stretch)"), std::string::npos)
      << good.out;
  EXPECT_NE(good.out.find("NONE /sweep/rows/8: refused, no results"), std::string::npos) << good.out;
  const json::value whole = read_results(out);
  const auto after = [&](const char* pointer, const json::value& value) {
    json::value wrong = whole;
    wrong.at_pointer(pointer) = value;
    write_partial_results(out, wrong);
    return run_program({"verify", out});
  };
  EXPECT_EQ(after("/sweep/rows/1/result/limits/0/poses/0/position/0", 0.01).code, 1);
  EXPECT_NE(
      after("/sweep/rows/1/measured/stretch 0", 0.5).out.find("'stretch 0' is not what the results say"),
      std::string::npos);
  EXPECT_NE(after("/sweep/rows/1/values/r", 0.61)
                .out.find("the row's experiment has 0.6 at "
                          "/elements/a/parameters/ring.r0, the table says 0.61"),
            std::string::npos);
}

TEST(SweepRun, TableIsVerifiedAgainstWhatWasAskedFor)
{
  const WorkFolder folder;
  const std::string out = folder / "out";
  ASSERT_EQ(run_program({"run", folder.write("s.json", sweep_text()), "-o", out}).code, 0);
  const json::value whole = read_results(out);
  const auto verdict = [&](const json::value& document) {
    write_partial_results(out, document);
    const Outcome o = run_program({"verify", out});
    return (o.code == 0 ? "ok " : "wrong ") + o.out;
  };
  const auto after = [&](const char* pointer, const json::value& value) {
    json::value wrong = whole;
    wrong.at_pointer(pointer) = value;
    return verdict(wrong);
  };
  const auto says = [](const std::string& text, const std::string& part) {
    return text.starts_with("wrong ") && text.find(part) != std::string::npos;
  };
  EXPECT_NE(verdict(whole).find("PASS /sweep: 9 rows, one for every combination of the values"),
            std::string::npos);
  std::string found = after("/sweep", json::object{});
  EXPECT_TRUE(says(found, "FAIL /sweep")) << found;
  found = after("/sweep/rows", json::array{});
  EXPECT_TRUE(says(found, "rows: 9 expected, found 0")) << found;
  found = after("/sweep/rows/8/values/r", 0.6);
  EXPECT_TRUE(says(found, "rows/8: 'r' is not the value of this row")) << found;
  found = after("/sweep/rows/0/result", nullptr);
  EXPECT_TRUE(says(found, "FAIL /sweep/rows/0: done, but results are missing")) << found;
  found = after("/sweep/rows/8/status", "done");
  EXPECT_TRUE(says(found, "counts/done: 7 expected, found 6")) << found;
  found = after("/sweep/axes/0/places/1/factor", 0.4);
  EXPECT_TRUE(says(found, "axes/0: not what the experiment varies")) << found;
  // An empty sweep in results of another task stands for nothing.
  json::value limits = whole;
  limits.at_pointer("/experiment/task") = "limits";
  limits.as_object()["sweep"] = {{"axes", json::array{}}, {"rows", json::array{}}};
  limits.as_object().erase("limits");
  found = verdict(limits);
  EXPECT_TRUE(says(found, "limits")) << found;
}

TEST(SweepRun, RangesAreVerified)
{
  const WorkFolder folder;
  const std::string out = folder / "out";
  const std::string file =
      folder.write("s.json", with(with(sweep_text(), R"("values": [4.8, 5.2, 0.6])",
                                       R"("range": { "from": 4.8, "to": 5.3, "count": 3, "scale": "log" })"),
                                  "[0.5, 0.6, 0.7]", "[0.6]"));
  ASSERT_EQ(run_program({"run", file, "-o", out, "--set", "/expect=[]"}).code, 0);
  EXPECT_EQ(run_program({"verify", out}).code, 0);
  json::value wrong = read_results(out);
  wrong.at_pointer("/sweep/rows/1/values/R") = 5.05;
  write_partial_results(out, wrong);
  EXPECT_NE(run_program({"verify", out}).out.find("rows/1: 'R' is not the value of this row"),
            std::string::npos);
}

}  // namespace
}  // namespace hauberk::test
