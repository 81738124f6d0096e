/// The command line itself.

#include "document/json_text.hpp"
#include "program.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

namespace hauberk::test {
namespace {

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Wrong command lines say what is wrong, then how it should look.
void expect_usage(const std::vector<std::string>& arguments, const std::string& message,
                  const std::string& usage)
{
  const Outcome o = run_program(arguments);
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(first_line(o.err), "hauberk: " + message);
  EXPECT_NE(o.err.find(usage), std::string::npos) << o.err;
  EXPECT_EQ(o.out, "");
}

TEST(CommandLine, WrongCommands)
{
  expect_usage({}, "no command given", "Usage:\n  hauberk run ");
  expect_usage({"rnu"}, "unknown command 'rnu'; did you mean 'run'?", "Usage:\n  hauberk run ");
  expect_usage({"plugins", "remove"}, "plugins: expected list, describe, conform or new, found 'remove'",
               "Usage: hauberk plugins ");
  expect_usage({"plugins", "describe"}, "describe: expected the id of one plugin", "Usage: hauberk plugins ");
  expect_usage({"plugins new"}, "unknown command 'plugins new'", "Usage:\n  hauberk run ");
  expect_usage({"completion", "tcsh"}, "completion: expected bash, zsh or fish, found 'tcsh'",
               "Usage: hauberk completion ");
  expect_usage({"man", "run"}, "expected options only, found 'run'", "Usage: hauberk man\n");
}

TEST(CommandLine, WrongOptions)
{
  expect_usage({"run"}, "EXPERIMENT.json is missing", "Usage: hauberk run ");
  expect_usage({"run", "a", "b"}, "one EXPERIMENT.json expected, found also 'b'", "Usage: hauberk run ");
  expect_usage({"run", "a", "--forc"}, "unrecognised option '--forc'", "Usage: hauberk run ");
  expect_usage({"run", "a", "--threads", "many"}, "the argument ('many') for option '--threads' is invalid",
               "Usage: hauberk run ");
  expect_usage({"run", "a", "--threads", "0"}, "--threads: expected a number from 1 to 4096, found 0",
               "Usage: hauberk run ");
  expect_usage({"verify"}, "RESULTS.json is missing", "Usage: hauberk verify ");
  expect_usage({"plugins", "new"}, "NAME DIR is missing", "Usage: hauberk plugins new ");
  expect_usage({"plugins", "new", "a"}, "expected NAME and DIR", "Usage: hauberk plugins new ");
  expect_usage({"plugins", "new", "a", "b", "c"}, "expected NAME and DIR", "Usage: hauberk plugins new ");
}

TEST(CommandLine, HelpAndVersion)
{
  for (const char* command : {"run", "check", "plan", "room", "gather", "submit", "verify", "report",
                              "plugins", "completion", "man"}) {
    const Outcome o = run_program({command, "--help"});
    EXPECT_EQ(o.code, 0);
    EXPECT_EQ(o.out.find(std::string("Usage: hauberk ") + command), 0U) << o.out;
  }
  EXPECT_NE(run_program({"--help"}).out.find("Exit codes: 0 done; 1 "), std::string::npos);
  EXPECT_EQ(run_program({"--version"}).out.find("hauberk 0."), 0U);
}

/// The whole text: it is part of the reference, and scripts of completion are made from the same table.
TEST(CommandLine, Help)
{
  EXPECT_EQ(
      run_program({"--help"}).out,
      R"(Deformation limits of discrete interlocking materials: how far a fabric of linked rigid elements
stretches and compresses before contact locks it, and element shapes that have the limits you want.

Usage:
  hauberk run EXPERIMENT.json [-o DIR] [--force] [--threads N] [--set path=value ...]
      compute what the experiment asks for
  hauberk check EXPERIMENT.json
      every problem in the file at once, with its place
  hauberk plan EXPERIMENT.json
      what will be modelled, and why; the rest state
  hauberk room EXPERIMENT.json [--starts N] [-o FILE]
      the thickest rings that leave a rest state
  hauberk gather DIR [--missing] [--force] [--threads N]
      join the parts of a divided run
  hauberk submit EXPERIMENT.json --engine slurm --array N [-o DIR] [--dry-run]
      compute an experiment in parts on a cluster
  hauberk verify RESULTS.json
      recheck a result from its file alone
  hauberk report RESULT... -o DIR [--force] [--recheck FOLDER]
      a table and a page of plots of many results
  hauberk export FILE.json -o OUT.{stl,obj,3mf,glb,vtu,html,png} [--state S]
      a fabric to print, to look at or to compute with
  hauberk inspect MODEL.{stl,obj,3mf} [--gap X] [--json]
      what a printed model is: bodies, gaps, links
  hauberk weave {NAME | all} --inner LENGTH --wire LENGTH
      a maker's answers: room, stretch, weight of a weave
  hauberk plugins [list | describe ID | conform FILE.so | new NAME DIR]
      shapes, load cases and optimizers that are found
  hauberk completion bash|zsh|fish
      a script that lets a shell complete commands, options and files
  hauberk man
      the manual page, as roff: hauberk man | man -l -
  hauberk --version
  hauberk --help; hauberk COMMAND --help for the options of a command

Exit codes: 0 done; 1 the computation failed, what was computed is on disk; 2 bad input, nothing
written; 130 interrupted, partial results are on disk.
)");
  EXPECT_EQ(run_program({"plugins", "new", "--help"}).out,
            R"(Usage: hauberk plugins new --kind shape|solid|load_case|patch|optimizer NAME DIR
Writes a small complete project of a plugin to DIR: it builds, conforms and runs as it is.

Options:
  -h [ --help ]         show this and exit
  --kind KIND           shape, solid, load_case, patch or optimizer
)");
}

/// The answers of commands as documents: exit codes and what they say are those of the text.
TEST(CommandLine, Json)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", chain_text());
  const auto document = [](const Outcome& o) { return parse_json(o.out, "answer"); };
  Outcome o = run_program({"check", file, "--json", "--thorough"});
  EXPECT_EQ(o.code, 0);
  EXPECT_TRUE(document(o).at("ok").as_bool());
  EXPECT_NE(std::string(document(o).at("summary").as_string()).find(" elements, "), std::string::npos);

  o = run_program(
      {"check", file, "--json", "--set", "/solver/starts=0", "--set", "/cell/repeat=[0,1]", "--thorough"});
  EXPECT_EQ(o.code, 2);
  const boost::json::array problems = document(o).at("problems").as_array();
  ASSERT_EQ(problems.size(), 2U) << o.out;
  EXPECT_FALSE(document(o).at("ok").as_bool());
  EXPECT_TRUE(document(o).at("summary").is_null());
  for (const boost::json::value& problem : problems) EXPECT_FALSE(problem.at("message").as_string().empty());

  ASSERT_EQ(run_program({"run", file, "-o", folder / "out", "--quiet"}).code, 0);
  o = run_program({"verify", folder / "out", "--json"});
  EXPECT_EQ(o.code, 0);
  EXPECT_TRUE(document(o).at("ok").as_bool());
  EXPECT_EQ(document(o).at("fields").at("failed").as_int64(), 0);
  EXPECT_GT(document(o).at("fields").at("passed").as_int64(), 100);

  o = run_program({"room", file, "--json", "--starts", "1"});
  EXPECT_EQ(o.code, 0);
  const boost::json::value room = document(o);
  const boost::json::value& ring = room.at("rings").at(0);
  // Two circles of a chain are at most R apart (the bound by discs: ratio 2), which the search comes close
  // to.
  EXPECT_GE(ring.at("smallest_ratio").as_double(), 2.0) << o.out;
  EXPECT_LT(ring.at("smallest_ratio").as_double(), 2.001) << o.out;
  EXPECT_NEAR(ring.at("thickest_wire").as_double(), ring.at("wire").as_double() + room.at("room").as_double(),
              1e-12);

  o = run_program({"plugins", "list", "--json"});
  EXPECT_EQ(o.code, 0);
  bool torus_union = false;
  const boost::json::value plugins = document(o);
  for (const boost::json::value& plugin : plugins.as_array()) {
    torus_union = torus_union || (plugin.at("id") == "torus_union" && plugin.at("kind") == "shape");
  }
  EXPECT_TRUE(torus_union) << o.out;
}

TEST(CommandLine, Check)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", chain_text());
  const Outcome o = run_program({"check", file, "--thorough"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.out, file + ": no problems; 2 elements, 1 limits\n");
}

TEST(CommandLine, PlanAsJsonIsThatOfTheResults)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", chain_text());
  const Outcome text = run_program({"plan", file});
  EXPECT_EQ(text.code, 0);
  EXPECT_NE(text.out.find("links per element: 2 each\n"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("stretch attained: 0 degrees\n"), std::string::npos) << text.out;
  const Outcome json = run_program({"plan", file, "--json"});
  ASSERT_EQ(run_program({"run", file, "-o", folder / "out"}).code, 0);
  boost::json::value shown = parse_json(json.out, "plan");
  // Every ring and its own image are a period apart; linked rings are farther apart than 0.3 L.
  const boost::json::array tightest = shown.at("tightest").as_array();
  ASSERT_EQ(tightest.size(), 2U);
  EXPECT_NE(tightest[0].at("elements"), tightest[1].at("elements"));
  for (const boost::json::value& pair : tightest) {
    const std::int64_t ring = pair.at("elements").at(0).to_number<std::int64_t>();
    EXPECT_EQ(pair.at("elements"), (boost::json::array{ring, ring}));
    EXPECT_EQ(pair.at("image"), (boost::json::array{1, 0}));
    EXPECT_NEAR(pair.at("distance").to_number<double>(), 0.6, 1e-12);
    EXPECT_FALSE(pair.at("linked").as_bool());
    EXPECT_NE(text.out.find(fmt::format("    {0}.0 - {0}.0 of image [1, 0]: 0.6", ring)), std::string::npos)
        << text.out;
  }
  shown.as_object().erase("tightest");
  EXPECT_EQ(shown, read_results(folder / "out").at("plan"));
}

TEST(CommandLine, PlansSayWhichContactLeads)
{
  const WorkFolder folder;
  const auto contact_of = [](const std::string& file) {
    const std::string text = run_program({"plan", file}).out;
    const std::size_t at = text.find("contact: ");
    return at == std::string::npos ? text : text.substr(at, text.find_first_of(",\n", at) - at);
  };
  EXPECT_EQ(contact_of(folder.write("c.json", chain_text())),
            "contact: arc down to an activation distance of 0.0003 L");
  EXPECT_EQ(contact_of(HAUBERK_SOURCE_DIR "/shapes/rounded_ring/example.json"), "contact: nearest");
}

TEST(CommandLine, PlansOfTasksSayWhatTheyTake)
{
  // Six ratios, each of a stretch and a compression; stages from 0.03 L, by factors not below a tenth, to the
  // 0.003 L of the first search and the 1e-4 L of the last.
  const std::string design = HAUBERK_SOURCE_DIR "/share/experiments/chainmail_c.json";
  const boost::json::value plan = parse_json(run_program({"plan", design, "--json"}).out, "plan");
  const boost::json::object& task = plan.at("task").as_object();
  EXPECT_EQ(task.at("limits_per_evaluation"), 12);
  EXPECT_EQ(task.at("variables").as_array().size(), 16U);
  EXPECT_EQ(task.at("first_search").at("stages"), 2);
  EXPECT_EQ(task.at("final_search").at("stages"), 4);
  EXPECT_EQ(plan.at("stages").as_array().size(), 9U);
  const std::string text = run_program({"plan", design}).out;
  EXPECT_NE(text.find("\nTask design\n  variables:\n    0/ring.R from 4 to 6.5\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("  first search: stages 2 last activation distance 0.003\n"), std::string::npos)
      << text;

  const std::string sweep = HAUBERK_SOURCE_DIR "/share/experiments/ratio_european_4in1.json";
  const boost::json::value rows = parse_json(run_program({"plan", sweep, "--json"}).out, "plan");
  EXPECT_EQ(rows.at("task").at("rows"), 11);
  EXPECT_EQ(rows.at("task").at("limits_per_row"), 4);
  EXPECT_EQ(rows.at("task").at("refused_as_input"), 0);
}

TEST(CommandLine, Plugins)
{
  const Outcome list = run_program({"plugins", "list"});
  EXPECT_EQ(list.code, 0);
  for (const char* id : {"torus_union ", "in_plane_periodic ", "sqp ", "bfgs ", "nlopt "})
    EXPECT_NE(list.out.find(id), std::string::npos) << list.out;
  EXPECT_EQ(run_program({"plugins"}).out, list.out);
  const Outcome one = run_program({"plugins", "describe", "sqp"});
  EXPECT_EQ(one.code, 0);
  EXPECT_NE(one.out.find("max_iterations"), std::string::npos) << one.out;
  // A shape's parameters depend on its fields, unless it has none.
  const std::string yes = "keeps equations: yes; draws random numbers: no;",
                    no = "keeps equations: no; draws";
  EXPECT_NE(one.out.find(yes), std::string::npos) << one.out;
  EXPECT_NE(run_program({"plugins", "describe", "nelder_mead"}).out.find(no), std::string::npos);
  const Outcome shape = run_program({"plugins", "describe", "closed_tube"});
  EXPECT_NE(shape.out.find("Its parameters depend on these fields."), std::string::npos) << shape.out;
  const Outcome none = run_program({"plugins", "describe", "spq"});
  EXPECT_EQ(none.code, 2);
  EXPECT_EQ(none.err.find("hauberk: no plugin 'spq'; did you mean 'sqp'? (searched: "), 0U) << none.err;
}

}  // namespace
}  // namespace hauberk::test
