/// `hauberk run` from an experiment to files.

#include "document/json_text.hpp"
#include "program.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;
namespace json = boost::json;

TEST(Run, ChainLocksAtTheFormula)
{
  const WorkFolder folder;
  const Outcome o = run_program({"run", folder.write("chain.json", chain_text()), "-o", folder / "out"});
  EXPECT_EQ(o.code, 0) << o.err;
  const json::value r = read_results(folder / "out");
  EXPECT_EQ(r.at("format").as_string(), "hauberk-results/2");
  // Period 2 (R_A + R_B - r_A - r_B) = 17.2 over 12.
  EXPECT_NEAR(number_at(r, "/limits/0/value"), 17.2 / 12.0 - 1.0, 1e-8 * 17.2 / 12.0);
  EXPECT_EQ(r.at_pointer("/limits/0/status").as_string(), "locked");
  EXPECT_EQ(r.at_pointer("/limits/0/load_case").as_string(), "in_plane_periodic");
  EXPECT_EQ(r.at_pointer("/experiment/solver/contact").as_string(), "auto");  // defaults are filled in
  EXPECT_EQ(r.at_pointer("/plan/links_per_element").as_array(), json::array({2, 2}));
  EXPECT_EQ(r.at_pointer("/provenance/plugins").as_array().size(), 2U);
  EXPECT_EQ(number_at(r, "/profiles/0/e_s"), number_at(r, "/limits/0/value"));
  for (const char* file : {"limits.csv", "profile.svg"})
    EXPECT_GT(fs::file_size(folder.path() / "out" / file), 0U);
  EXPECT_NE(o.out.find("0.43333333"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("all 1 expected results are met\n"), std::string::npos) << o.out;
  EXPECT_NE(o.err.find("limits, searches: 1/1"), std::string::npos) << o.err;
}

TEST(Run, QuietShowsNoProgress)
{
  const WorkFolder folder;
  const Outcome o =
      run_program({"run", folder.write("c.json", chain_text()), "-o", folder / "out", "--quiet"});
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "");
}

TEST(Run, SetReplacesValues)
{
  const WorkFolder folder;
  const Outcome o = run_program(
      {"run", folder.write("c.json", chain_text()), "-o", folder / "out", "--set", "/solver/clearance=0.1"});
  EXPECT_EQ(o.code, 0) << o.err;
  // Surfaces stop 0.1 apart at two contacts of each of two links.
  EXPECT_NEAR(number_at(read_results(folder / "out"), "/limits/0/value"), 17.0 / 12.0 - 1.0, 1e-8);
}

/// What a file expects is said of its own answers: another scene has others, another search has the same.
TEST(Run, ExpectationsAreOfTheFileAsItIs)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", chain_text()), out = folder / "out";
  const auto run = [&](const std::vector<const char*>& settings) {
    std::vector<std::string> words{"run", file, "-o", out, "--force"};
    for (const char* setting : settings) words.insert(words.end(), {"--set", setting});
    return run_program(words);
  };
  const auto kept = [&] { return read_results(out).at_pointer("/experiment/expect").as_array().size(); };
  const Outcome searched = run({"/solver/starts=2", "/seed=7", "/name=other"});
  EXPECT_EQ(searched.code, 0) << searched.out;
  EXPECT_NE(searched.out.find("all 1 expected results are met\n"), std::string::npos) << searched.out;
  EXPECT_EQ(kept(), 1U);
  const Outcome other = run({"/solver/starts=2", "/solver/clearance=0.1"});
  EXPECT_EQ(other.code, 0) << other.out;
  EXPECT_NE(other.out.find("not checked: what the file expects, as --set /solver/clearance makes another "
                           "experiment of it\n"),
            std::string::npos)
      << other.out;
  EXPECT_EQ(kept(), 0U);
  EXPECT_EQ(run({"/solver/clearance=0.1", "/expect/0/abs=1e-3"}).code, 1);
}

TEST(Run, MissedExpectationsFailAfterWriting)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", with(chain_text(), "0.43333333333333", "0.4334"));
  const Outcome o = run_program({"run", file, "-o", folder / "out"});
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(
      o.out.find(
          "expected result missed: /limits/0/value: expected 0.4334 within 1e-08 relative, found 0.43333"),
      std::string::npos)
      << o.out;
  EXPECT_TRUE(fs::exists(folder / "out/results.json"));
}

/// What links do not stop is tried: rings of a chain jam when it is compressed, rows of chains part for ever.
TEST(Run, UnboundedIsAnAnswer)
{
  const WorkFolder folder;
  const std::string text = with(with(chain_text(), R"(, "senses": ["stretch"])", ""),
                                R"("directions_deg": [0])", R"("directions_deg": [0, 90])");
  const Outcome o = run_program({"run", folder.write("c.json", text), "-o", folder / "out"});
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  const json::value r = read_results(folder / "out");
  EXPECT_EQ(r.at_pointer("/limits/1/sense").as_string(), "compress");
  EXPECT_EQ(r.at_pointer("/limits/1/status").as_string(), "locked");
  // One ring's images along the chain are at least two tube radii apart: 1 + value >= 1.4/12.
  EXPECT_GT(number_at(r, "/limits/1/value"), 1.4 / 12.0 - 1.0);
  EXPECT_EQ(r.at_pointer("/limits/2/status").as_string(), "unbounded");
  EXPECT_EQ(run_program({"verify", folder / "out/results.json"}).code, 0) << "its witness";
}

/// A sheet of pairs of rings that nothing links to other pairs: pulled either way it comes apart, though the
/// rings of a pair stay together, which their places in the stretched lattice do not.
TEST(Run, ASheetThatComesApartHasAWitness)
{
  const WorkFolder folder;
  const std::string text = with(
      with(with(chain_text(), "[12, 0]", "[18, 0]"), R"("position": [6, 0, 0])", R"("position": [5, 0, 0])"),
      R"("directions_deg": [0])", R"("directions_deg": [0, 90])");
  const Outcome o =
      run_program({"run", folder.write("c.json", text), "-o", folder / "out", "--set", "/expect=[]"});
  ASSERT_EQ(o.code, 0) << o.out << o.err;
  json::value r = read_results(folder / "out");
  for (const char* limit : {"/limits/0", "/limits/1"})
    EXPECT_EQ(r.at_pointer(std::string(limit) + "/status").as_string(), "unbounded") << limit;
  const Outcome check = run_program({"verify", folder / "out/results.json"});
  EXPECT_EQ(check.code, 0);
  EXPECT_NE(check.out.find("free of intersection"), std::string::npos) << check.out;
  // A forged one: in the middle of the way a ring has left its partner.
  json::array& witness = r.at_pointer("/limits/0/witness").as_array();
  ASSERT_GT(witness.size(), 2U);
  json::value& x = witness[witness.size() / 2].at_pointer("/poses/0/position/1");
  x = x.to_number<double>() + 11.0;
  EXPECT_EQ(run_program({"verify", folder.write("forged.json", write_json(r))}).code, 1);
}

TEST(Run, UnfinishedLimitsFailTheRun)
{
  const WorkFolder folder;
  const Outcome o = run_program({"run", folder.write("c.json", chain_text()), "-o", folder / "out", "--set",
                                 "/solver/max_iterations=1", "--set", "/expect=[]"});
  EXPECT_EQ(o.code, 1) << o.out;
  EXPECT_EQ(read_results(folder / "out").at_pointer("/limits/0/status").as_string(), "stalled");
  EXPECT_NE(o.out.find("stretch at 0 degrees: stalled"), std::string::npos) << o.out;
}

/// A chain whose second ring leans over, so that tubes are nearly parallel where they touch: nearest points
/// merge, the energy is flat to rounding, and the forces on what is left of them miss the load.
TEST(Run, UnbalancedForcesAreNoLockedState)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", with(chain_text(), R"("degrees": 90)", R"("degrees": 32)"));
  const Outcome o = run_program({"run", file, "-o", folder / "out", "--set", "/solver/contact=nearest"});
  const json::value r = read_results(folder / "out");
  EXPECT_EQ(r.at_pointer("/limits/0/status").as_string(), "stalled");
  EXPECT_NE(r.at_pointer("/limits/0/message").as_string().find("contact forces miss the load by "),
            std::string::npos);
  EXPECT_EQ(o.code, 1) << o.out;
  EXPECT_EQ(run_program({"verify", folder / "out/results.json"}).code, 0) << "says so itself";
  // Spread forces balance.
  const Outcome arc = run_program({"run", file, "-o", folder / "arc", "--set", "/solver/contact=arc"});
  EXPECT_EQ(arc.code, 0) << arc.out;
}

/// Taut to 1e-6 mm at rest: gaps of preset fast do not fit, and opening them would be a stretch limit below
/// zero.
TEST(Run, LimitsOnTheWrongSideOfRestAreNone)
{
  const WorkFolder folder;
  const std::string file =
      folder.write("c.json", with(with(chain_text(), "[12, 0]", "[17.199999, 0]"), R"("position": [6, 0, 0])",
                                  R"("position": [8.5999995, 0, 0])"));
  const Outcome fast = run_program(
      {"run", file, "-o", folder / "fast", "--set", "/solver/tolerance=1e-3", "--set", "/expect=[]"});
  EXPECT_EQ(fast.code, 1) << fast.out;
  EXPECT_NE(
      fast.out.find("stretch at 0 degrees: stalled: rest is nearer to the limit than the gaps that this "
                    "schedule leaves: value -4."),
      std::string::npos)
      << fast.out;
  const Outcome accurate = run_program({"run", file, "-o", folder / "accurate", "--set", "/expect=[]"});
  EXPECT_EQ(accurate.code, 0) << accurate.out;
  EXPECT_NEAR(number_at(read_results(folder / "accurate"), "/limits/0/value"), 17.2 / 17.199999 - 1.0, 1e-8);
}

TEST(Run, SameResultsForAnyNumberOfThreads)
{
  const WorkFolder folder;
  const std::string file = folder.write("mail.json", chainmail_text());
  std::vector<json::value> results;
  std::vector<std::string> texts;
  for (const char* n : {"1", "2", "5"}) {
    const std::string out = folder / (std::string("out") + n);
    ASSERT_EQ(run_program({"run", file, "-o", out, "--threads", n}).code, 0);
    const json::value r = read_results(out);
    const json::value run = read_timings(out);
    EXPECT_EQ(number_at(run, "/threads"), std::stod(n));
    // Bytes, not pages or kibibytes: a program with these libraries needs some MB, such a cell not many more.
    EXPECT_GT(number_at(run, "/peak_memory_bytes"), 4e6);
    EXPECT_LT(number_at(run, "/peak_memory_bytes"), 200e6);
    EXPECT_EQ(run.at("seconds").as_object().size(), 6U) << "a time for each limit";
    results.push_back(r);
    texts.push_back(read_text(std::filesystem::path(out) / "results.json") +
                    read_text(std::filesystem::path(out) / "limits.csv") +
                    read_text(std::filesystem::path(out) / "profile.svg"));
  }
  ASSERT_EQ(results[0].at("limits").as_array().size(), 6U);
  EXPECT_EQ(texts[0], texts[1]) << "the same bytes";
  EXPECT_EQ(texts[0], texts[2]) << "the same bytes";
}

TEST(Run, FolderWithResultsIsRefusedWithoutForce)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", chain_text());
  ASSERT_EQ(run_program({"run", file, "-o", folder / "out"}).code, 0);
  const std::string before = read_text(folder / "out/results.json");
  const Outcome refused = run_program({"run", file, "-o", folder / "out", "--set", "/solver/tolerance=1e-3"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.err,
            "hauberk: " + (folder / "out") +
                ": holds results already (results.json); give another folder with -o, or --force\n");
  EXPECT_EQ(read_text(folder / "out/results.json"), before);
  EXPECT_EQ(run_program({"run", file, "-o", folder / "out", "--force", "--set", "/solver/tolerance=1e-3",
                         "--set", "/expect=[]"})
                .code,
            0);
  EXPECT_NE(read_text(folder / "out/results.json"), before);
}

TEST(Run, FolderThatCannotBeMade)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", chain_text());
  const Outcome o = run_program({"run", file, "-o", file + "/out"});
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(o.err, "hauberk: " + file +
                       "/out: this output folder cannot be made: Not a directory; give another one with "
                       "-o\n");
}

}  // namespace
}  // namespace hauberk::test
