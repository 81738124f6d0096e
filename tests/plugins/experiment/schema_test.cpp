/// The checked-in schema and reference are what the table of fields gives, with the plugins of this tree.
/// Run with HAUBERK_UPDATE=1 in the environment to write both files anew.

#include "document/json_writer.hpp"
#include "document/jsonc.hpp"
#include "tasks/table.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/experiment.hpp>
#include <hauberk/experiment/fields.hpp>
#include <hauberk/experiment/schema.hpp>
#include <hauberk/host/registry.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

namespace hauberk::test {
namespace {

const Registry& registry()
{
  static const Registry plugins({HAUBERK_BINARY_DIR "/lib/hauberk/plugins"});
  return plugins;
}

/// Plugins of this tree, by kind and id; files that happen to lie in the same folder do not count.
std::vector<const PluginTable*> own_plugins()
{
  const std::string ids = std::string(",") + OWN_PLUGINS + ",";
  std::vector<const PluginTable*> tables;
  for (const PluginEntry& entry : registry().list()) {
    if (ids.find("," + entry.id + ",") == std::string::npos) continue;
    EXPECT_NE(entry.table, nullptr) << entry.id << ": " << entry.problem;
    if (entry.table != nullptr) tables.push_back(entry.table);
  }
  std::sort(tables.begin(), tables.end(), [](const PluginTable* a, const PluginTable* b) {
    return a->kind != b->kind ? a->kind < b->kind : std::string(a->id) < b->id;
  });
  return tables;
}

/// Plugins of this tree that were not built, as their libraries were not found.
std::vector<std::string> absent_plugins()
{
  std::vector<std::string> ids;
  std::istringstream list(ABSENT_PLUGINS);
  for (std::string id; std::getline(list, id, ',');) ids.push_back(id);
  return ids;
}

/// What is checked in, with nothing left out, is replaced when that is wanted.
void update(const std::string& path, const std::string& text)
{
  if (std::getenv("HAUBERK_UPDATE") == nullptr) return;
  ASSERT_STREQ(ABSENT_PLUGINS, "") << "only a build with all plugins can write " << path
                                   << ": share/setup.sh --optional";
  std::ofstream(path, std::ios::binary) << text;
}

const std::string out_of_date = " is out of date: run this test with HAUBERK_UPDATE=1";

/// The alternative of a plugin, taken away wherever it is. True where it was.
bool remove_alternative(Node& node, const std::string& id)
{
  bool found = false;
  if (node.is(Node::Type::array)) {
    const auto is_it = [&](const Node& item) {
      const Node* condition = item.find("if");
      return condition != nullptr &&
             write_json(*condition).find("\"const\": \"" + id + "\"") != std::string::npos;
    };
    found = std::erase_if(node.items, is_it) > 0;
    for (Node& item : node.items) found |= remove_alternative(item, id);
  }
  for (auto& [key, member] : node.members) found |= remove_alternative(member, id);
  return found;
}

/// The page without the chapter of a plugin.
std::string without_chapter(const std::string& page, const std::string& id)
{
  const std::string heading = "# Plugin `" + id + "`\n";
  const std::size_t from = page.find("\n" + heading);
  EXPECT_NE(from, std::string::npos) << "no chapter of " << id;
  if (from == std::string::npos) return page;
  const std::size_t to = page.find("\n# ", from + heading.size());
  return page.substr(0, from) + (to == std::string::npos ? "" : page.substr(to));
}

TEST(Schema, CheckedInFileIsUpToDate)
{
  const std::string path = HAUBERK_SOURCE_DIR "/share/schema/experiment.schema.json";
  const std::string text = write_json(experiment_schema(own_plugins(), task_formats())) + "\n";
  update(path, text);
  Problems problems;
  std::optional<Node> schema = read_jsonc(read_text_file(path), problems);
  ASSERT_TRUE(schema);
  for (const std::string& id : absent_plugins()) EXPECT_TRUE(remove_alternative(*schema, id)) << id;
  const std::string checked_in = absent_plugins().empty() ? read_text_file(path) : write_json(*schema) + "\n";
  EXPECT_EQ(checked_in, text) << path << out_of_date;
}

TEST(Schema, CheckedInReferenceIsUpToDate)
{
  const std::string path = HAUBERK_SOURCE_DIR "/share/doc/experiment.md";
  const std::string text = experiment_reference(own_plugins(), task_formats());
  update(path, text);
  std::string checked_in = read_text_file(path);
  for (const std::string& id : absent_plugins()) checked_in = without_chapter(checked_in, id);
  EXPECT_EQ(checked_in, text) << path << out_of_date;
}

/// What is left out where libraries are missing is just what these plugins add.
TEST(Schema, AnAbsentPluginIsLeftOut)
{
  std::vector<const PluginTable*> all = own_plugins(), fewer;
  const auto is_sqp = [](const PluginTable* table) { return std::string(table->id) == "sqp"; };
  std::remove_copy_if(all.begin(), all.end(), std::back_inserter(fewer), is_sqp);
  Node schema = experiment_schema(all, task_formats());
  EXPECT_TRUE(remove_alternative(schema, "sqp"));
  EXPECT_FALSE(remove_alternative(schema, "sqp"));
  EXPECT_EQ(write_json(schema), write_json(experiment_schema(fewer, task_formats())));
  for (const char* id : {"nlopt", "sqp"}) {  // one in the middle, and the last
    std::vector<const PluginTable*> others;
    std::copy_if(all.begin(), all.end(), std::back_inserter(others),
                 [&](const PluginTable* table) { return std::string(table->id) != id; });
    EXPECT_EQ(without_chapter(experiment_reference(all, task_formats()), id),
              experiment_reference(others, task_formats()));
  }
}

TEST(Schema, HoldsWhatAFieldDeclares)
{
  Field ratio;
  ratio.name = "ratio";
  ratio.kind = Field::Kind::number;
  ratio.doc = "A ratio.";
  ratio.unit = "1";
  ratio.default_json = "0.5";
  ratio.minimum = 0.0;
  ratio.exclusive_minimum = true;
  ratio.maximum = 1.0;
  EXPECT_EQ(
      write_json(field_schema(ratio)),
      "{\n  \"description\": \"A ratio. Unit: 1.\",\n  \"default\": 0.5,\n  \"type\": [\"number\", \"string\"],\n"
      "  \"pattern\": \"^[$=]\",\n  \"exclusiveMinimum\": 0,\n  \"maximum\": 1\n}");
  Field pair;
  pair.kind = Field::Kind::numbers;
  pair.min_items = pair.max_items = 2;
  EXPECT_EQ(
      write_json(field_schema(pair)),
      "{\n  \"type\": \"array\",\n  \"items\": { \"type\": [\"number\", \"string\"], \"pattern\": \"^[$=]\" },\n  \"minItems\": 2,\n  "
      "\"maxItems\": 2\n}");
}

TEST(Schema, ReferenceListsKeys)
{
  Field key;
  key.name = "mode";
  key.kind = Field::Kind::choice;
  key.choices = {"a|b", "c"};
  key.doc = "How.";
  key.required = true;
  EXPECT_EQ(fields_reference({key}, "/x"),
            "## `/x`\n\n| key | value | unit | default | meaning |\n| --- | --- | --- | --- | --- |\n"
            "| **`mode`** | one of a\\|b, c |  |  | How. |\n");
}

/// Every experiment that is shipped is read without a problem, and its resolved form too.
TEST(Schema, ShippedExperimentsAreCorrect)
{
  const PluginLookup lookup = [](PluginKind kind, const std::string& id,
                                 std::string& error) -> const PluginTable* {
    try {
      return &registry().find(kind, id);
    } catch (const InputError& missing) {
      error = missing.what();
      return nullptr;
    }
  };
  const WeaveLookup weaves = [](const std::string& name, std::string&) {
    return std::optional(read_text_file(HAUBERK_SOURCE_DIR "/share/weaves/" + name + ".json"));
  };
  int count = 0;
  for (const char* folder : {"share/experiments", "shapes", "loadcases", "optimizers"}) {
    const std::filesystem::path root = std::filesystem::path(HAUBERK_SOURCE_DIR) / folder;
    if (!std::filesystem::exists(root)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      if (entry.path().extension() != ".json") continue;
      const std::vector<std::string> absent = absent_plugins();
      if (std::find(absent.begin(), absent.end(), entry.path().parent_path().filename()) != absent.end())
        continue;
      SCOPED_TRACE(entry.path().string());
      Diagnostics diagnostics;
      const auto experiment = read_experiment(
          {entry.path(), read_text_file(entry.path()), {}, weaves, {}, task_formats()}, lookup, diagnostics);
      EXPECT_EQ(diagnostics.text(), "");
      if (experiment) {
        Diagnostics again;
        // Beside it, as files of plugins are relative to it.
        const std::string beside = entry.path().parent_path() / "resolved";
        EXPECT_TRUE(read_experiment(
            {beside, write_json(experiment->resolved), {}, weaves, {}, task_formats()}, lookup, again))
            << again.text();
      }
      ++count;
    }
  }
  EXPECT_GE(count, 2);
}

}  // namespace
}  // namespace hauberk::test
