/// Names that would act where they are shown: on a terminal, in a table, a picture or a page.

#include "document/json_text.hpp"
#include "result_files.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <fstream>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;

/// Clears the screen, turns the direction of writing, ends a line, a cell, a tag and a script.
constexpr const char* acting =
    R"(=1+1\u001b[2J\u009b31m\u202e\u2066\r\n\u0007</text></script><b>|`[x](y) \",;\u007f)";

bool acts(const std::string& text)
{
  for (const char* bad : {"\x1b", "\xc2\x9b", "\xe2\x80\xae", "\xe2\x81\xa6", "\a", "\x7f", "\r"})
    if (text.find(bad) != std::string::npos) return true;
  return false;
}

TEST(HostileNames, ActNowhere)
{
  const WorkFolder folder;
  const std::string name = std::string(R"("name": ")") + acting + '"';
  std::string text = with(sweep_text(), R"("name": "chains")", name);
  text = with(text, R"("name": "R")", name);
  text = with(text, R"("name": "r",)", R"("name": "=cmd",)");
  const std::string file = folder.write("s.json", text);
  const std::string out = folder / "out";
  const Outcome o = run_program({"run", file, "-o", out, "--set", "/expect=[]"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_FALSE(acts(o.out)) << o.out;
  EXPECT_FALSE(acts(o.err)) << o.err;
  EXPECT_NE(o.out.find("\\x1b[2J\\x9b31m\\u{202e}\\u{2066}\\x0d"), std::string::npos) << o.out;
  for (const std::vector<std::string>& words : {std::vector<std::string>{"plan", file},
                                                {"check", file, "--thorough"},
                                                {"plan", file, "--json"},
                                                {"verify", out}}) {
    const Outcome shown = run_program(words);
    EXPECT_EQ(shown.code, 0) << words.front() << shown.err;
    EXPECT_FALSE(acts(shown.out + shown.err)) << words.front() << ": " << shown.out;
  }
  // A document for programs has the names themselves.
  const boost::json::value plan = parse_json(run_program({"plan", file, "--json"}).out, "plan");
  EXPECT_NE(std::string(plan.at_pointer("/task/axes/0").as_string()).find("\xe2\x80\xae"), std::string::npos);

  const std::string table = read_text(out + "/sweep.csv");
  EXPECT_FALSE(acts(table)) << table;
  EXPECT_TRUE(table.starts_with("\"'=1+1")) << table;
  EXPECT_NE(table.find(",'=cmd,"), std::string::npos) << table;
  const std::string picture = read_text(out + "/sweep.svg");
  EXPECT_FALSE(acts(picture));
  EXPECT_EQ(picture.find("<b>"), std::string::npos);
  EXPECT_TRUE(picture.ends_with("</svg>\n"));
}

/// A results file is somebody else's, too.
TEST(HostileNames, OfResultsActNowhere)
{
  const WorkFolder folder;
  const std::string out = folder / "out";
  ASSERT_EQ(run_program({"run", folder.write("e.json", chain_text()), "-o", out}).code, 0);
  boost::json::value results = read_results(out);
  const boost::json::value name = parse_json(std::string("\"") + acting + "\"", "name");
  results.at_pointer("/experiment/name") = name;
  results.at_pointer("/limits/0/sense") = name;
  results.at_pointer("/limits/0/message") = name;
  std::ofstream(out + "/results.json") << write_json(results);
  const Outcome verified = run_program({"verify", out});
  EXPECT_FALSE(acts(verified.out + verified.err)) << verified.out;
  const Outcome report = run_program({"report", out, "-o", folder / "report"});
  EXPECT_FALSE(acts(report.out + report.err)) << report.out;
  ASSERT_EQ(report.code, 0) << report.err;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path() / "report")) {
    const std::string text = read_text(entry.path());
    EXPECT_FALSE(acts(text)) << entry.path();
    EXPECT_EQ(text.find(",=1+1"), std::string::npos) << entry.path();
    if (entry.path().extension() != ".csv") {
      EXPECT_EQ(text.find("</text></script>"), std::string::npos) << entry.path();
    }
  }
  for (const char* format : {"page.html", "fabric.3mf", "fabric.obj", "fabric.vtu"}) {
    const Outcome o = run_program({"export", out + "/results.json", "-o", folder / format});
    EXPECT_FALSE(acts(o.out + o.err)) << format << o.out << o.err;
    if (o.code != 0) continue;
    const std::string text = read_text(folder / format);
    EXPECT_EQ(text.find("</script><b>"), std::string::npos) << format;
    EXPECT_EQ(text.find("</text></script>"), std::string::npos) << format;
  }
}

TEST(HostileNames, FiftyProblemsAreEnough)
{
  const WorkFolder folder;
  std::string places;
  for (int k = 0; k < 80; ++k) places += R"({ "element": "none", "position": [0, 0, 0] }, )";
  const std::string file =
      folder.write("e.json", with(chain_text(), R"("place": [)", "\"place\": [" + places));
  const Outcome o = run_program({"check", file, "--thorough"});
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 51) << o.err;
  EXPECT_NE(o.err.find(": and 30 more problems, 80 in all\n"), std::string::npos) << o.err;
}

}  // namespace
}  // namespace hauberk::test
