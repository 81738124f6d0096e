#pragma once
/// Logs of the searches from each start of a design, which parts of a divided run write (EvaluationLog).

#include "tasks/design/evaluation_log.hpp"

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hauberk {

/// A log of the search from one start; its first line is of the identity `part_identity`.
struct StartLog {
  std::filesystem::path file;
  std::string processor;
};

/// The identity of logs of parts: with the kind of processor.
std::string part_identity(std::string_view identity, const std::string& processor);

/// The logs of a start in folders of parts, in their order; not those that a kill left without a first line.
/// Throws ComputationError where one is of another identity, whatever the processor.
std::vector<StartLog> logs_of_start(std::span<const std::filesystem::path> folders, int start,
                                    std::string_view identity);

/// A log of a start that no other process writes, with what others on this kind of processor have found of
/// it. Throws ComputationError as logs_of_start, and where none can be made.
std::filesystem::path claim_start_log(const std::filesystem::path& folder, int start,
                                      std::string_view identity, const std::string& processor);

/// Of several logs of one search the one with the most lines: what two have both is the same. Where it is
/// not, throws ComputationError naming both if their processors are of one kind, else calls `warn` and takes
/// the first.
StartLog longest_of(const std::vector<StartLog>& logs, const EvaluationLog::Warn& warn);

/// Whether the first evaluation of a log is this one (evaluation_record); also where there is none to
/// compare.
bool begins_with(const StartLog& log, const std::string& evaluation);

/// Writes `file` as the log of one search from several starts out of logs of each of them, in this order. A
/// file that begins with just that stays: it holds what a search went on to. Throws ComputationError where it
/// cannot be written.
void join_evaluations(const std::vector<StartLog>& logs, std::string_view identity,
                      const std::filesystem::path& file);

/// Notes the first evaluation of a search, and knows none.
class FirstEvaluation final : public EvaluationMemory {
 public:
  bool recall(DesignPoint& /*p*/, long& /*evaluations*/) override { return false; }
  void record(const DesignPoint& p, long evaluations) override
  {
    if (record_.empty()) record_ = evaluation_record(p, evaluations);
  }
  bool recall_states(DesignPoint& /*p*/) override { return false; }
  void record_states(const DesignPoint& /*p*/) override {}

  /// Empty: there was none.
  const std::string& text() const { return record_; }

 private:
  std::string record_;
};

}  // namespace hauberk
