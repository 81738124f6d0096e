/// Charts again: the same values, and going on where a run was stopped.

#include "chart_fixture.hpp"
#include "document/json_text.hpp"
#include "result_files.hpp"

#include <boost/json/object.hpp>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;
namespace json = boost::json;

class ChartStopping : public ChartFixture {};

TEST_F(ChartStopping, SameValuesInAnotherRun)
{
  const std::string out = *folder_ / "again";
  ASSERT_EQ(run_program({"run", *folder_ / "c.json", "-o", out, "--threads", "1"}).code, 0);
  EXPECT_EQ(write_json(timeless(read_results(out))), write_json(timeless(results_)));
}

TEST_F(ChartStopping, ResumesRunsThatAreMissing)
{
  const std::string out = *folder_ / "resumed";
  fs::copy(*folder_ / "out", out);
  json::value partial = results_;
  // One has a run, one has none.
  partial.at_pointer("/chart/points/2/status") = "interrupted";
  partial.at_pointer("/chart/points/2/seconds/runs").as_array().pop_back();
  json::object& none = partial.at_pointer("/chart/points/11").as_object();
  none["status"] = "interrupted";
  none["seconds"] = none["error"] = nullptr;
  none["values"] = json::array{};
  // Marks a point that must not be computed again.
  partial.at_pointer("/chart/points/0/seconds/runs/0") = 1e-9;
  partial.at_pointer("/provenance/machine/load_average") = 1e6;
  write_partial_results(out, partial);
  const Outcome o = run_program({"run", *folder_ / "c.json", "-o", out, "--resume"});
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  EXPECT_TRUE(holds(o.err, "resuming: finished runs are kept\n"));
  EXPECT_TRUE(holds(o.err, "chart: 3/3"));
  const json::value resumed = read_results(out);
  EXPECT_EQ(number_at(resumed, "/chart/points/0/seconds/min"), 1e-9);
  EXPECT_EQ(number_at(resumed, "/chart/points/2/seconds/runs/0"),
            number_at(results_, "/chart/points/2/seconds/runs/0"));
  EXPECT_EQ(number_at(resumed, "/provenance/machine/load_average"), 1e6);
  EXPECT_EQ(write_json(timeless(resumed)), write_json(timeless(results_)));
  EXPECT_EQ(run_program({"verify", out}).code, 0);
  EXPECT_EQ(run_program({"run", *folder_ / "c.json", "-o", out, "--resume"}).out,
            out + "/results.json: complete already\nall 1 expected results are met\n");
}

/// Runs of the last point on the disk.
std::size_t runs_of_last(const std::string& out)
{
  if (!fs::exists(out + "/results.json")) return 0;
  const json::value results = read_results(out);
  const json::value& seconds = point(results, point_count - 1).at("seconds");
  return seconds.is_null() ? 0 : seconds.at("runs").as_array().size();
}

/// Interrupts when the last point has two more runs than before, which is on the disk every few seconds. One
/// more would not do: an interrupt between points leaves the first ones a run ahead.
Outcome interrupt_later(const std::vector<std::string>& arguments, const std::string& out)
{
  const WorkFolder streams;
  const std::size_t before = runs_of_last(out);
  Process process(arguments, streams);
  for (int wait = 0; wait < 1200 && runs_of_last(out) <= before + 1; ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  process.signal(SIGINT);
  return process.wait();
}

TEST_F(ChartStopping, AnInterruptLeavesWhatIsFinished)
{
  // So many runs take hours.
  const std::string file =
      folder_->write("endless.json", with(chart_text(), R"("repeats": 2)", R"("repeats": 1000000)"));
  const std::string out = *folder_ / "endless";
  Outcome o = interrupt_later({"run", file, "-o", out}, out);
  EXPECT_EQ(o.code, 130) << o.err;
  EXPECT_TRUE(holds(o.out, "interrupted: these results are partial; go on with --resume\n"));
  const json::value r = read_results(out);
  EXPECT_EQ(text(r.at_pointer("/chart/scenes/1/reference/status")), "done");
  EXPECT_EQ(number_at(r, "/chart/counts/interrupted"), 12.0);
  EXPECT_EQ(number_at(r, "/chart/counts/failed"), 2.0) << "those are finished";
  const json::array runs = r.at_pointer("/chart/points/0/seconds/runs").as_array();
  EXPECT_EQ(point(r, 0).at("error"), point(results_, 0).at("error")) << "known from the first run on";
  EXPECT_EQ(run_program({"verify", out}).code, 0);
  // The runs that were made stay.
  o = interrupt_later({"run", file, "-o", out, "--resume"}, out);
  EXPECT_EQ(o.code, 130) << o.err;
  const json::value more = read_results(out);
  json::array kept = more.at_pointer("/chart/points/0/seconds/runs").as_array();
  ASSERT_GT(kept.size(), runs.size());
  kept.resize(runs.size());
  EXPECT_EQ(kept, runs);
  EXPECT_EQ(point(more, 8).at("seconds"), point(r, 8).at("seconds")) << "not tried again";
}

TEST_F(ChartStopping, TimesOfAnotherMachineAreNotMixedIn)
{
  const std::string out = *folder_ / "moved";
  fs::copy(*folder_ / "out", out);
  json::value elsewhere = results_;
  elsewhere.at_pointer("/provenance/machine/processors") = 4097;
  elsewhere.at_pointer("/chart/points/2/status") = "interrupted";
  write_partial_results(out, elsewhere);
  const Outcome o = run_program({"run", *folder_ / "c.json", "-o", out, "--resume"});
  EXPECT_EQ(o.code, 2);
  EXPECT_TRUE(holds(o.err, "cannot be resumed: it was timed on another machine (4097 of '"));
}

}  // namespace
}  // namespace hauberk::test
