/// The checked-in schema and reference are what the table of fields gives, with the plugins of this tree.
/// Run with HAUBERK_UPDATE=1 in the environment to write both files anew.

#include "document/json_writer.hpp"
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

void expect_file(const std::string& path, const std::string& text)
{
  if (std::getenv("HAUBERK_UPDATE") != nullptr) std::ofstream(path, std::ios::binary) << text;
  EXPECT_EQ(read_text_file(path), text) << path << " is out of date: run this test with HAUBERK_UPDATE=1";
}

TEST(Schema, CheckedInFileIsUpToDate)
{
  expect_file(HAUBERK_SOURCE_DIR "/share/schema/experiment.schema.json",
              write_json(experiment_schema(own_plugins(), task_formats())) + "\n");
}

TEST(Schema, CheckedInReferenceIsUpToDate)
{
  expect_file(HAUBERK_SOURCE_DIR "/share/doc/experiment.md",
              experiment_reference(own_plugins(), task_formats()));
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
  EXPECT_EQ(write_json(field_schema(ratio)),
            "{\n  \"description\": \"A ratio. Unit: 1.\",\n  \"default\": 0.5,\n  \"type\": \"number\",\n"
            "  \"exclusiveMinimum\": 0,\n  \"maximum\": 1\n}");
  Field pair;
  pair.kind = Field::Kind::numbers;
  pair.min_items = pair.max_items = 2;
  EXPECT_EQ(write_json(field_schema(pair)),
            "{\n  \"type\": \"array\",\n  \"items\": { \"type\": \"number\" },\n  \"minItems\": 2,\n  "
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
