/// A design that was interrupted ends as if it had not been, whatever the optimizer.

#include "document/json_text.hpp"
#include "result_files.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <thread>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;
namespace json = boost::json;

constexpr const char* log_name = ".hauberk-evaluations";

/// A run and the evaluations it made.
struct Whole {
  json::value results;
  std::vector<std::string> log;
};

/// Runs to the end. The program removes its evaluations then; a second name keeps them.
Whole run_whole(const WorkFolder& folder, const std::string& file)
{
  const fs::path log = folder.path() / "whole" / log_name, kept = folder.path() / "kept";
  Process process({"run", file, "-o", folder / "whole", "--threads", "2"}, folder);
  std::error_code error;
  for (int k = 0; k < 60000; ++k) {
    fs::create_hard_link(log, kept, error);
    if (!error) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const Outcome o = process.wait();
  EXPECT_FALSE(error) << "the run kept no evaluations";
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_FALSE(fs::exists(log));
  return {timeless(read_results(folder / "whole")), lines_of(kept)};
}

std::size_t evaluations(const std::vector<std::string>& lines)
{
  return static_cast<std::size_t>(
      std::count_if(lines.begin(), lines.end(), [](const std::string& l) { return l.starts_with("E "); }));
}

class RepeatedSearch : public ::testing::TestWithParam<std::pair<const char*, const char*>> {
 protected:
  /// Leaves a folder as a run does that was killed when its evaluations were `log`, and resumes.
  Outcome resume(const std::string& file, const Whole& whole, const std::string& out,
                 const std::string& log) const
  {
    json::value partial = whole.results;
    partial.at_pointer("/design/status") = "interrupted";
    partial.at("limits").as_array().clear();
    fs::remove_all(out);
    fs::create_directory(out);
    write_partial_results(out, partial);
    std::ofstream(fs::path(out) / log_name, std::ios::binary) << log;
    return run_program({"run", file, "-o", out, "--resume", "--threads", "1"});
  }
};

TEST_P(RepeatedSearch, EndsAsOneRunWhereverItWasInterrupted)
{
  const WorkFolder folder;
  // Two starts, so that interrupts hit the first, the second and the final search.
  const std::string file =
      folder.write("mail.json", with(with(with(design_text(), R"({ "plugin": "sqp" })", GetParam().second),
                                          R"("perturbation": 0,)", R"("starts": 2, "perturbation": 0.03,)"),
                                     R"("max_iterations": 3)", R"("max_iterations": 2)"));
  const Whole whole = run_whole(folder, file);
  ASSERT_GT(whole.log.size(), 12U);
  ASSERT_EQ(whole.results.at_pointer("/design/starts").as_array().size(), 2U);
  const std::string expected = write_json(whole.results);
  // A line that is cut off, in the middle; at the end. For one optimizer, as a run of each costs seconds,
  // also after the first evaluation but before its states, and in the second start.
  const std::size_t n = whole.log.size();
  std::vector<std::pair<std::size_t, bool>> interrupts{{n / 3, true}, {n, false}};
  if (std::string_view(GetParam().first) == "sqp")
    interrupts.insert(interrupts.end(), {{2, false}, {2 * n / 3, false}});
  for (const auto& [count, cut] : interrupts) {
    std::string log;
    for (std::size_t k = 0; k < count; ++k) log += whole.log[k] + "\n";
    if (cut) log += whole.log[count].substr(0, whole.log[count].size() / 2);
    const Outcome o = resume(file, whole, folder / "out", log);
    EXPECT_EQ(o.code, 0) << o.err;
    const std::vector<std::string> known(whole.log.begin(),
                                         whole.log.begin() + static_cast<std::ptrdiff_t>(count));
    EXPECT_NE(o.err.find("resuming: " + std::to_string(evaluations(known)) +
                         " evaluations of the search are known\n"),
              std::string::npos)
        << o.err;
    EXPECT_EQ(write_json(timeless(read_results(folder / "out"))), expected) << count << " of " << n;
    EXPECT_FALSE(fs::exists(fs::path(folder / "out") / log_name));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Optimizers, RepeatedSearch,
    ::testing::Values(std::pair{"sqp", R"({ "plugin": "sqp" })"},
                      std::pair{"sqp_bfgs", R"({ "plugin": "sqp", "hessian": "bfgs" })"},
                      std::pair{"bfgs", R"({ "plugin": "bfgs" })"},
                      std::pair{"nlopt_slsqp", R"({ "plugin": "nlopt" })"},
                      std::pair{"nlopt_mma", R"({ "plugin": "nlopt", "algorithm": "mma" })"},
                      std::pair{"nlopt_ccsaq", R"({ "plugin": "nlopt", "algorithm": "ccsaq" })"},
                      std::pair{"nlopt_lbfgs", R"({ "plugin": "nlopt", "algorithm": "lbfgs" })"},
                      std::pair{"nlopt_cobyla", R"({ "plugin": "nlopt", "algorithm": "cobyla" })"}),
    [](const auto& info) { return info.param.first; });

TEST_F(RepeatedSearch, EvaluationsThatAreNotTheSearchsOwnAreNotUsed)
{
  const WorkFolder folder;
  const std::string file = folder.write("mail.json", design_text());
  const Whole whole = run_whole(folder, file);
  const std::string expected = write_json(whole.results);
  std::string all;
  for (const std::string& line : whole.log) all += line + "\n";
  // Another experiment; an evaluation of another design; a value that is no number; no evaluations at all.
  std::string other = all, moved = all, damaged = all;
  other.replace(other.find("{"), 1, "{ ");
  const std::size_t second = all.find("\nE ", all.find("\nE ") + 1);
  moved.replace(second + 5, 1, "9");
  damaged.replace(second + 6, 1, "x");
  for (const std::string& log : {other, moved, damaged, std::string()}) {
    const Outcome o = resume(file, whole, folder / "out", log);
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(write_json(timeless(read_results(folder / "out"))), expected);
  }
}

TEST_F(RepeatedSearch, AKilledRunIsGoneOnWith)
{
  const WorkFolder folder;
  const std::string file = folder.write("mail.json", design_text());
  const Whole whole = run_whole(folder, file);
  const std::string out = folder / "out";
  Process process({"run", file, "-o", out, "--threads", "1"}, folder);
  const fs::path log = fs::path(out) / log_name;
  for (int k = 0; k < 60000 && evaluations(lines_of(log)) < 3; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  process.signal(SIGKILL);
  process.wait();
  ASSERT_GE(evaluations(lines_of(log)), 3U);
  EXPECT_EQ(run_program({"run", file, "-o", out, "--resume"}).code, 0);
  EXPECT_EQ(write_json(timeless(read_results(out))), write_json(whole.results));
}

}  // namespace
}  // namespace hauberk::test
