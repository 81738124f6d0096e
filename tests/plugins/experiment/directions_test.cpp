/// load_case.directions: what is read, and what is refused.

#include "fake_plugins.hpp"
#include "tasks/sweep/sweep_section.hpp"

#include <gtest/gtest.h>

namespace hauberk::test {
namespace {

/// The valid experiment without its design, with this in place of plugin and angles.
std::string text(const std::string& load_case)
{
  std::string out = with(valid_text(), R"("plugin": "plane", "directions_deg": [0, 30])", load_case);
  const std::size_t design = out.find("\"design\"");
  return out.substr(0, design) + "}\n";
}

std::string strains(const std::string& rest) { return text(R"("plugin": "strains", )" + rest); }

TEST(Directions, AListIsKeptAsGiven)
{
  const Experiment e = read_ok(strains(R"("directions": [[1, 0, 0], [-2, 0, 0], [0.5, 0.5, -3]])"));
  ASSERT_EQ(e.directions.size(), 3U);
  EXPECT_EQ(e.directions[1], Direction::along(std::array{-2.0, 0.0, 0.0}));
  EXPECT_EQ(e.directions[2].text(), "(0.5, 0.5, -3)");
  EXPECT_TRUE(e.directions_deg.empty());
  EXPECT_TRUE(e.senses.empty());
  EXPECT_TRUE(e.triangles.empty());
  EXPECT_EQ(e.resolved.at("load_case").find("senses"), nullptr);
}

TEST(Directions, ASphereIsSampled)
{
  const Experiment e = read_ok(strains(R"("directions": { "sphere": 3 })"));
  EXPECT_EQ(e.directions.size(), 92U);
  EXPECT_EQ(e.triangles.size(), 180U);
}

TEST(Directions, MistakesOfFormAreTold)
{
  const auto problems = [](const std::string& directions) {
    return problems_of(strains("\"directions\": " + directions));
  };
  EXPECT_EQ(problems("[[1, 0, 0], [0, 0, 0]]"),
            "t.json:13: /load_case/directions/1: expected a direction, found all zeros");
  EXPECT_EQ(
      problems("[[1, 0, 0], [1, 1]]"),
      "t.json:13: /load_case/directions/1: expected as many components as there are unknowns, 3, found 2");
  EXPECT_EQ(problems("[[1, 0, 0], [1, 1e999, 0]]").substr(0, 35), "t.json:13: /load_case/directions/1/");
  EXPECT_EQ(problems("[]").substr(0, 33), "t.json:13: /load_case/directions:");
  EXPECT_EQ(problems("7").substr(0, 33), "t.json:13: /load_case/directions:");
  for (const char* parts : {"0", "33", "1.5", "\"fine\""}) {
    EXPECT_EQ(problems("{ \"sphere\": " + std::string(parts) + " }").substr(0, 40),
              "t.json:13: /load_case/directions/sphere:")
        << parts;
  }
  EXPECT_EQ(problems("{}").substr(0, 60), "t.json:13: /load_case/directions: missing key 'sphere': expe");
  EXPECT_EQ(problems("[[1, 0, 0.5], [0, 1, 0], [2, 0, 1]]"),
            "t.json:13: /load_case/directions/2: direction (2, 0, 1) is given twice: lengths do not count");
  EXPECT_EQ(problems("[[1, 0, 0], [-1, 0, 0]]"), "") << "opposites are two directions";
}

TEST(Directions, ExcludeAnglesSensesAndDesigns)
{
  EXPECT_EQ(
      problems_of(strains(R"("directions": [[1, 0, 0]], "directions_deg": [0], "senses": ["stretch"])")),
      "t.json:13: /load_case/directions: directions and directions_deg are both given: expected one of them\n"
      "t.json:13: /load_case/senses: directions have one sense, further along them: leave out senses, "
      "and give the opposite direction for the other one");
  EXPECT_EQ(
      problems_of(text(R"("plugin": "plane", "directions": [[1, 0, 0]])")),
      "t.json:13: /load_case/directions/0: expected as many components as there are unknowns, 1, found 3");
  EXPECT_EQ(problems_of(text(R"("plugin": "plane", "directions": {"sphere": 2})")),
            "t.json:13: /load_case/directions: 'plane' has 1 unknowns, and a sphere of directions needs "
            "three: list them");
  std::string design = with(valid_text(), R"("plugin": "plane", "directions_deg": [0, 30])",
                            R"("plugin": "strains", "directions": [[1, 0, 0]])");
  design = with(design, "\"name\": \"pair\"", "\"name\": \"pair\", \"task\": \"design\"");
  EXPECT_EQ(problems_of(design),
            "t.json:13: /load_case/directions: targets and profiles of a design are taken at angles: use "
            "directions_deg");
}

TEST(Directions, NameTheColumnsOfASweep)
{
  const std::string swept = with(strains(R"("directions": [[1, 0, 0], [0, 0.5, 0.25]])"), "\"solver\"",
                                 R"("task": "sweep", "sweep": { "vary": [
    { "name": "R", "pointers": [{ "pointer": "/elements/link/parameters/ring.R" }], "values": [4, 5] } ] },
  "solver")");
  const Experiment e = read_ok(swept);
  ASSERT_EQ(e.section<ExperimentSweep>()->measure.size(), 2U);
  EXPECT_EQ(e.section<ExperimentSweep>()->measure[0].name, "along (1, 0, 0)");
  EXPECT_EQ(e.section<ExperimentSweep>()->measure[1].name, "along (0, 0.5, 0.25)");
  EXPECT_EQ(e.section<ExperimentSweep>()->measure[1].pointer, "/limits/1/value");
}

}  // namespace
}  // namespace hauberk::test
