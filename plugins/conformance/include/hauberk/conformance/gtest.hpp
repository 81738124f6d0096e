#pragma once
/// The checks of `hauberk plugins conform` as tests of GoogleTest:
///
///     HAUBERK_CONFORMANCE_TESTS(MyShape, MY_SHAPE_FILE, R"({"parameters": {"ring.R": 5}})");
///
/// at namespace scope of a test program that links hauberk::conformance and GTest::gtest_main, where
/// MY_SHAPE_FILE is the plugin's library (CMake: $<TARGET_FILE:my_shape>). Tests are named
/// MyShape.shape_jacobians and so on. They run in the test's process: use the command to survive a crash.

#include <hauberk/conformance/check.hpp>
#include <hauberk/error.hpp>
#include <hauberk/host/plugin_library.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

namespace hauberk::conformance {

/// One check of one plugin.
class ConformanceTest : public testing::Test {
 public:
  ConformanceTest(Check check, const PluginTable& table, conformance::Setup setup, std::uint64_t seed)
      : check_(std::move(check)), table_(table), setup_(std::move(setup)), seed_(seed)
  {
  }
  void TestBody() override
  {
    const Outcome outcome = run(check_, table_, setup_, seed_);
    if (outcome.status == Outcome::Status::skipped) GTEST_SKIP() << outcome.text;
    EXPECT_EQ(outcome.status, Outcome::Status::passed) << check_.about << ": " << outcome.text;
  }

 private:
  Check check_;
  const PluginTable& table_;
  conformance::Setup setup_;  // testing::Test has a trap of that name
  std::uint64_t seed_;
};

/// A plugin that could not be loaded.
class LoadTest : public testing::Test {
 public:
  explicit LoadTest(std::string why) : why_(std::move(why)) {}
  void TestBody() override { ADD_FAILURE() << why_; }

 private:
  std::string why_;
};

/// Registers a test of suite `suite` for each check of plugins of kind `kind`: `make`(check) makes it when it
/// runs.
template <class Make>
void register_checks(const std::string& suite, PluginKind kind, const Make& make)
{
  for (const Check& check : checks(kind)) {
    std::string name = check.name;
    std::replace(name.begin(), name.end(), '.', '_');
    testing::RegisterTest(suite.c_str(), name.c_str(), nullptr, nullptr, __FILE__, __LINE__,
                          [check, make]() -> testing::Test* { return make(check); });
  }
}

/// Registers the checks of the plugin in `file` as tests of suite `suite`, where the file has several those
/// of each as tests of suite `suite`_ID; `switches` as in Setup. Returns true.
inline bool register_tests(const char* suite, const std::string& file, const std::string& section = {},
                           std::uint64_t seed = 1, bool switches = true)
{
  try {
    const PluginLibrary library = PluginLibrary::load(file);
    for (const PluginTable* table : library.tables()) {
      const std::string group =
          library.tables().size() == 1 ? std::string(suite) : std::string(suite) + "_" + table->id;
      register_checks(group, table->kind, [=](const Check& check) {
        return new ConformanceTest(check, *table, Setup{section, switches}, seed);
      });
    }
  } catch (const PluginError& error) {
    testing::RegisterTest(
        suite, "load", nullptr, nullptr, __FILE__, __LINE__,
        [why = std::string(error.what())]() -> testing::Test* { return new LoadTest(why); });
  }
  return true;
}

/// The same of a library with one plugin of kind `kind`, which is loaded when a test of it runs: a program
/// with tests of many plugins, each in a process of its own, would load them all each time.
inline bool register_tests(PluginKind kind, const char* suite, const std::string& file,
                           const std::string& section = {}, std::uint64_t seed = 1, bool switches = true)
{
  register_checks(suite, kind, [=](const Check& check) -> testing::Test* {
    try {
      const PluginLibrary library = PluginLibrary::load(file);
      if (library.tables().size() != 1 || library.tables().front()->kind != kind)
        return new LoadTest(file + " is no library with one plugin of the kind that was said");
      return new ConformanceTest(check, *library.tables().front(), Setup{section, switches}, seed);
    } catch (const PluginError& error) {
      return new LoadTest(error.what());
    }
  });
  return true;
}

}  // namespace hauberk::conformance

#define HAUBERK_CONFORMANCE_TESTS(suite, ...)        \
  static const bool hauberk_conformance_of_##suite = \
      ::hauberk::conformance::register_tests(#suite, __VA_ARGS__)
