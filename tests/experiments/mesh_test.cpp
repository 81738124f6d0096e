/// Contact of meshes as users run it: exact limits of meshes, the independent check, refusals.

#include "program.hpp"

#include <hauberk/results/json_text.hpp>

#include <gtest/gtest.h>

#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <cmath>
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
    const TemporaryFolder folder;
    const Outcome o = run_program(
        {"run", folder.write("m.json", mesh_text(facets)), "-o", folder / "out", "--set", "/expect=[]"});
    ASSERT_EQ(o.code, 0) << o.err;
    const json::value results = read_results(folder / "out");
    EXPECT_NEAR(number_at(results, "/limits/0/value"), exact(facets), 1e-8) << facets;
    EXPECT_EQ(run_program({"verify", folder / "out/results.json"}).code, 0);
  }
}

TEST(Mesh, VerifyRecomputesMeshes)
{
  const TemporaryFolder folder;
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
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const std::string& message) {
    const Outcome o = run_program({"check", folder.write("m.json", text)});
    EXPECT_EQ(o.code, 2);
    EXPECT_NE(o.err.find(message), std::string::npos) << "missing: " << message << '\n' << o.err;
  };
  refused(with(mesh_text(20), "\"contact\": \"mesh\"", "\"contact\": \"arc\""),
          "facets belong to contact 'mesh'; remove this or choose that contact");
  refused(mesh_text(2), "facets");
  refused(mesh_text(4),
          "is so coarse that the circle at the middle of its tube leaves it; use more than 4 facets");
  // Chords cut across holes: surfaces leave room, coarse meshes do not, and relaxation cannot tell on which
  // side they are.
  const std::string mail = with(chainmail_text(), "\"preset\": \"fast\"",
                                "\"preset\": \"fast\", \"contact\": \"mesh\", \"facets\": 10");
  refused(mail, "other pairs; use more facets, or give them more room");
  refused(with(mail, "\"cell\": {", "\"cell\": { \"relax\": true,"), "meet at rest");
}

}  // namespace
}  // namespace hauberk::test
