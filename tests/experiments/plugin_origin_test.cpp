/// Which library of a plugin a result was computed with, and what a run says of folders of plugins.

#include "program.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;

const std::string own_plugins = HAUBERK_BINARY_DIR "/lib/hauberk/plugins/";

std::string digest_of_shape(const fs::path& results)
{
  const boost::json::value document = read_results(results);
  for (const boost::json::value& plugin : document.at_pointer("/provenance/plugins").as_array()) {
    if (plugin.at("id").as_string() != "torus_union") continue;
    EXPECT_EQ(plugin.at("file").as_string(), "torus_union.so");
    return std::string(plugin.at("sha256").as_string());
  }
  return "";
}

TEST(PluginOrigin, ResultsTellTheLibraryAndAreNotResumedWithAnother)
{
  const WorkFolder folder;
  const std::string file = folder.write("c.json", chain_text()), out = folder / "out";
  fs::create_directory(folder / "plugins");
  const std::string copy = folder / "plugins/torus_union.so";
  fs::copy_file(own_plugins + "torus_union.so", copy);
  const auto run = [&](const std::string& how) {
    return run_program({"run", file, "-o", out, how, "--quiet", "--plugin-path", folder / "plugins"});
  };
  const Outcome first = run("--force");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(first.err, "hauberk: warning: of the plugin 'torus_union' the file '" + copy +
                           "' is used, and '" + own_plugins + "torus_union.so' is not\n");
  const std::string digest = digest_of_shape(out);
  EXPECT_EQ(digest.size(), 64U);
  EXPECT_EQ(run("--resume").code, 0);

  std::ofstream(copy, std::ios::app) << "one line more";
  const Outcome resumed = run("--resume");
  EXPECT_EQ(resumed.code, 2);
  EXPECT_NE(resumed.err.find("it was computed with another library of the plugin 'torus_union'"),
            std::string::npos)
      << resumed.err;
  ASSERT_EQ(run("--force").code, 0);
  EXPECT_NE(digest_of_shape(out), digest);
}

TEST(PluginOrigin, FoldersThatOthersCanWriteAreNamed)
{
  const WorkFolder folder;
  const fs::path open = folder.path() / "open";
  fs::create_directory(open);
  fs::permissions(open, fs::perms(0777));
  const std::string warning =
      "hauberk: warning: the plugin folder '" + open.string() + "' can be written by everybody";
  const std::string file = folder.write("c.json", chain_text());
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"plugins", "list"}, {"run", file, "-o", folder / "out"}}) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--plugin-path", open.string()});
    const Outcome o = run_program(all);
    EXPECT_EQ(o.code, 0);
    EXPECT_EQ(o.err.find(warning), 0U) << o.err;
    EXPECT_EQ(o.err.find(warning, 1), std::string::npos) << o.err;
  }
}

}  // namespace
}  // namespace hauberk::test
