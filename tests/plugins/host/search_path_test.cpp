#include "support.hpp"

#include <hauberk/error.hpp>
#include <hauberk/host/search_path.hpp>

#include <vector>

namespace hauberk::test {
namespace {

using Paths = std::vector<fs::path>;

TEST(SearchPath, OrderIsCommandLineThenEnvironmentThenProgram)
{
  const TemporaryFolder folder;
  const Paths given{folder.folder("a"), folder.folder("b")};
  EXPECT_EQ(plugin_search_path(given, "/e1:/e2/", "/usr/bin/hauberk"),
            (Paths{folder / "a", folder / "b", "/e1", "/e2", "/usr/lib/hauberk/plugins"}));
  EXPECT_EQ(plugin_search_path({}, nullptr, "/build/release/bin/hauberk"),
            (Paths{"/build/release/lib/hauberk/plugins"}));
}

TEST(SearchPath, EmptyEntriesAreNotTheCurrentDirectory)
{
  const Paths expected{"/e", "/usr/lib/hauberk/plugins"};
  for (const char* environment : {":/e", "/e:", "::/e::", "/e"}) {
    EXPECT_EQ(plugin_search_path({}, environment, "/usr/bin/hauberk"), expected) << environment;
  }
  for (const char* environment : {"", ":", ":::"}) {
    EXPECT_EQ(plugin_search_path({}, environment, "/usr/bin/hauberk"), (Paths{"/usr/lib/hauberk/plugins"}));
  }
}

TEST(SearchPath, AFolderIsSearchedOnce)
{
  EXPECT_EQ(plugin_search_path({}, "/usr/lib/hauberk/plugins:/e:/e/", "/usr/bin/hauberk"),
            (Paths{"/usr/lib/hauberk/plugins", "/e"}));
}

TEST(SearchPath, RelativeFolderOnTheCommandLineIsMadeAbsolute)
{
  EXPECT_EQ(plugin_search_path(Paths{"."}, nullptr, "/usr/bin/hauberk"),
            (Paths{fs::current_path(), "/usr/lib/hauberk/plugins"}));
}

TEST(SearchPath, Mistakes)
{
  const TemporaryFolder folder;
  const fs::path file = folder.file("f.so", "");
  EXPECT_EQ(message_of<InputError>([&] { plugin_search_path(Paths{folder / "x"}, nullptr, "/bin/h"); }),
            "--plugin-path: '" + (folder / "x").native() + "' is not a folder");
  EXPECT_EQ(message_of<InputError>([&] { plugin_search_path(Paths{file}, nullptr, "/bin/h"); }),
            "--plugin-path: '" + file.native() + "' is not a folder");
  EXPECT_EQ(message_of<InputError>([&] { plugin_search_path(Paths{""}, nullptr, "/bin/h"); }),
            "--plugin-path: '' is not a folder");
  EXPECT_EQ(
      message_of<InputError>([] { plugin_search_path({}, "/e:plugins", "/bin/h"); }),
      "HAUBERK_PLUGIN_PATH: 'plugins' is a relative path; expected absolute folders separated by colons");
}

TEST(SearchPath, OfThisProcessEndsBesideItsExecutable)
{
  const fs::path program = fs::read_symlink("/proc/self/exe");
  EXPECT_EQ(plugin_search_path({}).back(), program.parent_path().parent_path() / "lib/hauberk/plugins");
}

}  // namespace
}  // namespace hauberk::test
