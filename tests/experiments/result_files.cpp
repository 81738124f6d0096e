#include "result_files.hpp"

#include "document/json_text.hpp"
#include "document/json_writer.hpp"
#include "run/sha256.hpp"

#include <gtest/gtest.h>
#include <boost/json/object.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace hauberk::test {

namespace fs = std::filesystem;
namespace json = boost::json;

namespace {

bool is_temporary(const std::string& name) { return name.front() == '.'; }

}  // namespace

Contents contents(const fs::path& folder)
{
  Contents out;
  if (!fs::exists(folder)) return out;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    // Evaluations of an interrupted design are lines, not a result; repeated_search_test.cpp is about them.
    if (entry.path().filename() == ".hauberk-evaluations") continue;
    if (entry.path().filename() == ".hauberk-digest") continue;  // it is written before what it is of
    if (entry.path().filename() == ".hauberk-lock") continue;    // folder_lock_test.cpp is about it
    if (entry.is_regular_file()) out[entry.path().filename().string()] = read_text(entry.path());
  }
  return out;
}

Contents results_in(const fs::path& folder)
{
  Contents files = contents(folder);
  files.erase("timings.json");
  return files;
}

Contents without_temporaries(Contents files)
{
  std::erase_if(files, [](const auto& file) { return is_temporary(file.first); });
  return files;
}

void expect_whole(const Contents& files, const std::string& what)
{
  for (const auto& [name, text] : files) {
    if (is_temporary(name)) continue;
    if (name.ends_with(".json")) {
      EXPECT_NO_THROW(parse_json(text, name)) << what;
    } else if (name.ends_with(".csv")) {
      ASSERT_TRUE(text.ends_with("\n")) << what << ' ' << name;
      std::istringstream lines(text);
      std::string line;
      std::getline(lines, line);
      const auto columns = std::count(line.begin(), line.end(), ',');
      EXPECT_GT(columns, 3) << what << ' ' << name;
      while (std::getline(lines, line)) EXPECT_GE(std::count(line.begin(), line.end(), ','), columns) << line;
    } else if (name.ends_with(".svg")) {
      EXPECT_TRUE(text.ends_with("</svg>\n")) << what << ' ' << name;
    } else {
      ADD_FAILURE() << what << ": left " << name;
    }
  }
  if (!files.contains("results.json")) return;
  const json::value results = parse_json(files.at("results.json"), "results.json");
  for (const auto& [key, name] : results.at("files").as_object())
    EXPECT_TRUE(files.contains(std::string(name.as_string()))) << what << ": lacks " << name;
}

void write_partial_results(const fs::path& folder, const json::value& document)
{
  std::ofstream(folder / "results.json", std::ios::binary) << write_json(document);
  std::ofstream(folder / ".hauberk-digest") << sha256_of_file(folder / "results.json") << '\n';
}

std::string endless_text()
{
  return with(with(chain_text(), R"("directions_deg": [0])", R"("directions_deg": [90, 0])"),
              R"("preset": "accurate")", R"("preset": "accurate", "starts": 200000)");
}

const std::vector<TaskCase>& task_cases()
{
  // Compressions have many starts each, and files are written alike without them.
  const auto stretches = [] {
    return with(chainmail_text(), R"("directions_deg": [0, 30, 90])",
                R"("directions_deg": [0, 15, 30, 45, 60, 75, 90], "senses": ["stretch"])");
  };
  static const std::vector<TaskCase> tasks{{"limits", stretches},   {"design", design_text},
                                           {"stability", map_text}, {"sweep", sweep_text},
                                           {"chart", chart_text},   {"transition", transition_text}};
  return tasks;
}

std::ostream& operator<<(std::ostream& out, const TaskCase& task) { return out << task.name; }

}  // namespace hauberk::test
