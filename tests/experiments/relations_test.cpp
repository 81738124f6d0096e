/// Exact relations between limits over the rows of a sweep: rows that contain another one are no nearer.

#include "program.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <ostream>
#include <thread>

namespace hauberk::test {
namespace {

namespace json = boost::json;

/// A 4-in-1 sheet of thin wire, compressed at 45 degrees, with other values at one pointer.
std::string loose_text(const std::string& pointer, const std::string& values, bool lessons)
{
  return R"({ "name": "loose", "task": "sweep", "length_unit": "mm", "seed": 1,
  "elements": { "ring": { "shape": "torus_union", "tori": [ { "name": "ring" } ],
    "parameters": { "ring.R": 4.9, "ring.r0": 0.7, "ring.r1": 0.7 } } },
  "cell": { "vectors": [[12.2, 0], [0, 6.0]], "repeat": [1, 1], "place": [
    { "element": "ring", "position": [0, 0, 0], "rotation": { "axis": [1, 0, 0], "degrees": -36.5 } },
    { "element": "ring", "position": [6.1, 3.0, 0], "rotation": { "axis": [1, 0, 0], "degrees": 36.5 } } ] },
  "load_case": { "plugin": "in_plane_periodic", "directions_deg": [45], "senses": ["compress"], "hold": ["shear"],
    "out_of_plane": 0 },
  "solver": { "clearance": 0, "lessons": )" +
         std::string(lessons ? "true" : "false") + R"( },
  "sweep": { "vary": [ { "name": "x", "pointers": [")" +
         pointer + R"("], "values": )" + values + " } ] } }";
}

std::vector<double> values_of(const json::value& results)
{
  std::vector<double> out;
  for (const json::value& row : results.at_pointer("/sweep/rows").as_array())
    out.push_back(number_at(row, "/result/limits/0/value"));
  return out;
}

struct Relation {
  const char *name, *pointer, *values;  ///< rows from more freedom to less
};

void PrintTo(const Relation& r, std::ostream* out) { *out << r.name; }

class Relations : public testing::TestWithParam<Relation> {};

TEST_P(Relations, HoldBetweenRows)
{
  const auto& [name, pointer, values] = GetParam();
  const WorkFolder folder;
  ASSERT_EQ(
      run_program({"run", folder.write("off.json", loose_text(pointer, values, false)), "-o", folder / "off"})
          .code,
      0);
  const std::vector<double> alone = values_of(read_results(folder / "off"));
  EXPECT_FALSE(std::is_sorted(alone.begin(), alone.end())) << "without lessons nothing is violated: no test";
  const Outcome o =
      run_program({"run", folder.write("on.json", loose_text(pointer, values, true)), "-o", folder / "on"});
  ASSERT_EQ(o.code, 0) << o.out << o.err;
  const json::value results = read_results(folder / "on");
  const std::vector<double> v = values_of(results);
  for (std::size_t k = 1; k < v.size(); ++k) EXPECT_LE(v[k - 1], v[k] + 1e-7) << "row " << k - 1;
  // Every value is that of a state of its own row.
  EXPECT_EQ(run_program({"verify", folder / "on"}).code, 0);
}

INSTANTIATE_TEST_SUITE_P(Sweep, Relations,
                         testing::Values(Relation{"clearance", "/solver/clearance", "[0, 0.1, 0.2]"},
                                         Relation{"z", "/load_case/out_of_plane", R"(["free", 0])"},
                                         Relation{"hold", "/load_case/hold", R"([[], ["shear"]])"}),
                         [](const auto& info) { return std::string(info.param.name); });

/// Rows that teach are solved again where a run goes on, so that it ends where an uninterrupted one does.
TEST(RelationsResumed, EndAtTheSame)
{
  const WorkFolder folder;
  const std::string file =
      folder.write("s.json", loose_text("/solver/clearance", "[0, 0.05, 0.1, 0.15, 0.2]", true));
  ASSERT_EQ(run_program({"run", file, "-o", folder / "whole", "--threads", "2"}).code, 0);
  Process process({"run", file, "-o", folder / "parts", "--threads", "1"}, folder);
  std::this_thread::sleep_for(std::chrono::milliseconds(2000));
  process.signal(SIGINT);
  const int code = process.wait().code;
  EXPECT_TRUE(code == 130 || code == 0) << code;
  ASSERT_EQ(run_program({"run", file, "-o", folder / "parts", "--resume", "--threads", "1"}).code, 0);
  EXPECT_EQ(timeless(read_results(folder / "whole")), timeless(read_results(folder / "parts")));
}

}  // namespace
}  // namespace hauberk::test
