#pragma once
/// Evaluations of a design, kept in a file beside its partial results.

#include "design/evaluation_memory.hpp"

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace hauberk {

/// A text file of lines: first who computes, then one line per evaluation and one per set of warm starts,
/// with every number in the shortest form that reads back as the same double and with a checksum. Lines are
/// written whole, and one that a kill cut off is ignored; from one that is damaged on nothing is believed,
/// which is warned of. Where the file cannot be written, a warning says so and nothing more
/// is remembered. Not thread safe.
class EvaluationLog final : public EvaluationMemory {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// `identity` is one line that says what is computed and by which program. With `go_on` evaluations that
  /// the file has under the same identity are recalled; otherwise the file is begun anew.
  EvaluationLog(std::filesystem::path file, std::string_view identity, bool go_on, Warn warn);

  /// The first line of a file, without its break.
  static std::string first_line(std::string_view identity);

  /// Evaluations that the file held.
  std::size_t known() const { return known_; }

  /// Closest points evaluated by all that was recalled or recorded.
  long closest_points() const { return closest_points_; }

  bool recall(DesignPoint& p, long& evaluations) override;
  void record(const DesignPoint& p, long evaluations) override;
  bool recall_states(DesignPoint& p) override;
  void record_states(const DesignPoint& p) override;

 private:
  struct Line {
    std::size_t begin = 0;  ///< in the file
    std::string text;
  };

  bool read(std::string_view identity);
  void write(const std::string& line);
  /// Drops all that has not been recalled, in the file, too.
  void forget();

  std::filesystem::path file_;
  Warn warn_;
  std::vector<Line> lines_;
  std::size_t next_ = 0;
  std::size_t known_ = 0;
  long closest_points_ = 0;
  std::ofstream out_;
};

/// The record of an evaluation, without its checksum.
std::string evaluation_record(const DesignPoint& p, long evaluations);

}  // namespace hauberk
