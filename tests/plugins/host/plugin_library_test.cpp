#include "support.hpp"

#include <hauberk/error.hpp>
#include <hauberk/host/floating_point.hpp>
#include <hauberk/host/handshake.hpp>
#include <hauberk/host/plugin_library.hpp>

#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace hauberk::test {
namespace {

std::string error_of(const fs::path& file)
{
  return message_of<PluginError>([&] { PluginLibrary::load(file); });
}

std::string quote(const fs::path& file) { return "plugin '" + file.native() + "'"; }

const std::string rebuild = "; rebuild the plugin with this program's headers and compiler settings";

/// What the error about a handshake field of bad plugin `id` must be.
std::string differs(const std::string& id, const std::string& what, const std::string& plugin,
                    const std::string& program)
{
  return quote(bad(id)) + " was built with " + what + " " + plugin + ", this program with " + program +
         rebuild;
}

TEST(PluginLibrary, LoadsAGoodPlugin)
{
  const PluginLibrary library = PluginLibrary::load(bad("good_shape"));
  EXPECT_STREQ(library.table().id, "good_shape");
  EXPECT_EQ(library.table().kind, PluginKind::shape);
  EXPECT_EQ(library.file(), bad("good_shape"));
  // Loading again gives the same table: the library is in memory once.
  EXPECT_EQ(&PluginLibrary::load(bad("good_shape")).table(), &library.table());
}

TEST(PluginLibrary, SeveralPluginsInOneLibrary)
{
  const PluginLibrary library = PluginLibrary::load(bad("several"));
  ASSERT_EQ(library.tables().size(), 2U);
  EXPECT_STREQ(library.tables()[0]->id, "several_ring");
  EXPECT_EQ(library.tables()[0]->kind, PluginKind::shape);
  EXPECT_STREQ(library.tables()[1]->id, "several_search");
  EXPECT_EQ(library.tables()[1]->kind, PluginKind::optimizer);
  EXPECT_EQ(&library.table("several_search"), library.tables()[1]);
  const auto refused = [&](const char* id) {
    return message_of<InputError>([&] { static_cast<void>(library.table(id)); });
  };
  EXPECT_EQ(refused(""), quote(bad("several")) +
                             " has several plugins, 'several_ring', 'several_search'; name one of them");
  EXPECT_EQ(refused("several"),
            quote(bad("several")) + " has no plugin 'several', but 'several_ring', 'several_search'");
  EXPECT_TRUE(PluginLibrary::has_several(bad("several")));
  EXPECT_FALSE(PluginLibrary::has_several(bad("good_shape")));
  EXPECT_FALSE(PluginLibrary::has_several(bad("absent")));
  EXPECT_FALSE(PluginLibrary::has_several(bad_plugins));
}

/// Handshake, texts, kind and id of each are checked, and one that is wrong spoils the library.
TEST(PluginLibrary, EachOfSeveralIsChecked)
{
  const auto second = [](const std::string& id) { return quote(bad(id)) + " (table 2)"; };
  EXPECT_EQ(error_of(bad("several_twice")),
            quote(bad("several_twice")) +
                " has two plugins 'several_twice_ring' (tables 1 and 2); give each an id of its own");
  EXPECT_EQ(error_of(bad("several_revision")), second("several_revision") +
                                                   " was built with interface revision 999, this program "
                                                   "with " +
                                                   std::to_string(interface_revision) + rebuild);
  EXPECT_EQ(error_of(bad("several_magic")),
            second("several_magic") +
                ": its part of 'hauberk_plugins' begins with \"hAUBERK\", expected \"HAUBERK\"; it must be a "
                "constant hauberk::PluginTable");
  EXPECT_EQ(error_of(bad("several_id")),
            second("several_id") + " calls itself 'no id'; expected letters, digits, '_' and '-'");
  EXPECT_EQ(error_of(bad("several_kind")),
            second("several_kind") +
                " is a load case but does not set 'make_load_case'; set exactly the factory of its kind");
  EXPECT_EQ(error_of(bad("several_none")),
            quote(bad("several_none")) + ": its 'hauberk_plugins' is empty; name a table in it");
  EXPECT_EQ(error_of(bad("no_list")),
            quote(bad("no_list")) +
                ": part 1 of its 'hauberk_plugins' is no table of this library; make the list by "
                "HAUBERK_PLUGINS");
  EXPECT_EQ(error_of(bad("several_and_one")),
            quote(bad("several_and_one")) +
                " exports both 'hauberk_plugin' and 'hauberk_plugins'; leave one of them");
}

TEST(PluginLibrary, TableOutlivesTheLibraryObject)
{
  const PluginTable* table = nullptr;
  {
    table = &PluginLibrary::load(bad("good_shape")).table();
  }
  EXPECT_STREQ(table->summary, "A ring for tests.");
}

TEST(PluginLibrary, Magic)
{
  EXPECT_EQ(error_of(bad("bad_magic")),
            quote(bad("bad_magic")) +
                ": its 'hauberk_plugin' begins with \"hAUBERK\", expected \"HAUBERK\"; it must be a constant "
                "hauberk::PluginTable");
}

TEST(PluginLibrary, EachHandshakeFieldNamesBothSides)
{
  const auto number = [](std::size_t n) { return std::to_string(n); };
  const auto text = [](const char* t) { return "\"" + std::string(t) + "\""; };
  EXPECT_EQ(error_of(bad("bad_size")), differs("bad_size", "a plugin table of size",
                                               number(sizeof(PluginTable) + 8), number(sizeof(PluginTable))));
  EXPECT_EQ(error_of(bad("bad_revision")),
            differs("bad_revision", "interface revision", "999", number(interface_revision)));
  EXPECT_EQ(error_of(bad("bad_compiler")),
            differs("bad_compiler", "compiler", "\"gcc 99\"", text(HAUBERK_COMPILER)));
  EXPECT_EQ(error_of(bad("null_compiler")),
            differs("null_compiler", "compiler", "nothing", text(HAUBERK_COMPILER)));
  EXPECT_EQ(
      error_of(bad("bad_standard_library")),
      differs("bad_standard_library", "standard library", "\"libstdc++ cxx11-abi=0\"", text(HAUBERK_STDLIB)));
  EXPECT_EQ(error_of(bad("bad_eigen")),
            differs("bad_eigen", "Eigen", "\"3.3.9\"", text(program_handshake().eigen)));
  EXPECT_EQ(error_of(bad("bad_alignment")),
            differs("bad_alignment", "Eigen alignment", number(2 * EIGEN_MAX_ALIGN_BYTES),
                    number(EIGEN_MAX_ALIGN_BYTES)));
  EXPECT_EQ(error_of(bad("bad_layout")), differs("bad_layout", "a layout of the interface's types of",
                                                 number(interface_layout + 1), number(interface_layout)));
  EXPECT_EQ(error_of(bad("bad_sanitizers")),
            differs("bad_sanitizers", "sanitizers", "\"memory\"", text(HAUBERK_SANITIZERS)));
}

TEST(PluginLibrary, NothingBehindTheFirstDifferenceIsRead)
{
  EXPECT_EQ(error_of(bad("bad_all")),
            differs("bad_all", "interface revision", "998", std::to_string(interface_revision)));
}

TEST(PluginLibrary, HandshakeIsCheckedInTheOrderOfItsFields)
{
  // Start with every field wrong, mend one after the other: the next one is reported each time.
  const Handshake good = program_handshake();
  Handshake h{{'x'}, 1, 999, "a", "b", "c", 3, 4, "d"};
  const auto what = [&] { return message_of<PluginError>([&] { check_handshake(h, "/p.so"); }); };
  EXPECT_NE(what().find("begins with \"x\""), std::string::npos);
  std::memcpy(h.magic, good.magic, sizeof h.magic);
  EXPECT_NE(what().find("table of size 1,"), std::string::npos);
  h.table_size = good.table_size;
  EXPECT_NE(what().find("interface revision 999,"), std::string::npos);
  h.revision = good.revision;
  EXPECT_NE(what().find("compiler \"a\","), std::string::npos);
  h.compiler = good.compiler;
  EXPECT_NE(what().find("standard library \"b\","), std::string::npos);
  h.standard_library = good.standard_library;
  EXPECT_NE(what().find("Eigen \"c\","), std::string::npos);
  h.eigen = good.eigen;
  EXPECT_NE(what().find("Eigen alignment 3,"), std::string::npos);
  h.eigen_alignment = good.eigen_alignment;
  EXPECT_NE(what().find("a layout of the interface's types of 4,"), std::string::npos);
  h.layout = good.layout;
  EXPECT_NE(what().find("sanitizers \"d\","), std::string::npos);
  h.sanitizers = good.sanitizers;
  EXPECT_NO_THROW(check_handshake(h, "/p.so"));
}

TEST(PluginLibrary, LayoutsDifferBySizeAlignmentAndOrder)
{
  struct alignas(8) Wide {
    std::int32_t a;
  };
  EXPECT_EQ(layout_of<std::int32_t>(), layout_of<float>());
  EXPECT_NE(layout_of<std::int32_t>(), layout_of<std::int64_t>());
  EXPECT_NE((layout_of<std::array<std::int32_t, 2>>()), layout_of<Wide>());
  EXPECT_NE((layout_of<std::int32_t, std::int64_t>()), (layout_of<std::int64_t, std::int32_t>()));
}

TEST(PluginLibrary, Table)
{
  EXPECT_EQ(error_of(bad("bad_kind")),
            quote(bad("bad_kind")) + " is of kind 7; expected 1 (shape), 2 (load case) or 3 (optimizer)");
  EXPECT_EQ(error_of(bad("bad_id")),
            quote(bad("bad_id")) +
                " calls itself 'something_else'; rename the file to 'something_else.so' or change the id");
  EXPECT_EQ(error_of(bad("null_summary")),
            quote(bad("null_summary")) +
                ": 'summary' is null; id, version, summary, citation and fields must all be set");
  EXPECT_EQ(error_of(bad("null_fields")),
            quote(bad("null_fields")) +
                ": 'fields' is null; id, version, summary, citation and fields must all be set");
  EXPECT_EQ(error_of(bad("no_factory")),
            quote(bad("no_factory")) +
                " is a shape but does not set 'make_shape'; set exactly the factory of its kind");
  EXPECT_EQ(error_of(bad("wrong_kind")),
            quote(bad("wrong_kind")) +
                " is a load case but also sets 'make_shape'; set exactly the factory of its kind");
  EXPECT_EQ(error_of(bad("two_factories")), quote(bad("two_factories")) +
                                                " is a shape but also sets 'make_optimizer'; set exactly the "
                                                "factory of its kind");
}

TEST(PluginLibrary, MissingEntryIsFoundWithoutRunningTheLibrary)
{
  // Its constructor would end this test.
  EXPECT_EQ(error_of(bad("no_entry")), quote(bad("no_entry")) +
                                           " does not export 'hauberk_plugin'; expected one constant "
                                           "hauberk::PluginTable of that name, marked HAUBERK_EXPORT");
}

TEST(PluginLibrary, UndefinedSymbolIsFoundAtOnce)
{
  const fs::path file = bad("missing_symbol");
  EXPECT_EQ(error_of(file), quote(file) + " cannot be loaded: " + file.native() +
                                ": undefined symbol: hauberk_test_undefined_function");
}

TEST(PluginLibrary, ATableOfZeros)
{
  EXPECT_EQ(error_of(bad("null_table")),
            quote(bad("null_table")) +
                ": its 'hauberk_plugin' begins with \"\", expected \"HAUBERK\"; it must be a constant "
                "hauberk::PluginTable");
}

TEST(PluginLibrary, OtherFlags)
{
#if defined(__x86_64__)
  EXPECT_EQ(error_of(bad("other_alignment")),
            differs("other_alignment", "Eigen alignment", "32", std::to_string(EIGEN_MAX_ALIGN_BYTES)));
  EXPECT_EQ(error_of(bad("other_strings")), differs("other_strings", "standard library",
                                                    "\"libstdc++ cxx11-abi=0\"", "\"" HAUBERK_STDLIB "\""));
#endif
#if defined(__GLIBCXX__) && !defined(_GLIBCXX_DEBUG)
  EXPECT_EQ(error_of(bad("debug_library")),
            differs("debug_library", "standard library", "\"libstdc++ cxx11-abi=1 debug\"",
                    "\"" HAUBERK_STDLIB "\""));
  EXPECT_NO_THROW(PluginLibrary::load(bad("library_assertions"))) << "they change no layout";
#endif
  EXPECT_EQ(error_of(bad("row_major")),
            differs("row_major", "Eigen", "\"" HAUBERK_EIGEN " row-major\"", "\"" HAUBERK_EIGEN "\""));
}

TEST(PluginLibrary, ConstructorsThatMisbehaveDoNotEndTheProgram)
{
  const auto cannot = [](const std::string& id, const std::string& ending) {
    return quote(bad(id)) + " cannot be loaded: its static constructors " + ending +
           "; a plugin must not have any with effects";
  };
  EXPECT_EQ(error_of(bad("throws_on_load")),
            cannot("throws_on_load", "ended by signal 6 (Aborted); it last printed:   what():  no licence"));
  EXPECT_EQ(error_of(bad("crashes_on_load")), cannot("crashes_on_load", "ended by signal 6 (Aborted)"));
  EXPECT_EQ(error_of(bad("waits_on_load")), cannot("waits_on_load", "did not return within 5 s"));
}

TEST(PluginLibrary, ConstructorsThatChangeTheProcessAreRefused)
{
  const fs::path before = fs::current_path();
  EXPECT_EQ(error_of(bad("moves_on_load")),
            quote(bad("moves_on_load")) +
                " changed the state of the process (current directory) when it was loaded; a plugin must not "
                "have static constructors with effects");
  EXPECT_EQ(fs::current_path(), before);
}

/// Permissions mean nothing to root: then the file is looked at by somebody else.
class AsSomebodyElse {
 public:
  AsSomebodyElse()
  {
    if (::geteuid() == 0 && ::seteuid(nobody) != 0) ADD_FAILURE() << "seteuid failed";
  }
  ~AsSomebodyElse()
  {
    if (::getuid() == 0 && ::seteuid(0) != 0) std::abort();
  }
  AsSomebodyElse(const AsSomebodyElse&) = delete;
  AsSomebodyElse& operator=(const AsSomebodyElse&) = delete;

 private:
  static constexpr uid_t nobody = 65534;
};

TEST(PluginLibrary, UnreadableFile)
{
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::owner_all | fs::perms::group_exec | fs::perms::others_exec);
  const fs::path file = folder.file("a.so", "");
  fs::permissions(file, fs::perms::none);
  const AsSomebodyElse somebody;
  EXPECT_EQ(error_of(file), quote(file) + " cannot be read: Permission denied; mend its permissions");
}

TEST(PluginLibrary, WhatCannotBeLookedAtIsNotSaidToBeMissing)
{
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::owner_all | fs::perms::group_exec | fs::perms::others_exec);
  const fs::path closed = folder.folder("closed"), loop = folder / "loop.so";
  std::ofstream(closed / "a.so") << "";
  fs::permissions(closed, fs::perms::none);
  fs::create_symlink(loop, loop);
  const std::string way_out = "; mend links and the permissions of its folders";
  EXPECT_EQ(error_of(loop),
            quote(loop) + " cannot be looked at: Too many levels of symbolic links" + way_out);
  const AsSomebodyElse somebody;
  EXPECT_EQ(error_of(closed / "a.so"),
            quote(closed / "a.so") + " cannot be looked at: Permission denied" + way_out);
}

TEST(PluginLibrary, FastMathIsNoticedAndUndone)
{
#if defined(__x86_64__)
  const FloatingPointMode before = floating_point_mode();
  EXPECT_EQ(error_of(bad("fast_math")), quote(bad("fast_math")) +
                                            " changed the floating-point mode (flush-to-zero) when it was "
                                            "loaded; build it without -ffast-math");
  EXPECT_EQ(floating_point_mode(), before);
#endif
}

TEST(PluginLibrary, SanitizerIsFoundWithoutRunningTheLibrary)
{
  if (std::string(HAUBERK_SANITIZERS) != "none") GTEST_SKIP() << "this program is instrumented itself";
  if (!fs::exists(bad("instrumented"))) GTEST_SKIP() << "not built under a sanitizer";
  EXPECT_EQ(error_of(bad("instrumented")), differs("instrumented", "sanitizers", "\"address\"", "\"none\""));
}

TEST(PluginLibrary, NotALibrary)
{
  const TemporaryFolder folder;
  EXPECT_EQ(error_of(folder / "a.so"), quote(folder / "a.so") + " does not exist");
  EXPECT_EQ(error_of(folder.folder("b.so")),
            quote(folder / "b.so") + " is a folder; expected a shared library");
  ASSERT_EQ(mkfifo((folder / "e.so").c_str(), 0600), 0);  // nobody writes to it
  EXPECT_EQ(error_of(folder / "e.so"), quote(folder / "e.so") + " is no file; expected a shared library");
  fs::create_symlink("nowhere.so", folder / "c.so");
  EXPECT_EQ(error_of(folder / "c.so"),
            quote(folder / "c.so") + " is a link to 'nowhere.so', which does not exist; remove or mend it");
  for (const std::string content : {"",
                                    "\x7f"
                                    "EL",
                                    "#!/bin/sh\nexit 0\n"}) {
    EXPECT_EQ(error_of(folder.file("d.so", content)),
              quote(folder / "d.so") + " is not a shared library; build it with hauberk_add_plugin");
  }
}

TEST(PluginLibrary, OtherProcessor)
{
  const TemporaryFolder folder;
  std::string header(
      "\x7f"
      "ELF\x01\x02\x01",
      7);  // 32 bits, most significant byte first
  header.resize(128, '\0');
  EXPECT_EQ(
      error_of(folder.file("a.so", header)),
      quote(folder / "a.so") + " was built for another kind of processor than this program; rebuild it here");
}

TEST(PluginLibrary, TruncatedFileIsAnError)
{
  std::ifstream in(bad("good_shape"), std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  const TemporaryFolder folder;
  for (const std::size_t size : {whole.size() / 2, whole.size() / 8, std::size_t{64}, std::size_t{20}}) {
    const fs::path file = folder.file("good_shape.so", whole.substr(0, size));
    EXPECT_EQ(error_of(file), quote(file) + " is incomplete; build or copy it again") << size;
  }
}

}  // namespace
}  // namespace hauberk::test
