#include "support.hpp"

#include <hauberk/host/trust.hpp>

#include <array>

namespace hauberk::test {
namespace {

TEST(Trust, WhatOthersCanWriteIsNamed)
{
  const TemporaryFolder folder;
  const std::array<fs::path, 3> folders{folder / "absent", folder.folder("closed"), folder.folder("open")};
  const fs::path file = folder.file("closed/a.so", ""), text = folder.file("closed/README.md", "");
  fs::permissions(folders[1], fs::perms(0755));
  fs::permissions(folders[2], fs::perms(0755));
  fs::permissions(file, fs::perms(0644));
  fs::permissions(text, fs::perms(0666));
  EXPECT_TRUE(open_to_others(folders).empty());
  fs::permissions(folders[2], fs::perms(0757));
  fs::permissions(file, fs::perms(0646));
  const std::string way_out =
      " can be written by everybody, who thereby decides what this program runs; mend its owner and permissions "
      "(chmod go-w)";
  const std::vector<std::string> expected{"the plugin '" + file.native() + "'" + way_out,
                                          "the plugin folder '" + folders[2].native() + "'" + way_out};
  EXPECT_EQ(open_to_others(folders), expected);
}

}  // namespace
}  // namespace hauberk::test
