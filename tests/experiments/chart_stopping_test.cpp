/// Charts again: the same values, and going on where a run was stopped.

#include "chart_fixture.hpp"

#include <hauberk/results/json_text.hpp>

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
  std::ofstream(out + "/results.json") << write_json(partial);
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

TEST_F(ChartStopping, AnInterruptLeavesWhatIsFinished)
{
  // The last point is never done: its round never ends.
  const std::string file = folder_->write(
      "endless.json", with(with(chart_text(), R"("/solver/max_iterations", "values": [500, 500, 1])",
                                R"("/solver/starts", "values": [1, 1, 200000])"),
                           R"("threads": [1, 2])", R"("threads": [1])"));
  const std::string out = *folder_ / "endless";
  const TemporaryFolder streams;
  Process process({"run", file, "-o", out, "--set", "/expect=[]"}, streams);
  for (int wait = 0; wait < 1200 && !fs::exists(out + "/results.json"); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  process.signal(SIGINT);
  const Outcome o = process.wait();
  EXPECT_EQ(o.code, 130) << o.err;
  const json::value r = read_results(out);
  EXPECT_EQ(text(r.at_pointer("/chart/scenes/1/reference/status")), "done");
  const json::value& last = point(r, 4);
  EXPECT_EQ(text(last.at("status")), "interrupted");
  EXPECT_TRUE(last.at("seconds").is_null());
  EXPECT_TRUE(last.at("error").is_null());
  EXPECT_TRUE(holds(read_text(out + "/chart.svg"), "chain, arc, hasty: interrupted<"));
  const Outcome verified = run_program({"verify", out});
  EXPECT_EQ(verified.code, 0) << verified.out;
}

TEST_F(ChartStopping, TimesOfAnotherMachineAreNotMixedIn)
{
  const std::string out = *folder_ / "moved";
  fs::copy(*folder_ / "out", out);
  json::value elsewhere = results_;
  elsewhere.at_pointer("/provenance/machine/processors") = 4097;
  elsewhere.at_pointer("/chart/points/2/status") = "interrupted";
  std::ofstream(out + "/results.json") << write_json(elsewhere);
  const Outcome o = run_program({"run", *folder_ / "c.json", "-o", out, "--resume"});
  EXPECT_EQ(o.code, 2);
  EXPECT_TRUE(holds(o.err, "cannot be resumed: it was timed on another machine (4097 of '"));
}

}  // namespace
}  // namespace hauberk::test
