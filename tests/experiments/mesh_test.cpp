/// Contact of meshes as users run it: exact limits of meshes, the independent check, refusals.

#include "document/json_text.hpp"
#include "program.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

namespace hauberk::test {
namespace {

namespace json = boost::json;

std::string mesh_text(int facets)
{
  return with(chain_text(), "\"preset\": \"accurate\"",
              "\"preset\": \"accurate\", \"contact\": \"mesh\", \"facets\": " + std::to_string(facets));
}

/// N even: a ring of polygons hangs in another with a corner of its chords in the middle of a flat of the
/// other's tube, whose edges, at r sin h (h = pi/N) to either side, rest on these chords: their slope is tan
/// h, so that centres are 2 (R - r cos h - r sin h tan h) = 2 (R - r/cos h) apart.
double exact(int facets) { return 4.0 * (5.0 - 0.7 / std::cos(std::numbers::pi / facets)) / 12.0 - 1.0; }

TEST(Mesh, ExactLimitsOfMeshes)
{
  for (const int facets : {8, 12, 20}) {
    const WorkFolder folder;
    const Outcome o = run_program(
        {"run", folder.write("m.json", mesh_text(facets)), "-o", folder / "out", "--set", "/expect=[]"});
    ASSERT_EQ(o.code, 0) << o.err;
    const json::value results = read_results(folder / "out");
    EXPECT_NEAR(number_at(results, "/limits/0/value"), exact(facets), 1e-8) << facets;
    EXPECT_EQ(run_program({"verify", folder / "out/results.json"}).code, 0);
  }
}

/// A circle given as a curve has the mesh of the torus, so the same limit.
TEST(Mesh, CirclesAsCurves)
{
  const std::string text = with(
      with(mesh_text(12), R"("shape": "torus_union", "tori": [ { "name": "ring" } ])",
           R"("shape": "closed_tube", "curve": "oval")"),
      R"("ring.R": 5.0, "ring.r0": 0.7, "ring.r1": 0.7)", R"("half_length": 5, "half_width": 5, "r": 0.7)");
  const WorkFolder folder;
  const Outcome o =
      run_program({"run", folder.write("m.json", text), "-o", folder / "out", "--set", "/expect=[]"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NEAR(number_at(read_results(folder / "out"), "/limits/0/value"), exact(12), 1e-8);
}

TEST(Mesh, VerifyRecomputesMeshes)
{
  const WorkFolder folder;
  ASSERT_EQ(
      run_program({"run", folder.write("m.json", mesh_text(10)), "-o", folder / "out", "--set", "/expect=[]"})
          .code,
      0);
  const json::value results = read_results(folder / "out");
  const auto caught = [&](const std::string& pointer, double change, const std::string& message) {
    json::value tampered = results;
    json::value& v = tampered.at_pointer(pointer);
    v = v.to_number<double>() + change;
    const Outcome o = run_program({"verify", folder.write("t.json", write_json(tampered))});
    EXPECT_EQ(o.code, 1);
    EXPECT_NE(o.out.find(message), std::string::npos) << "missing: " << message << '\n' << o.out;
  };
  caught("/limits/0/min_gap", 1e-4, "min_gap");
  caught("/limits/0/contacts/0/points/0/2", 1e-4, "off its mesh");
  caught("/limits/0/contacts/0/normal/0", 1e-3, "contact 0: the normal's length");
  caught("/limits/0/contacts/0/force", 1e-2, "forces miss the load");
  caught("/experiment/solver/facets", 1.0, "off its mesh");
}

TEST(Mesh, Refusals)
{
  const WorkFolder folder;
  const auto refused = [&](const std::string& text, const std::string& message) {
    const Outcome o = run_program({"check", folder.write("m.json", text), "--thorough"});
    EXPECT_EQ(o.code, 2);
    EXPECT_NE(o.err.find(message), std::string::npos) << "missing: " << message << '\n' << o.err;
  };
  refused(with(mesh_text(20), "\"contact\": \"mesh\"", "\"contact\": \"arc\""),
          "facets belong to contact 'mesh'; remove this or choose that contact");
  refused(mesh_text(2), "facets");
  refused(mesh_text(4),
          "is so coarse that the curve at the middle of its tube leaves it; use more than 4 facets");
  // Chords cut across holes: surfaces leave room, coarse meshes do not, and relaxation cannot tell on which
  // side they are.
  const std::string mail = with(chainmail_text(), "\"tolerance\": 1e-3",
                                "\"tolerance\": 1e-3, \"contact\": \"mesh\", \"facets\": 10");
  refused(mail, "other pairs; use more facets, or give them more room");
  refused(with(mail, "\"cell\": {", "\"cell\": { \"relax\": true,"), "meet at rest");
}

/// Of a chain of frames, in a folder of its own with the file beside it.
class MeshFiles : public testing::Test {
 protected:
  MeshFiles()
  {
    std::filesystem::copy_file(HAUBERK_SOURCE_DIR "/shapes/mesh/frame.obj", folder_ / "frame.obj");
    std::ifstream file(HAUBERK_SOURCE_DIR "/shapes/mesh/example.json");
    text_.assign(std::istreambuf_iterator<char>(file), {});
  }
  void refused(const std::vector<std::string>& settings, const std::string& message)
  {
    std::vector<std::string> words{"check", folder_.write("m.json", text_)};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    const Outcome o = run_program(words);
    EXPECT_EQ(o.code, 2);
    EXPECT_NE(o.err.find(message), std::string::npos) << "missing: " << message << '\n' << o.err;
  }

  WorkFolder folder_;
  std::string text_;
};

TEST_F(MeshFiles, LimitOfFramesIsExact)
{
  for (const auto& [asked, tolerance] : {std::pair{"1e-3", 1e-3}, std::pair{"2e-9", 1e-8}}) {
    ASSERT_EQ(run_program({"run", folder_.write("m.json", text_), "-o", folder_ / asked, "--set",
                           "/expect=[]", "--set", std::string("/solver/tolerance=") + asked})
                  .code,
              0);
    const json::value results = read_results(folder_ / asked);
    EXPECT_NEAR(number_at(results, "/limits/0/value"), exact(8), tolerance);
    EXPECT_EQ(number_at(results, "/scene/elements/1/primitives/0/surface"), 0.0);
    EXPECT_EQ(results.at_pointer("/scene/surfaces").as_array().size(), 1U);
    EXPECT_EQ(results.at_pointer("/scene/surfaces/0/triangles").as_array().size(), 128U);
    const Outcome verified = run_program({"verify", folder_ / (std::string(asked) + "/results.json")});
    EXPECT_EQ(verified.code, 0) << verified.out;
  }
}

/// A frame of the file hangs in one that contact makes of a tube around a circle: eight facets are the same.
TEST_F(MeshFiles, HangInMeshesOfCurves)
{
  std::string text = with(text_, R"("parameters": { "scale": 1 } })", R"("parameters": { "scale": 1 } },
    "ring": { "shape": "closed_tube", "curve": "oval",
              "parameters": { "half_length": 5, "half_width": 5, "r": 0.7 } })");
  text = with(text, R"({ "element": "link", "position": [6)", R"({ "element": "ring", "position": [6)");
  text = with(text, R"("contact": "mesh" })", R"("contact": "mesh", "facets": 8 })");
  const Outcome o = run_program({"run", folder_.write("m.json", text), "-o", folder_ / "out"});
  ASSERT_EQ(o.code, 0) << o.err << o.out;
  EXPECT_NEAR(number_at(read_results(folder_ / "out"), "/limits/0/value"), exact(8), 1e-8);
  const Outcome verified = run_program({"verify", folder_ / "out/results.json"});
  EXPECT_EQ(verified.code, 0) << verified.out;
}

TEST_F(MeshFiles, VerifyRecomputesThem)
{
  ASSERT_EQ(run_program({"run", folder_.write("m.json", text_), "-o", folder_ / "out"}).code, 0);
  const json::value results = read_results(folder_ / "out");
  const auto caught = [&](const std::string& pointer, const json::value& now, const std::string& message) {
    json::value tampered = results;
    tampered.at_pointer(pointer) = now;
    const Outcome o = run_program({"verify", folder_.write("t.json", write_json(tampered))});
    EXPECT_EQ(o.code, 1);
    EXPECT_NE(o.out.find(message), std::string::npos) << "missing: " << message << '\n' << o.out;
  };
  const auto shifted = [&](const std::string& pointer, double change) {
    return json::value(number_at(results, pointer) + change);
  };
  caught("/limits/0/min_gap", shifted("/limits/0/min_gap", 1e-4), "min_gap");
  caught("/limits/0/contacts/0/points/0/0", shifted("/limits/0/contacts/0/points/0/0", 1e-4), "off its mesh");
  caught("/limits/0/value", shifted("/limits/0/value", 1e-4), "value");
  caught("/scene/surfaces/0/points/3/0", shifted("/scene/surfaces/0/points/3/0", 1e-3),
         "a mean distance of 1 from the origin expected");
  caught("/scene/surfaces/0/triangles/3/0", 15, "/scene/surfaces/0/triangles");
  caught("/scene/surfaces/0/triangles/3/0", 99, "the index of a point expected");
  caught("/scene/elements/0/primitives/0/surface", 1, "the index of one of the scene's surfaces expected");
  caught("/scene/elements/0/primitives/0/parameters/r0", 1.0, "not those of the surface");
  caught("/experiment/solver/contact", "arc", "mesh expected, as the scene has triangle meshes");
  // Frames that are apart at rest are not linked there.
  caught("/scene/elements/1/rest/position/2", 30.0, "linking number of elements");
}

TEST_F(MeshFiles, Refusals)
{
  refused(
      {"/solver/contact=auto"},
      "this scene has elements that are triangle meshes, and contact 'auto' knows surfaces of other kinds "
      "only: set solver.contact to \"mesh\"");
  refused({"/solver/contact=constrained"}, "set solver.contact to \"mesh\"");
  refused({"/solver/contact=published"}, "set solver.contact to \"mesh\"");
  refused({"/solver/ccd=sampled"}, "sampled collision checks");
  refused({"/elements/link/file=ring.obj"}, "there is no such file");
  refused({"/elements/link/file=m.json"}, "expected a file .obj or .stl");
  refused({"/cell/vectors=[[18.5,0],[0,100]]", "/cell/place/1/position=[9.25,0,0]"},
          "meet at rest, as do 1 other pairs; move them apart");
  folder_.write("frame.obj", "v 1 2\n");
  refused({}, "frame.obj:1: expected three numbers after 'v'");
}

/// Where the file is, it is found from: the experiment's folder, also for rows of sweeps, whatever the
/// working directory is.
TEST_F(MeshFiles, RowsOfSweepsFindTheFile)
{
  const std::string sweep =
      with(text_, "\"task\": \"limits\"",
           "\"task\": \"sweep\", \"sweep\": { \"vary\": [ { \"name\": \"scale\", \"values\": "
           "[1, 1.05], \"pointers\": [\"/elements/link/parameters/scale\"] } ] }");
  const Outcome o = run_program({"run", folder_.write("s.json", sweep), "-o", folder_ / "out", "--set",
                                 "/solver/tolerance=1e-3", "--set", "/expect=[]"});
  ASSERT_EQ(o.code, 0) << o.err;
  const json::value results = read_results(folder_ / "out");
  EXPECT_NEAR(number_at(results, "/sweep/rows/1/result/limits/0/value"), 1.05 * (exact(8) + 1.0) - 1.0, 1e-3);
}

/// The experiment is the same, what it names is not.
TEST_F(MeshFiles, ResumedOnlyWithTheSameFile)
{
  const std::string sweep =
      with(text_, "\"task\": \"limits\"",
           "\"task\": \"sweep\", \"sweep\": { \"vary\": [ { \"name\": \"frame\", \"values\": "
           "[\"frame.obj\", \"other.obj\"], \"pointers\": [\"/elements/link/file\"] } ] }");
  for (const auto& [text, other] : {std::pair{text_, "frame.obj"}, std::pair{sweep, "other.obj"}}) {
    std::ifstream file(HAUBERK_SOURCE_DIR "/shapes/mesh/frame.obj");
    const std::string frame{std::istreambuf_iterator<char>(file), {}};
    for (const char* name : {"frame.obj", "other.obj"}) folder_.write(name, frame);
    const std::string out = folder_ / (std::string("results of ") + other);
    const std::vector<std::string> run{"run",     folder_.write("m.json", text), "-o",    out,
                                       "--set",   "/solver/tolerance=1e-3",      "--set", "/expect=[]",
                                       "--resume"};
    ASSERT_EQ(run_program(run).code, 0);
    EXPECT_TRUE(read_results(out).at_pointer("/provenance/files").as_object().contains(other));
    EXPECT_EQ(run_program(run).code, 0);
    folder_.write(other, frame + "# thinner one day\n");
    const Outcome changed = run_program(run);
    EXPECT_EQ(changed.code, 2);
    EXPECT_NE(changed.err.find("cannot be resumed: it was computed from another file of the same name"),
              std::string::npos)
        << changed.err;
  }
}

TEST_F(MeshFiles, RoomIsFound)
{
  const Outcome o = run_program({"room", folder_.write("m.json", text_), "--starts", "1", "--fixed-cell"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("largest rest clearance"), std::string::npos) << o.out;
}

/// What is written elsewhere refers to the same file.
TEST_F(MeshFiles, ExperimentsWrittenElsewhereFindTheFile)
{
  std::filesystem::create_directories(folder_ / "deep/er");
  const std::string file = folder_.write("m.json", text_), moved = folder_ / "deep/er/room.json";
  const Outcome o = run_program({"room", file, "--starts", "1", "--fixed-cell", "-o", moved});
  ASSERT_EQ(o.code, 0) << o.err;
  const Outcome found = run_program({"check", moved, "--thorough"});
  EXPECT_EQ(found.code, 0) << found.err;
  std::ifstream in(moved);
  const std::string written{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(written.find("\"../../frame.obj\""), std::string::npos) << written;
}

}  // namespace
}  // namespace hauberk::test
