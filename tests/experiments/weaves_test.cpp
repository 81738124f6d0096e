/// The library of weaves: linked as each says, with room from the ratio that it gives on, and no thicker wire
/// than theory allows.

#include "document/json_text.hpp"
#include "program.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <regex>

namespace hauberk::test {
namespace {

namespace json = boost::json;

/// What the weave's file says; a test of its own, so that a changed file shows.
struct Weave {
  const char* name;
  std::vector<int> links;
  const char *upper, *lower;  ///< parameters whose ratio decides
  double at_least;
};

std::ostream& operator<<(std::ostream& out, const Weave& weave) { return out << weave.name; }

std::string experiment(const Weave& weave)
{
  return fmt::format(R"({{ "name": "w", "cell": {{ "weave": {{ "name": "{}", "parameters": {{}} }} }},
  "load_case": {{ "plugin": "in_plane_periodic", "directions_deg": [0], "senses": ["stretch"] }} }})",
                     weave.name);
}

/// --set of both parameters.
std::vector<std::string> scaled(const Weave& weave, double ratio, double lower)
{
  const std::string place = "/cell/weave/parameters/";
  return {"--set", fmt::format("{}{}={}", place, weave.upper, ratio * lower), "--set",
          fmt::format("{}{}={}", place, weave.lower, lower)};
}

class Weaves : public ::testing::TestWithParam<Weave> {};

TEST_P(Weaves, AreLinkedAsTheySay)
{
  const Weave& weave = GetParam();
  const WorkFolder folder;
  const Outcome o = run_program({"plan", "--json", folder.write("w.json", experiment(weave))});
  ASSERT_EQ(o.code, 0) << o.err;
  std::vector<int> links;
  const json::value single = parse_json(o.out, "plan");
  for (const json::value& n : single.at("links_per_element").as_array())
    links.push_back(static_cast<int>(n.to_number<int>()));
  EXPECT_EQ(links, weave.links);
  // What is repeated is linked to itself in the same way.
  const Outcome repeated = run_program({"plan", "--json", folder / "w.json", "--set", "/cell/repeat=[2, 2]"});
  ASSERT_EQ(repeated.code, 0) << repeated.err;
  const json::value plan = parse_json(repeated.out, "plan");
  const json::array& four = plan.at("links_per_element").as_array();
  ASSERT_EQ(four.size(), 4 * links.size());
  for (std::size_t k = 0; k < four.size(); ++k) EXPECT_EQ(four[k].to_number<int>(), links[k % links.size()]);
}

TEST_P(Weaves, HaveRoomFromTheirSmallestRatioOn)
{
  const Weave& weave = GetParam();
  const WorkFolder folder;
  const std::string file = folder.write("w.json", experiment(weave));
  const auto check = [&](double ratio) {
    // The side rings of the threefold element must stay as large as its lattice needs them.
    const std::string name = weave.name;
    const double upper = name == "threefold" ? 2.575 : name == "dragonscale" ? 8.6 : 5.0;
    std::vector<std::string> words{"check", file, "--thorough"};
    // The small rings are of the same wire, or of wire that they have room for.
    if (name == "dragonscale")
      words.insert(words.end(), {"--set", fmt::format("/cell/weave/parameters/small_wire_diameter={}",
                                                      std::min(1.4, upper / ratio))});
    for (const std::string& word : scaled(weave, ratio, upper / ratio)) words.push_back(word);
    return run_program(words);
  };
  EXPECT_EQ(check(weave.at_least).code, 0) << check(weave.at_least).err;
  EXPECT_EQ(check(10.0 * weave.at_least).code, 0) << check(10.0 * weave.at_least).err;
  const Outcome below = check(0.999 * weave.at_least);
  EXPECT_EQ(below.code, 2);
  EXPECT_NE(below.err.find("overlap at rest"), std::string::npos) << below.err;
}

TEST_P(Weaves, FilesSayTheSame)
{
  const Weave& weave = GetParam();
  const std::string file = std::string(HAUBERK_WEAVES) + "/" + weave.name + ".json";
  const std::string text = read_text(file);
  std::string links;
  for (const int n : weave.links) links += (links.empty() ? "" : ", ") + std::to_string(n);
  EXPECT_NE(text.find("\"links\": [" + links + "]"), std::string::npos);
  EXPECT_NE(text.find(fmt::format("\"ratio\": [\"{}\", \"{}\"], \"at_least\": {}", weave.upper, weave.lower,
                                  weave.at_least)),
            std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Library, Weaves,
    ::testing::Values(Weave{"chain", {2, 2}, "inner_diameter", "wire_diameter", 2.00000001},
                      Weave{"european_4in1", {4, 4}, "inner_diameter", "wire_diameter", 2.98096},
                      Weave{"european_6in1", {6, 6}, "inner_diameter", "wire_diameter", 4.37253},
                      Weave{"japanese_4in1", {4, 2, 2}, "inner_diameter", "wire_diameter", 2.41421357},
                      Weave{"japanese_6in1", {6, 2, 2, 2}, "inner_diameter", "wire_diameter", 3.00000001},
                      Weave{"threefold", {6}, "side_R", "side_r0", 2.396},
                      Weave{"fourfold", {20, 10, 10}, "R", "r", 4.958},
                      Weave{"box", {4, 4, 4, 4}, "inner_diameter", "wire_diameter", 4.4132},
                      Weave{"byzantine", std::vector<int>(12, 4), "inner_diameter", "wire_diameter", 3.26542},
                      Weave{"half_persian_3in1", {3, 3}, "inner_diameter", "wire_diameter", 3.8928},
                      Weave{"half_persian_4in1", {4, 4}, "inner_diameter", "wire_diameter", 4.53942},
                      Weave{"full_persian_6in1", {6, 6, 6, 6}, "inner_diameter", "wire_diameter", 5.05065},
                      Weave{"dragonscale", {4, 4, 4, 4}, "inner_diameter", "wire_diameter", 5.70924}),
    [](const auto& info) { return std::string(info.param.name); });

/// Links do not tell folded weaves from others with the same links: a Byzantine chain is a chain of pairs
/// whose rings contact holds back. Their places are compared with those that another program found.
class FoldedWeaves : public ::testing::TestWithParam<const char*> {};

TEST_P(FoldedWeaves, HaveThePlacesOfAnIndependentSearch)
{
  const WorkFolder folder;
  const std::string file = folder.write("w.json", experiment({GetParam(), {}, "", "", 0.0}));
  ASSERT_EQ(run_program({"run", file, "-o", folder / "out", "--set", "/solver/lessons=false"}).code, 0);
  const json::value scene = read_results(folder / "out").at("scene");
  const json::value expected =
      parse_json(read_text(HAUBERK_SOURCE_DIR "/tests/experiments/weave_places.json"), "places")
          .at(GetParam());
  constexpr double in_length = 1e-6, in_angle = 2e-6;
  const double R = number_at(scene, "/elements/0/primitives/0/parameters/R");
  for (int v = 0; v < static_cast<int>(expected.at("vectors").as_array().size()); ++v) {
    for (int c = 0; c < 2; ++c) {
      const std::string at = fmt::format("/{}/{}", v, c);
      EXPECT_NEAR(number_at(scene, "/cell_vectors" + at) / R, number_at(expected, "/vectors" + at), in_length)
          << at;
    }
  }
  const json::array& rings = expected.at("rings").as_array();
  ASSERT_EQ(scene.at("elements").as_array().size(), rings.size());
  for (int k = 0; k < static_cast<int>(rings.size()); ++k) {
    const std::string ring = fmt::format("/elements/{}/rest", k);
    const auto q = [&](int c) { return number_at(scene, fmt::format("{}/quaternion/{}", ring, c)); };
    const double normal[] = {2.0 * (q(1) * q(3) + q(0) * q(2)), 2.0 * (q(2) * q(3) - q(0) * q(1)),
                             1.0 - 2.0 * (q(1) * q(1) + q(2) * q(2))};
    double same = 0.0, opposite = 0.0;  // distances of the normals
    for (int c = 0; c < 3; ++c) {
      const json::value& expected_ring = rings[k];
      EXPECT_NEAR(number_at(scene, fmt::format("{}/position/{}", ring, c)) / R,
                  number_at(expected_ring, fmt::format("/centre/{}", c)), in_length)
          << ring;
      const double there = number_at(expected_ring, fmt::format("/normal/{}", c));
      same = std::hypot(same, normal[c] - there);
      opposite = std::hypot(opposite, normal[c] + there);
    }
    EXPECT_LT(std::min(same, opposite), in_angle) << ring;
  }
}

INSTANTIATE_TEST_SUITE_P(Library, FoldedWeaves,
                         ::testing::Values("box", "byzantine", "half_persian_3in1", "half_persian_4in1",
                                           "full_persian_6in1", "dragonscale"),
                         [](const auto& info) { return std::string(info.param); });

/// n wires that pass through a round hole are n discs in a disc, and the hole's own tube is as thick: inner
/// diameter / wire is at least the ratio of the radii of the smallest such disc. Chains, Japanese 4-in-1 and
/// 6-in-1 attain it, so the search must, too.
double packed_discs(int n)
{
  if (n == 6) return 3.0;  // as for seven: the one in the middle fits as well
  return 1.0 + 1.0 / std::sin(std::numbers::pi / n);
}

class SmallestRatio : public ::testing::TestWithParam<std::tuple<Weave, double>> {};

TEST_P(SmallestRatio, IsFound)
{
  const auto& [weave, expected] = GetParam();
  const WorkFolder folder;
  const std::string found = folder / "found.json";
  const Outcome o = run_program({"room", folder.write("w.json", experiment(weave)), "-o", found});
  ASSERT_EQ(o.code, 0) << o.err;
  std::smatch match;
  ASSERT_TRUE(std::regex_search(o.out, match,
                                std::regex("-> ([0-9.]+): inner diameter / wire [0-9.]+ -> ([0-9.]+)\n")))
      << o.out;
  const double thickest = std::stod(match[1]), ratio = std::stod(match[2]);
  EXPECT_NEAR(ratio, expected, 2e-6);
  EXPECT_GE(ratio, packed_discs(weave.links.front()) - 1e-6) << "no fabric can be built below this";
  // The state found is one: rings of that thickness have room in it, thicker ones do not.
  const auto with_wire = [&](double wire) {
    std::vector<std::string> words{"check", found};
    const std::size_t count = weave.links.size();
    for (std::size_t k = 0; k < count; ++k) {
      for (const char* radius : {"r0", "r1"}) {
        words.emplace_back("--set");
        words.push_back(fmt::format("/cell/place/{}/parameters/ring.{}={}", k, radius, 0.5 * wire));
      }
    }
    return run_program(words).code;
  };
  EXPECT_EQ(with_wire(thickest * (1.0 - 1e-6)), 0);
  EXPECT_EQ(with_wire(thickest * (1.0 + 1e-5)), 2);
}

INSTANTIATE_TEST_SUITE_P(
    Library, SmallestRatio,
    ::testing::Values(std::tuple{Weave{"chain", {2, 2}, "", "", 0.0}, 2.0},
                      std::tuple{Weave{"japanese_4in1", {4, 2, 2}, "", "", 0.0}, 1.0 + std::numbers::sqrt2},
                      std::tuple{Weave{"japanese_6in1", {6, 2, 2, 2}, "", "", 0.0}, 3.0},
                      std::tuple{Weave{"european_4in1", {4, 4}, "", "", 0.0}, 2.9809270},
                      std::tuple{Weave{"european_6in1", {6, 6}, "", "", 0.0}, 4.3724510},
                      std::tuple{Weave{"box", {4, 4, 4, 4}, "", "", 0.0}, 4.4131965},
                      std::tuple{Weave{"half_persian_3in1", {3, 3}, "", "", 0.0}, 3.8927953},
                      std::tuple{Weave{"half_persian_4in1", {4, 4}, "", "", 0.0}, 4.5394156},
                      std::tuple{Weave{"full_persian_6in1", {6, 6, 6, 6}, "", "", 0.0}, 5.0506407}),
    [](const auto& info) { return std::string(std::get<0>(info.param).name); });

/// Four rings of a chain.
const char* const patch = R"({ "name": "patch",
  "elements": { "ring": { "shape": "torus_union", "tori": [{ "name": "ring" }],
    "parameters": { "ring.R": 5, "ring.r0": 0.7, "ring.r1": 0.7 } } },
  "cell": { "patch": { "vectors": [[12, 0], [0, 12]], "outline": { "rectangle": [2, 1] } },
    "place": [{ "element": "ring", "position": [0, 0, 0] },
              { "element": "ring", "position": [6, 0, 0], "rotation": { "axis": [1, 0, 0], "degrees": 90 } }] },
  "load_case": { "plugin": "paraboloid_bending", "directions_deg": [0] } })";

TEST(RoomFiles, PatchesCanBeLoaded)
{
  const WorkFolder folder;
  const std::string found = folder / "found.json";
  const Outcome o = run_program({"room", folder.write("p.json", patch), "-o", found, "--starts", "3"});
  ASSERT_EQ(o.code, 0) << o.err;
  const Outcome checked = run_program({"check", found, "--thorough"});
  EXPECT_EQ(checked.code, 0) << checked.err;
  // The room found is that of the state that was written.
  const auto first_line = [](const std::string& text) {
    const std::string key = "largest rest clearance ";
    return std::stod(text.substr(text.find(key) + key.size()));
  };
  const Outcome again = run_program({"room", found, "--starts", "1"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_GE(first_line(again.out), first_line(o.out) - 1e-6);
  EXPECT_GT(first_line(o.out), 0.5);
}

TEST(RoomFiles, AWeaveThatIsSweptCanBeLoaded)
{
  const WorkFolder folder;
  const std::string found = folder / "found.json";
  const Outcome o = run_program({"room", folder.write("s.json", R"({ "name": "s", "task": "sweep",
  "cell": { "weave": { "name": "chain", "parameters": { "inner_diameter": 8 } } },
  "load_case": { "plugin": "in_plane_periodic", "directions_deg": [0], "senses": ["stretch"] },
  "sweep": { "vary": [{ "name": "inner diameter", "pointers": ["/cell/weave/parameters/inner_diameter"],
                        "values": [7, 8] }] } })"),
                                 "-o", found, "--starts", "1"});
  ASSERT_EQ(o.code, 0) << o.err;
  const Outcome checked = run_program({"check", found, "--thorough"});
  EXPECT_EQ(checked.code, 0) << checked.err;
}

TEST(RoomFiles, AreNotReplacedAndNothingElseIs)
{
  const WorkFolder folder;
  const std::string file = folder.write("p.json", patch);
  const Outcome own = run_program({"room", file, "-o", file, "--starts", "1"});
  EXPECT_EQ(own.code, 2);
  EXPECT_EQ(own.err, "hauberk: " + file + ": exists already; give another name with -o, or remove it\n");
  EXPECT_EQ(read_text(file), patch);
  folder.write("limits.csv", "results of a run");
  EXPECT_EQ(run_program({"room", file, "-o", folder / "found.json", "--starts", "1"}).code, 0);
  EXPECT_EQ(read_text(folder / "limits.csv"), "results of a run");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 3)
      << "no temporary file is left";
  const Outcome nowhere = run_program({"room", file, "-o", folder / "none/found.json", "--starts", "1"});
  EXPECT_EQ(nowhere.code, 1);
  EXPECT_NE(nowhere.err.find("found.json: cannot be written"), std::string::npos) << nowhere.err;
}

TEST(WeaveFiles, ArePathsToo)
{
  const WorkFolder folder;
  folder.write("own.json", read_text(std::string(HAUBERK_WEAVES) + "/chain.json"));
  const std::string text =
      with(experiment({"chain", {}, "", "", 0.0}), R"("name": "chain")", R"("name": "own.json")");
  EXPECT_EQ(run_program({"check", folder.write("w.json", text), "--thorough"}).code, 0);
  // The results of a run hold what the weave stands for.
  ASSERT_EQ(run_program({"run", folder / "w.json", "-o", folder / "out"}).code, 0);
  const json::value r = read_results(folder / "out");
  EXPECT_FALSE(r.at_pointer("/experiment/cell").as_object().contains("weave"));
  EXPECT_EQ(number_at(r, "/experiment/elements/ring/parameters/ring.R"), 5.0);
  EXPECT_NEAR(number_at(r, "/limits/0/value"), 2.0 * (10.0 - 1.4) / (8.0 / 3.0 * 5.0) - 1.0, 1e-9);
}

TEST(WeaveFiles, PatchesAreCutFromThem)
{
  const WorkFolder folder;
  const std::string text = R"({ "name": "p", "length_unit": "mm",
  "cell": { "weave": { "name": "european_4in1" }, "patch": { "outline": { "rectangle": [2, 3] } } },
  "load_case": { "plugin": "cylinder_roll", "directions_deg": [0], "senses": ["up"],
                 "hold": ["places", "twist", "transverse"] } })";
  ASSERT_EQ(run_program({"run", folder.write("p.json", text), "-o", folder / "out"}).code, 0);
  const json::value r = read_results(folder / "out");
  EXPECT_EQ(r.at_pointer("/scene/elements").as_array().size(), 12U) << "two rings in each of 2 x 3 cells";
  // What results hold is the patch written out, and comes to the same.
  const json::object& cell = r.at_pointer("/experiment/cell").as_object();
  EXPECT_FALSE(cell.contains("weave"));
  EXPECT_FALSE(cell.contains("vectors"));
  folder.write("again.json", write_json(r.at("experiment")));
  ASSERT_EQ(run_program({"run", folder / "again.json", "-o", folder / "again"}).code, 0);
  EXPECT_EQ(number_at(read_results(folder / "again"), "/limits/0/value"), number_at(r, "/limits/0/value"));
  const Outcome own = run_program(
      {"check",
       folder.write("v.json", with(text, R"("patch": {)", R"("patch": { "vectors": [[9, 0], [0, 9]],)"))});
  EXPECT_EQ(own.code, 2);
  EXPECT_NE(own.err.find("/cell/patch/vectors: a patch of a weave is laid out with the weave's vectors"),
            std::string::npos)
      << own.err;
}

TEST(WeaveFiles, SweepsAreResumedOnlyFromTheSame)
{
  const WorkFolder folder;
  const std::string weave = read_text(std::string(HAUBERK_WEAVES) + "/chain.json");
  folder.write("own.json", weave);
  const std::string file =
      folder.write("s.json", R"({ "name": "s", "task": "sweep", "cell": { "weave": { "name": "./own.json" } },
  "load_case": { "plugin": "in_plane_periodic", "directions_deg": [0], "senses": ["stretch"] },
  "sweep": { "vary": [ { "name": "wire", "pointers": ["/cell/weave/parameters/wire_diameter"],
                         "values": [1.2, 1.4] } ] } })");
  const std::string out = folder / "out";
  const Outcome first = run_program({"run", file, "-o", out});
  ASSERT_EQ(first.code, 0) << first.err;
  const json::value results = read_results(out);
  EXPECT_EQ(std::string(results.at_pointer("/provenance/weaves/.~1own.json").as_string()), weave);
  EXPECT_EQ(run_program({"run", file, "-o", out, "--resume"}).code, 0);
  folder.write("own.json", weave + "\n");
  const Outcome other = run_program({"run", file, "-o", out, "--resume"});
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("cannot be resumed: it was computed from another weave of this name"),
            std::string::npos)
      << other.err;
}

TEST(WeaveFiles, MistakesAreReported)
{
  const WorkFolder folder;
  const std::string good = experiment({"chain", {}, "", "", 0.0});
  const auto after = [&](const std::string& from, const std::string& to) {
    const std::string file = folder.write("w.json", with(good, from, to));
    std::string text = run_program({"check", file, "--thorough"}).err;
    const std::size_t at = text.find(file);
    return at == std::string::npos ? text : text.substr(at + file.size());
  };
  EXPECT_EQ(
      after("\"chain\"", "\"japanese_4in2\""),
      ":1: /cell/weave/name: no weave 'japanese_4in2'; did you mean 'japanese_4in1'?; the library has box, "
      "byzantine, chain, dragonscale, european_4in1, european_6in1, fourfold, full_persian_6in1, half_persian_3in1, half_persian_4in1, japanese_4in1, "
      "japanese_6in1, threefold\n");
  // Beside it, what else is wrong with the file.
  const std::string both =
      run_program({"check", folder.write("w.json", with(with(good, "\"chain\"", "\"chian\""),
                                                        "directions_deg", "directions_dg"))})
          .err;
  EXPECT_NE(both.find("no weave 'chian'; did you mean 'chain'?"), std::string::npos) << both;
  EXPECT_NE(both.find("/load_case/directions_dg: "), std::string::npos) << both;
  EXPECT_EQ(std::count(both.begin(), both.end(), '\n'), 2) << both;
  EXPECT_EQ(after("{} }", R"({ "wire": 1 } })"),
            ":1: /cell/weave/parameters/wire: the weave has no parameter 'wire'; known: 'inner_diameter', "
            "'wire_diameter'\n");
  EXPECT_EQ(after("\"cell\": {", R"("cell": { "place": [], )"),
            ":1: /cell/place: a weave has its own places; remove 'place', or the weave\n");
  EXPECT_EQ(after("\"name\": \"w\",", R"("name": "w", "elements": { "ring": { "shape": "torus_union" } },)"),
            ":1: /elements/ring: the weave has an element 'ring' already; rename this one\n");
  EXPECT_EQ(after("{} }", R"({ "wire_diameter": "thick" } })"),
            ":1: /cell/weave/parameters/wire_diameter: expected a number, found \"thick\"\n");
  folder.write("bad.json",
               R"({ "name": "bad", "parameters": {}, "lengths": { "R": { "x": 1 } }, "elements": {},
  "cell": { "vectors": [], "place": [] } })");
  EXPECT_EQ(after("\"chain\"", "\"bad.json\""),
            ":1: /cell/weave: the weave's length 'R' is no sum of its parameters and earlier lengths\n");
}

}  // namespace
}  // namespace hauberk::test
