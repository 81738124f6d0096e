#pragma once
/// Runs the real program and looks at what it leaves.

#include <boost/json/value.hpp>

#include <sys/types.h>
#include <filesystem>
#include <string>
#include <vector>

namespace hauberk::test {

/// What a run of the program did.
struct Outcome {
  int code = -1;  ///< exit code; 1000 + signal when killed by one
  std::string out, err;
};

/// A folder that is removed at the end of a test.
class WorkFolder {
 public:
  WorkFolder();
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

/// A running program. Its output goes to files of the folder, or to the places given.
class Process {
 public:
  Process(const std::vector<std::string>& arguments, const WorkFolder& folder, const std::string& out = "",
          const std::string& err = "");
  void signal(int number) const;
  Outcome wait();

 private:
  pid_t pid_ = -1;
  std::string out_, err_;
};

/// Runs the program to its end.
Outcome run_program(const std::vector<std::string>& arguments);

std::string read_text(const std::filesystem::path& file);
/// Lines of a file, without their breaks.
std::vector<std::string> lines_of(const std::filesystem::path& file);
boost::json::value read_results(const std::filesystem::path& folder);

/// The number at a JSON pointer.
double number_at(const boost::json::value& document, const std::string& pointer);

/// The timings of a folder of results.
boost::json::value read_timings(const std::filesystem::path& folder);

/// What must not depend on how it was computed: the document itself, and of a chart, whose results are times,
/// all but `seconds`, `peak_memory_bytes`, `pareto` and `machine`.
boost::json::value timeless(const boost::json::value& document);

/// `text` with the only occurrence of `from` replaced.
std::string with(std::string text, const std::string& from, const std::string& to);

/// A chain of two rings (R 5, r 0.7; period 12, limit 17.2): strict JSON.
std::string chain_text();

/// A chain of one element, the union of a ring and of an upright oval, whose wires cross at its origin
/// (period 15, limit 0.12): strict JSON.
std::string union_text();

/// A 4-in-1 chainmail of 2 x 1 cells, both senses in three directions, preset fast.
std::string chainmail_text();

/// A design of it: two targets, radii of all rings vary.
std::string design_text();

/// The chain in a stability map: easy, with a wrong and a right exact value, overlapping, and pulled where
/// nothing holds it. Ten cases.
std::string map_text();

/// A sweep over chains of two kinds of rings, R_B = R_A/2 + 2.5, r_A = r_B: 3 x 3 rows, the last three of
/// which are no scene.
std::string sweep_text();

/// The chain's rings at the cross angle of figure 2, turned through the place where the nearest point splits.
std::string transition_text();

/// A chart of two chains, one of them with a reference and a second limit that is unbounded: seven settings
/// with two numbers of threads, two runs each. The last setting stalls.
std::string chart_text();

}  // namespace hauberk::test
