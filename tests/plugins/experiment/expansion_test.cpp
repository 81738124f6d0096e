/// From a correct file to plain types and kernel structs, and back to a file.

#include "document/json_writer.hpp"
#include "fake_plugins.hpp"
#include "tasks/design/design_section.hpp"
#include "tasks/table.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>

#include <fstream>
#include <random>

namespace hauberk::test {
namespace {

TEST(Expansion, RepeatsTheCellInTheOrderOfTheContract)
{
  const Experiment e = read_ok(with(valid_text(), "\"place\"", "\"repeat\": [3, 2], \"place\""));
  ASSERT_EQ(e.scene.elements.size(), 12u);
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 3; ++i) {
      for (int index = 0; index < 2; ++index) {
        const int k = (j * 3 + i) * 2 + index;
        const PlacedElement& element = e.scene.elements[k];
        EXPECT_EQ(element.rest.position, Vec3(12.0 * i + 6.0 * index, 100.0 * j, 0.0));
        EXPECT_EQ(element.type, 0);
        EXPECT_EQ(element.parameters, (std::vector<double>{5.0, 0.7, 1.0}));
      }
    }
  }
  ASSERT_EQ(e.scene.lattice.size(), 2u);
  EXPECT_EQ(e.scene.lattice[0], Vec3(36, 0, 0));
  EXPECT_EQ(e.scene.lattice[1], Vec3(0, 200, 0));
  EXPECT_EQ(e.scene.length, 5.0);
}

/// Elements of a patch around the origin, with the lattice vectors and the outline given.
std::vector<PlacedElement> patch(const std::string& vectors, const std::string& outline)
{
  std::string text = with(valid_text(), "\"vectors\": [[12, 0], [0, 100]],",
                          "\"patch\": { \"vectors\": " + vectors + ", \"outline\": " + outline + " },");
  text = with(text, "\"plugin\": \"plane\", \"directions_deg\": [0, 30]",
              "\"plugin\": \"bend\", \"directions_deg\": [0, 30]");
  return read_ok(with(text, "\"quantity\": \"eta\"", "\"quantity\": \"curvature\"")).scene.elements;
}

TEST(Expansion, HexagonsOfCells)
{
  const std::string sixty = "[[10, 0], [5, 8.660254037844386]]", other = "[[10, 0], [-5, 8.660254037844386]]";
  for (const std::string& vectors : {sixty, other}) {
    const std::size_t counts[] = {1, 7, 19, 37, 61};
    for (std::size_t rings = 0; rings < 5; ++rings) {
      const auto elements = patch(vectors, "{ \"hexagon\": " + std::to_string(rings) + " }");
      ASSERT_EQ(elements.size(), 2 * counts[rings]);
      Vec3 mean = Vec3::Zero();
      double farthest = 0.0;
      for (const PlacedElement& e : elements) mean += e.rest.position;
      for (std::size_t k = 0; k < elements.size(); k += 2)
        farthest = std::max(farthest, (elements[k].rest.position + Vec3(3.0, 0.0, 0.0)).norm());
      // The two elements of a cell are 6 apart, so that the first is 3 beside the middle.
      EXPECT_LT(mean.norm(), 1e-11);
      EXPECT_NEAR(farthest, 10.0 * static_cast<double>(rings), 1e-11) << vectors;
    }
  }
}

TEST(Expansion, DisksAndRectanglesOfCells)
{
  const auto disk = patch("[[10, 0], [5, 8.660254037844386]]", "{ \"disk\": 17.33 }");
  EXPECT_EQ(disk.size(), 2 * 13U);  // 1, 6 at 10 and 6 at 17.32
  const auto square = patch("[[10, 0], [0, 20]]", "{ \"rectangle\": [3, 2] }");
  ASSERT_EQ(square.size(), 12U);
  EXPECT_LT((square[0].rest.position - Vec3(-13, -10, 0)).norm(), 1e-13);
  EXPECT_LT((square[2].rest.position - Vec3(-3, -10, 0)).norm(), 1e-13);
  EXPECT_LT((square[11].rest.position - Vec3(13, 10, 0)).norm(), 1e-13);
}

TEST(Expansion, RotationsAreActiveAndExactAtRightAngles)
{
  const Experiment e = read_ok(valid_text());
  EXPECT_EQ(e.scene.elements[0].rest.rotation, Mat3::Identity());
  Mat3 quarter;  // about x: y goes to z
  quarter << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  EXPECT_EQ(e.scene.elements[1].rest.rotation, quarter);
  const Experiment turned =
      read_ok(with(valid_text(), "\"axis\": [1, 0, 0], \"degrees\": 90", "\"quaternion\": [1, 1, 0, 0]"));
  EXPECT_LT((turned.scene.elements[1].rest.rotation - quarter).norm(), 1e-15);
  const Experiment oblique = read_ok(
      with(valid_text(), "\"axis\": [1, 0, 0], \"degrees\": 90", "\"axis\": [1, 1, 1], \"degrees\": -240"));
  EXPECT_LT((oblique.scene.elements[1].rest.rotation * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-15);
}

TEST(Expansion, ResolvesSettingsAndDefaults)
{
  const Experiment e = read_ok(valid_text());
  EXPECT_EQ(e.name, "pair");
  EXPECT_EQ(e.task, "limits");
  EXPECT_EQ(e.length_unit, "mm");
  EXPECT_EQ(e.seed, 1u);
  EXPECT_FALSE(e.relax);
  EXPECT_EQ(e.load_case_plugin, "plane");
  EXPECT_EQ(e.load_case->measure(), "tensor");
  EXPECT_EQ(e.directions_deg, (std::vector<double>{0, 30}));
  EXPECT_EQ(e.senses, (std::vector<Sense>{Sense::positive, Sense::negative}));
  EXPECT_EQ(e.solver.preset, "accurate");
  EXPECT_EQ(e.solver.tolerance, 1e-3);
  EXPECT_EQ(e.solver.contact, "auto");
  EXPECT_EQ(e.solver.starts, 1);
  EXPECT_EQ(e.solver.start_seed, 1u);
  EXPECT_FALSE(e.solver.max_stages);
  EXPECT_EQ(e.section<ExperimentDesign>()->optimizer_plugin, "search");
  EXPECT_EQ(e.section<ExperimentDesign>()->quantity, "eta");
  ASSERT_EQ(e.section<ExperimentDesign>()->targets.size(), 1u);
  EXPECT_EQ(e.section<ExperimentDesign>()->targets[0].weight, 1.0);
  EXPECT_EQ(e.resolved.at("design").at("optimizer").at("steps").number, 40.0);
  EXPECT_EQ(e.resolved.at("load_case").at("measure").string, "tensor");
  EXPECT_EQ(e.resolved.at("elements").at("link").at("parameters").at("count").number, 1.0);
  const Experiment one = read_ok(with(valid_text(), "[0, 30]", "[0, 30], \"senses\": [\"compress\"]"));
  EXPECT_EQ(one.senses, std::vector<Sense>{Sense::negative});
}

TEST(Expansion, VariablesPerElementTypeAndAll)
{
  std::string text = with(valid_text(), "\"link\": {",
                          "\"big\": { \"shape\": \"rings\", \"rings\": [ { \"name\": \"ring\" } ], "
                          "\"parameters\": { \"ring.R\": 5.0 } }, \"link\": {");
  text = with(text, "{ \"element\": \"link\", \"position\": [0, 0, 0] }",
              "{ \"element\": \"link\", \"position\": [0, 0, 0] }, { \"element\": \"big\", \"position\": [3, "
              "0, 0] }");
  const auto names = [&](const std::string& per, const std::string& parameters) {
    const Experiment e = read_ok(with(text, "{ \"parameters\": \"ring.R\",",
                                      "{ \"parameters\": " + parameters + ", \"per\": \"" + per + "\","));
    std::string out;
    for (const ExperimentVariable& variable : e.section<ExperimentDesign>()->variables) {
      out += variable.name + ":";
      for (const ParameterRef& ref : variable.parameters) {
        out += " (" + std::to_string(ref.element) + "," + std::to_string(ref.parameter) + ")";
      }
      out += "; ";
      EXPECT_EQ(variable.initial, 5.0);
      EXPECT_EQ(variable.lower, 4.0);
      EXPECT_EQ(variable.upper, 6.5);
    }
    return out;
  };
  EXPECT_EQ(names("element", "\"ring.R\""), "0/ring.R: (0,0); 1/ring.R: (1,0); 2/ring.R: (2,0); ");
  EXPECT_EQ(names("type", "\"ring.R\""), "link/ring.R: (0,0) (2,0); big/ring.R: (1,0); ");
  EXPECT_EQ(names("all", "[\"ring.R\"]"), "*/ring.R: (0,0) (1,0) (2,0); ");
}

TEST(Expansion, AListOfParametersGivesAVariableEach)
{
  const Experiment e =
      read_ok(with(valid_text(), "{ \"parameters\": \"ring.R\", \"lower\": 4.0",
                   "{ \"parameters\": [\"ring.r\", \"ring.R\"], \"per\": \"all\", \"lower\": 0.5"));
  ASSERT_EQ(e.section<ExperimentDesign>()->variables.size(), 2u);
  EXPECT_EQ(e.section<ExperimentDesign>()->variables[0].name, "*/ring.r");
  EXPECT_EQ(e.section<ExperimentDesign>()->variables[0].initial, 0.7);
  EXPECT_EQ(e.section<ExperimentDesign>()->variables[1].name, "*/ring.R");
}

TEST(Expansion, ADesignWithoutDirectionsUsesThoseOfItsTargets)
{
  std::string text = with(valid_text(), "\"name\": \"pair\"", "\"name\": \"pair\", \"task\": \"design\"");
  text = with(text, ", \"directions_deg\": [0, 30]", "");
  text = with(text, "\"value\": 0.05 }", "\"value\": 0.05 }, { \"direction_deg\": 45, \"value\": 0.1 }");
  const Experiment e = read_ok(text);
  EXPECT_EQ(e.task, "design");
  EXPECT_EQ(e.directions_deg, (std::vector<double>{0, 45}));
}

void expect_same(const Experiment& a, const Experiment& b)
{
  EXPECT_EQ(write_json(a.resolved), write_json(b.resolved));
  ASSERT_EQ(a.scene.elements.size(), b.scene.elements.size());
  for (std::size_t k = 0; k < a.scene.elements.size(); ++k) {
    EXPECT_EQ(a.scene.elements[k].parameters, b.scene.elements[k].parameters);
    EXPECT_EQ(a.scene.elements[k].rest.position, b.scene.elements[k].rest.position);
    EXPECT_EQ(a.scene.elements[k].rest.rotation, b.scene.elements[k].rest.rotation);
  }
  EXPECT_EQ(a.scene.lattice, b.scene.lattice);
  EXPECT_EQ(a.directions_deg, b.directions_deg);
  EXPECT_EQ(a.senses, b.senses);
  ASSERT_EQ(a.section<ExperimentDesign>() != nullptr, b.section<ExperimentDesign>() != nullptr);
  if (!a.section<ExperimentDesign>()) return;
  ASSERT_EQ(a.section<ExperimentDesign>()->variables.size(), b.section<ExperimentDesign>()->variables.size());
  for (std::size_t k = 0; k < a.section<ExperimentDesign>()->variables.size(); ++k) {
    EXPECT_EQ(a.section<ExperimentDesign>()->variables[k].name,
              b.section<ExperimentDesign>()->variables[k].name);
    EXPECT_EQ(a.section<ExperimentDesign>()->variables[k].initial,
              b.section<ExperimentDesign>()->variables[k].initial);
  }
}

/// A correct experiment with random numbers, optional keys and counts.
std::string random_experiment(std::mt19937_64& random)
{
  const auto real = [&](double low, double high) {
    return format_number(std::uniform_real_distribution<double>(low, high)(random));
  };
  const auto chance = [&] { return random() % 2 == 0; };
  const auto count = [&](std::uint64_t most) { return 1 + random() % most; };
  std::string text = "{ \"name\": \"r\", // random\n";
  if (chance()) text += "\"seed\": " + std::to_string(random() >> 12) + ",";
  if (chance()) text += "\"length_unit\": \"um\",";
  text +=
      "\"elements\": { \"a\": { \"shape\": \"rings\", \"rings\": [ {\"name\": \"x\"}, {\"name\": \"y\"}, "
      "],\n\"parameters\": {";
  text += "\"x.R\": " + real(2, 9) + ", \"y.R\": " + real(2, 9) +
          (chance() ? ", \"y.r\": " + real(0.1, 1.9) : "") + "} } },\n";
  text += "\"cell\": { \"vectors\": [[" + real(1, 9) + "," + real(-1, 1) + "],[" + real(-1, 1) + "," +
          real(1, 9) + "]],";
  if (chance()) text += "\"repeat\": [" + std::to_string(count(3)) + "," + std::to_string(count(3)) + "],";
  text += "\"place\": [\n";
  for (std::uint64_t k = count(4); k > 0; --k) {
    text +=
        "{ \"element\": \"a\", \"position\": [" + real(-9, 9) + "," + real(-9, 9) + "," + real(-9, 9) + "]";
    if (chance())
      text +=
          ", \"rotation\": { \"axis\": [0.5," + real(-1, 1) + ",0], \"degrees\": " + real(-400, 400) + "}";
    if (chance()) text += ", \"parameters\": { \"x.r\": " + real(0.1, 1.9) + "}";
    text += "},\n";
  }
  text += "] },\n\"load_case\": { \"plugin\": \"plane\", \"directions_deg\": [" + real(0, 89) + "," +
          real(90, 179) + "]";
  if (chance()) text += ", \"measure\": \"paper\", \"senses\": [\"stretch\"]";
  text += "},\n";
  if (chance())
    text += "\"solver\": { \"starts\": " + std::to_string(count(9)) + ", \"tolerance\": " + real(1e-9, 1e-3) +
            "},\n";
  if (chance()) {
    text +=
        "\"design\": { \"optimizer\": { \"plugin\": \"search\" }, \"quantity\": \"stretch\", \"variables\": "
        "[ { \"parameters\": "
        "[\"x.r\", \"y.r\"], \"lower\": 0.05, \"upper\": 2 } ], \"targets\": [ { \"direction_deg\": " +
        real(0, 180) + ", \"value\": " + real(0, 1) + " } ] },\n";
  }
  if (chance())
    text += "\"expect\": [ { \"pointer\": \"/limits/0/value\", \"value\": " + real(-1, 1) +
            ", \"rel\": 1e-8 } ],";
  return text + "}\n";
}

TEST(Expansion, ResolvedExperimentsReadBackAsTheSame)
{
  std::mt19937_64 random(3);
  for (int k = 0; k < 200; ++k) {
    const std::string text = random_experiment(random);
    const Experiment first = read_ok(text);
    expect_same(first, read_ok(write_json(first.resolved)));
    if (::testing::Test::HasFailure()) FAIL() << text;
  }
}

TEST(Expansion, DamagedExperimentsNeverCrashTheReader)
{
  std::mt19937_64 random(5);
  int refused = 0;
  for (int k = 0; k < 2000; ++k) {
    std::string text = k % 2 == 0 ? valid_text() : random_experiment(random);
    for (std::uint64_t n = 1 + random() % 3; n > 0; --n) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0:
          text[at] = "{}[],:\"0-e."[random() % 11];
          break;
        case 1:
          text.erase(at, 1 + random() % 12);
          break;
        case 2:
          text.insert(at, "null,");
          break;
        default:
          text.insert(at, std::to_string(random() % 100));
          break;
      }
    }
    Diagnostics diagnostics;
    const auto experiment =
        read_experiment({"t.json", text, {}, {}, {}, task_formats()}, fake_lookup, diagnostics);
    EXPECT_EQ(experiment.has_value(), diagnostics.empty());
    refused += !diagnostics.empty();
  }
  EXPECT_GT(refused, 1000);
}

TEST(Expansion, ASceneBecomesAnExperimentOfItsOwn)
{
  const Experiment e = read_ok(with(valid_text(), "\"place\"", "\"repeat\": [2, 1], \"place\""));
  SceneSpec scene = e.scene;
  scene.elements[3].parameters[0] = 5.3;
  const Experiment written = read_ok(write_json(scene_experiment(e, scene, "pair_designed")));
  EXPECT_EQ(written.name, "pair_designed");
  EXPECT_EQ(written.task, "limits");
  EXPECT_FALSE(written.section<ExperimentDesign>());
  EXPECT_EQ(written.directions_deg, e.directions_deg);
  ASSERT_EQ(written.scene.elements.size(), 4u);
  EXPECT_EQ(written.scene.elements[3].parameters, (std::vector<double>{5.3, 0.7, 1.0}));
  EXPECT_EQ(written.scene.elements[2].parameters, (std::vector<double>{5.0, 0.7, 1.0}));
  EXPECT_EQ(written.scene.lattice, scene.lattice);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(written.scene.elements[k].rest.position, scene.elements[k].rest.position);
    EXPECT_LT((written.scene.elements[k].rest.rotation - scene.elements[k].rest.rotation).norm(), 1e-15);
  }
}

/// Cells that are alike are searched as copies, in the written file too.
TEST(Expansion, CellsThatAreAlikeStayOneCell)
{
  const Experiment e = read_ok(with(valid_text(), "\"place\"", "\"repeat\": [3, 2], \"place\""));
  SceneSpec scene = e.scene;
  for (std::size_t k = 1; k < scene.elements.size(); k += 2) scene.elements[k].parameters[0] = 5.3;
  const SceneSpec written = read_ok(write_json(scene_experiment(e, scene, "pair_designed"))).scene;
  EXPECT_EQ(written.repeat, (std::array<int, 3>{3, 2, 1}));
  ASSERT_EQ(written.elements.size(), scene.elements.size());
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_LT((written.lattice[k] - scene.lattice[k]).norm(), 1e-14 * scene.lattice[k].norm());
  for (std::size_t k = 0; k < scene.elements.size(); ++k) {
    EXPECT_EQ(written.elements[k].copy_of, scene.elements[k].copy_of) << k;
    EXPECT_EQ(written.elements[k].parameters, scene.elements[k].parameters) << k;
    EXPECT_LT((written.elements[k].rest.position - scene.elements[k].rest.position).norm(), 1e-13) << k;
  }
}

TEST(Expansion, Files)
{
  const std::string missing = ::testing::TempDir() + "no_such_experiment.json";
  try {
    load_experiment(missing, {}, fake_lookup, task_formats());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), "cannot read '" + missing + "': No such file or directory");
  }
  EXPECT_THROW(read_text_file(::testing::TempDir()), InputError);
  const std::string path = ::testing::TempDir() + "experiment_test.json";
  std::ofstream(path) << valid_text();
  EXPECT_EQ(load_experiment(path, {}, fake_lookup, task_formats()).name, "pair");
  try {
    load_experiment(path, {"/seed=-1"}, fake_lookup, task_formats());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "command line: /seed: expected an integer >= 0, found -1");
  }
}

}  // namespace
}  // namespace hauberk::test
