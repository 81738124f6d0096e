#include "support.hpp"

#include <hauberk/error.hpp>
#include <hauberk/host/registry.hpp>

#include <set>
#include <string>
#include <thread>
#include <vector>

namespace hauberk::test {
namespace {

/// Two folders: `one` with a good shape, an optimizer and a broken plugin, `two` with another copy of the
/// shape.
class RegistryTest : public testing::Test {
 protected:
  RegistryTest()
  {
    for (const char* id : {"good_shape", "hasty_optimizer", "bad_revision"}) {
      fs::copy_file(bad(id), one_ / (std::string(id) + ".so"));
    }
    fs::copy_file(bad("good_shape"), two_ / "good_shape.so");
    fs::copy_file(bad("bad_revision"), two_ / "later.so");
    folder_.file("one/README.md", "not a plugin");
  }

  std::string find_error(PluginKind kind, const std::string& id) const
  {
    return message_of<InputError>([&] { registry_.find(kind, id); });
  }

  TemporaryFolder folder_;
  fs::path one_ = folder_.folder("one"), two_ = folder_.folder("two");
  Registry registry_{{folder_ / "absent", one_, two_}};
  std::string searched_ = " (searched: " + (folder_ / "absent").native() + ", " + one_.native() + ", " +
                          two_.native() + "; other folders with --plugin-path or HAUBERK_PLUGIN_PATH)";
};

std::string find_message(const Registry& registry, const std::string& id)
{
  return message_of<InputError>([&] { registry.find(PluginKind::shape, id); });
}

TEST_F(RegistryTest, FindsById)
{
  const PluginTable& table = registry_.find(PluginKind::shape, "good_shape");
  EXPECT_STREQ(table.id, "good_shape");
  EXPECT_EQ(&registry_.find(PluginKind::shape, "good_shape"), &table);
  EXPECT_STREQ(registry_.find(PluginKind::optimizer, "hasty_optimizer").id, "hasty_optimizer");
}

TEST_F(RegistryTest, EarlierFoldersWin)
{
  const Registry reversed({two_, one_});
  EXPECT_NE(&registry_.find(PluginKind::shape, "good_shape"),
            &reversed.find(PluginKind::shape, "good_shape"));
}

TEST_F(RegistryTest, ListShowsBrokenAndShadowedOnes)
{
  const std::vector<PluginEntry> entries = registry_.list();
  ASSERT_EQ(entries.size(), 5u);
  EXPECT_EQ(entries[0].file, one_ / "bad_revision.so");
  EXPECT_EQ(entries[0].table, nullptr);
  EXPECT_EQ(entries[0].problem, "plugin '" + (one_ / "bad_revision.so").native() +
                                    "' was built with interface revision 999, this program with " +
                                    std::to_string(interface_revision) +
                                    "; rebuild the plugin with this program's headers and compiler settings");
  EXPECT_EQ(entries[1].id, "good_shape");
  EXPECT_EQ(entries[1].table, &registry_.find(PluginKind::shape, "good_shape"));
  EXPECT_EQ(entries[1].problem, "");
  EXPECT_FALSE(entries[1].shadowed_by);
  EXPECT_EQ(entries[2].id, "hasty_optimizer");
  EXPECT_EQ(entries[3].file, two_ / "good_shape.so");
  EXPECT_EQ(entries[3].table, nullptr);
  EXPECT_EQ(entries[3].problem, "");
  EXPECT_EQ(entries[3].shadowed_by, one_ / "good_shape.so");
  EXPECT_EQ(entries[4].id, "later");
  EXPECT_FALSE(entries[4].problem.empty());
}

TEST_F(RegistryTest, FilesOfAnIdAreInTheOrderOfFolders)
{
  const std::vector<fs::path> both{one_ / "good_shape.so", two_ / "good_shape.so"};
  EXPECT_EQ(registry_.files("good_shape"), both);
  EXPECT_TRUE(registry_.files("../two/good_shape").empty());
  EXPECT_TRUE(registry_.files("absent").empty());
}

TEST_F(RegistryTest, Missing)
{
  EXPECT_EQ(find_error(PluginKind::shape, "god_shape"),
            "no shape 'god_shape' found; did you mean 'good_shape'?" + searched_);
  EXPECT_EQ(find_error(PluginKind::optimizer, "sqp"),
            "no optimizer 'sqp' found; known: 'hasty_optimizer'" + searched_);
  EXPECT_EQ(find_error(PluginKind::load_case, "in_plane"), "no load case 'in_plane' found" + searched_);
}

TEST_F(RegistryTest, WrongKind)
{
  EXPECT_EQ(find_error(PluginKind::optimizer, "good_shape"), "'good_shape' is a shape, not an optimizer");
  EXPECT_EQ(find_error(PluginKind::load_case, "hasty_optimizer"),
            "'hasty_optimizer' is an optimizer, not a load case");
}

TEST_F(RegistryTest, BrokenPluginIsReportedNotPassedOver)
{
  EXPECT_EQ(find_error(PluginKind::shape, "bad_revision"), registry_.list()[0].problem);
  fs::create_symlink("gone.so", one_ / "link.so");
  EXPECT_EQ(find_error(PluginKind::shape, "link"),
            "plugin '" + (one_ / "link.so").native() +
                "' is a link to 'gone.so', which does not exist; remove or mend it");
}

/// All bad plugins in one folder: each is listed with what is wrong with it, and the good one among them
/// works.
TEST(Registry, GoesOnWithTheOthers)
{
  // A library that was loaded once, even if it was refused, is not loaded again: copies are others.
  const TemporaryFolder folder;
  fs::copy(bad_plugins, folder.path());
  const Registry registry({folder.path()});
  // Those that load, and misbehave when they are called.
  const std::set<std::string> loads = {"good_shape",   "hasty_optimizer", "library_assertions",
                                       "several_ring", "several_search",  "throwing"};
  std::size_t broken = 0;
  for (const PluginEntry& entry : registry.list()) {
    EXPECT_EQ(entry.table != nullptr, loads.count(entry.id) == 1) << entry.id;
    if (entry.table != nullptr) continue;
    ++broken;
    EXPECT_EQ(entry.problem.find("plugin '" + entry.file.native() + "'"), 0U) << entry.problem;
    EXPECT_EQ(find_message(registry, entry.id), entry.problem);
  }
  EXPECT_GE(broken, 20U);
  EXPECT_STREQ(registry.find(PluginKind::shape, "good_shape").id, "good_shape");
}

/// The plugins of a library of several are found by their ids, whatever its file is called, and shadow each
/// other and others as if they had files of their own.
TEST(Registry, FindsEachOfSeveralInOneLibrary)
{
  const TemporaryFolder folder;
  const fs::path one = folder.folder("one"), two = folder.folder("two");
  const fs::path first = one / "any_name.so", second = two / "several.so";
  fs::copy_file(bad("several"), first);
  fs::copy_file(bad("several"), second);
  fs::copy_file(bad("good_shape"), two / "several_ring.so");  // it calls itself otherwise
  const Registry registry({one, two});
  EXPECT_STREQ(registry.find(PluginKind::shape, "several_ring").id, "several_ring");
  EXPECT_STREQ(registry.find(PluginKind::optimizer, "several_search").id, "several_search");
  EXPECT_EQ(registry.files("several_ring"), (std::vector{first, two / "several_ring.so", second}));
  EXPECT_EQ(registry.files("several_search"), (std::vector{first, second}));
  EXPECT_TRUE(registry.files("any_name").empty());
  EXPECT_EQ(message_of<InputError>([&] { registry.find(PluginKind::shape, "several_search"); }),
            "'several_search' is an optimizer, not a shape");

  const std::vector<PluginEntry> entries = registry.list();
  ASSERT_EQ(entries.size(), 5U);
  EXPECT_EQ(entries[0].id, "several_ring");
  EXPECT_EQ(entries[0].file, first);
  EXPECT_EQ(entries[0].table, &registry.find(PluginKind::shape, "several_ring"));
  EXPECT_EQ(entries[1].id, "several_search");
  EXPECT_NE(entries[1].table, nullptr);
  for (const std::size_t k : {2, 3, 4}) {
    EXPECT_EQ(entries[k].table, nullptr);
    EXPECT_EQ(entries[k].shadowed_by, first);
  }
  EXPECT_EQ(entries[2].file, two / "several_ring.so");  // in one folder the file of that name comes first
  EXPECT_EQ(entries[3].file, second);
}

/// What is in a library that cannot be used is not known, so whoever misses a plugin is told of it.
TEST(Registry, NamesLibrariesOfSeveralThatCannotBeUsed)
{
  const TemporaryFolder folder;
  const fs::path file = folder / "pair.so";
  fs::copy_file(bad("several_revision"), file);
  const Registry registry({folder.path()});
  const std::vector<PluginEntry> entries = registry.list();
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].id, "pair");
  EXPECT_NE(entries[0].problem.find("interface revision 999"), std::string::npos);
  EXPECT_EQ(find_message(registry, "several_revision_ring"),
            "no shape 'several_revision_ring' found (searched: " + folder.path().native() +
                "; other folders with --plugin-path or HAUBERK_PLUGIN_PATH); " + entries[0].problem);
  EXPECT_EQ(find_message(registry, "pair"), entries[0].problem);
}

TEST_F(RegistryTest, IdsCannotLeaveTheFolders)
{
  for (const std::string id : {"../two/good_shape", "", "a.b", "a b", "/etc/passwd"}) {
    EXPECT_EQ(find_error(PluginKind::shape, id),
              "'" + id + "' is not a plugin id; expected letters, digits, '_' and '-'");
  }
}

TEST_F(RegistryTest, CurrentDirectoryIsNotSearched)
{
  const fs::path before = fs::current_path();
  fs::current_path(one_);
  const std::string message =
      message_of<InputError>([] { Registry({"/absent"}).find(PluginKind::shape, "good_shape"); });
  fs::current_path(before);
  EXPECT_EQ(
      message,
      "no shape 'good_shape' found (searched: /absent; other folders with --plugin-path or HAUBERK_PLUGIN_PATH)");
}

TEST_F(RegistryTest, ThreadsGetTheSameTable)
{
  std::vector<const PluginTable*> found(8);
  {
    std::vector<std::jthread> threads;
    threads.reserve(found.size());
    for (auto& slot : found) {
      threads.emplace_back([&] { slot = &registry_.find(PluginKind::shape, "good_shape"); });
    }
  }
  for (const PluginTable* table : found) EXPECT_EQ(table, found[0]);
}

}  // namespace
}  // namespace hauberk::test
