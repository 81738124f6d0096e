/// Patches bent onto a paraboloid: symmetries, and the independent check.

#include "document/json_text.hpp"
#include "program.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

namespace hauberk::test {
namespace {

namespace json = boost::json;

/// Seven threefold elements with round tubes.
std::string patch_text()
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
      "parameters": { "centre.R": 4.25, "centre.r0": 0.95, "centre.r1": 0.95, "side.R": 2.575, "side.r0": 0.95, "side.r1": 0.95 } } },
  "cell": {
    "patch": { "vectors": [[9.591231359, 5.5375], [0, 11.075]], "outline": { "hexagon": 1 } },
    "place": [ { "element": "threefold", "position": [0, 0, 0] } ] },
  "load_case": { "plugin": "paraboloid_bending", "directions_deg": [0, 60, 120] },
  "solver": { "preset": "accurate", "neighbours": 0 }
})";
}

class Bending : public ::testing::Test {
 protected:
  static void SetUpTestSuite()
  {
    const WorkFolder folder;
    ASSERT_EQ(run_program({"run", folder.write("p.json", patch_text()), "-o", folder / "out"}).code, 0);
    results_ = read_results(folder / "out");
  }

  static Outcome verify(const json::value& results)
  {
    const WorkFolder folder;
    return run_program({"verify", folder.write("results.json", write_json(results))});
  }

  static void expect_caught(const json::value& results, const std::string& message)
  {
    const Outcome o = verify(results);
    EXPECT_EQ(o.code, 1);
    EXPECT_NE(o.out.find(message), std::string::npos) << "missing: " << message << '\n' << o.out;
  }

  static inline json::value results_;
};

/// The element has three mirrors and one more in its plane: directions 60 degrees apart, up and down, are
/// equal. The patch need not be, and the path there is not.
TEST_F(Bending, HasTheSymmetriesOfThePatch)
{
  const double first = number_at(results_, "/limits/0/value");
  EXPECT_GT(first, 0.14);
  for (int k = 0; k < 6; ++k) {
    const std::string at = "/limits/" + std::to_string(k);
    EXPECT_EQ(results_.at_pointer(at + "/status").as_string(), "locked");
    const double sign = results_.at_pointer(at + "/sense").as_string() == "up" ? 1.0 : -1.0;
    EXPECT_NEAR(sign * number_at(results_, at + "/value"), first, 2e-9 * first) << at;
  }
}

TEST_F(Bending, ReportsTheParaboloidInUnitsOfTheFile)
{
  const WorkFolder folder;
  const std::string text = with(with(patch_text(), "[0, 60, 120]", "[30], \"senses\": [\"up\"]"),
                                "\"name\": \"patch\",", "\"name\": \"patch\", \"length_unit\": \"m\",");
  ASSERT_EQ(run_program({"run", folder.write("p.json", text), "-o", folder / "out"}).code, 0);
  const json::value r = read_results(folder / "out");
  const auto macro = [&](const char* name) { return number_at(r, std::string("/limits/0/macro/") + name); };
  const double c = std::sqrt(0.75), s = 0.5;
  EXPECT_NEAR(number_at(r, "/limits/0/value"),
              2.0 * (macro("A") * c * c + macro("B") * s * s + macro("C") * c * s), 1e-12);
  const json::array& elements = r.at_pointer("/scene/elements").as_array();
  const json::array& poses = r.at_pointer("/limits/0/poses").as_array();
  ASSERT_EQ(poses.size(), 7U);
  double mean_x = 0.0, mean_y = 0.0;
  for (std::size_t k = 0; k < 7; ++k) {
    const auto coordinate = [&](int i) { return number_at(poses[k], "/position/" + std::to_string(i)); };
    const double x = coordinate(0), y = coordinate(1);
    EXPECT_NEAR(coordinate(2), macro("A") * x * x + macro("B") * y * y + macro("C") * x * y, 1e-12);
    EXPECT_EQ(number_at(elements[k], "/rest/position/2"), 0.0);
    mean_x += x / 7.0;
    mean_y += y / 7.0;
  }
  EXPECT_NEAR(mean_x, 0.0, 1e-12);
  EXPECT_NEAR(mean_y, 0.0, 1e-12);
  EXPECT_TRUE(r.at_pointer("/profiles/0/eta").is_null());
}

/// A curvature is the inverse of a length.
TEST_F(Bending, ScalesWithTheScene)
{
  std::string text = with(patch_text(), "[0, 60, 120]", "[0], \"senses\": [\"up\"]");
  for (const auto& [one, ten] :
       {std::pair("[[9.591231359, 5.5375], [0, 11.075]]", "[[95.91231359, 55.375], [0, 110.75]]"),
        std::pair("\"centre.R\": 4.25", "\"centre.R\": 42.5"),
        std::pair("\"side.R\": 2.575", "\"side.R\": 25.75"),
        std::pair("\"centre.r0\": 0.95, \"centre.r1\": 0.95", "\"centre.r0\": 9.5, \"centre.r1\": 9.5"),
        std::pair("\"side.r0\": 0.95, \"side.r1\": 0.95", "\"side.r0\": 9.5, \"side.r1\": 9.5")})
    text = with(text, one, ten);
  const WorkFolder folder;
  ASSERT_EQ(run_program({"run", folder.write("p.json", text), "-o", folder / "out"}).code, 0);
  const double first = number_at(results_, "/limits/0/value");
  EXPECT_NEAR(number_at(read_results(folder / "out"), "/limits/0/value"), 0.1 * first, 1e-9 * first);
}

TEST_F(Bending, PassesTheIndependentCheck)
{
  const Outcome o = verify(results_);
  EXPECT_EQ(o.code, 0) << o.out;
}

TEST_F(Bending, TheCheckSeesWhatIsOffTheParaboloid)
{
  json::value r = results_;
  const auto shift = [&r](const std::string& pointer, double by) {
    r.at_pointer(pointer) = number_at(r, pointer) + by;
  };
  shift("/limits/0/poses/2/position/2", 1e-6);
  expect_caught(r, "an element is 1e-06 off the paraboloid");
  r = results_;
  for (int k = 0; k < 7; ++k) shift("/limits/0/poses/" + std::to_string(k) + "/position/0", 1e-5);
  expect_caught(r, "the mean of the patch moved by 1e-05 from the apex");
  r = results_;
  for (int k = 0; k < 7; ++k) {
    const std::string at = "/limits/0/poses/" + std::to_string(k) + "/position/";
    const double x = number_at(r, at + "0"), y = number_at(r, at + "1");
    shift(at + "0", -1e-5 * y);
    shift(at + "1", 1e-5 * x);
  }
  expect_caught(r, "the patch turned");
  r = results_;
  shift("/limits/0/macro/A", 1e-6);
  expect_caught(r, "off the paraboloid");
  r = results_;
  shift("/limits/0/contacts/0/force", 0.01 * number_at(r, "/limits/0/contacts/0/force"));
  expect_caught(r, "forces miss the load");
}

}  // namespace
}  // namespace hauberk::test
