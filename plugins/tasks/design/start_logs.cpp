#include "tasks/design/start_logs.hpp"

#include "document/atomic_file.hpp"
#include "document/read_file.hpp"
#include "document/record_line.hpp"
#include "parts/part_folder.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

namespace hauberk {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view on = " on ";

std::string log_name(int start) { return fmt::format("start-{}", start); }

std::string text_of_log(const fs::path& log) { return read_whole_file(log.string(), largest_results); }

/// Without its first line, and without what a kill cut off.
std::string lines_of_log(const fs::path& log)
{
  std::string text = text_of_log(log);
  text.resize(text.rfind('\n') + 1);
  return text.substr(std::min(text.size(), text.find('\n') + 1));
}

/// Null where a kill left no first line.
std::optional<StartLog> start_log(const fs::path& file, std::string_view identity)
{
  const std::string text = text_of_log(file), first = EvaluationLog::first_line(identity);
  const std::size_t end = text.find('\n');
  if (end == std::string::npos) return std::nullopt;
  const std::string_view line = std::string_view(text).substr(0, end);
  if (line.starts_with(first) && line.substr(first.size()).starts_with(on)) {
    RecordReader in(line.substr(first.size() + on.size() + 1));
    StartLog log{file, in.words()};
    if (in.good && in.ended()) return log;
  }
  throw ComputationError(fmt::format(
      "{}: is of another experiment or build, or damaged; remove its folder and compute its part again",
      file.string()));
}

}  // namespace

std::string part_identity(std::string_view identity, const std::string& processor)
{
  RecordWriter out('P');
  out.words(processor);
  return std::string(identity) + std::string(on) + out.text();
}

std::vector<StartLog> logs_of_start(std::span<const fs::path> folders, int start, std::string_view identity)
{
  std::vector<StartLog> out;
  for (const fs::path& folder : folders) {
    for (const fs::path& file : logs_in(folder, log_name(start))) {
      if (std::optional<StartLog> log = start_log(file, identity)) out.push_back(std::move(*log));
    }
  }
  return out;
}

fs::path claim_start_log(const fs::path& folder, int start, std::string_view identity,
                         const std::string& processor)
{
  std::vector<StartLog> there = logs_of_start({&folder, 1}, start, identity);
  // A search goes on from its own numbers.
  std::erase_if(there, [&processor](const StartLog& log) { return log.processor != processor; });
  const fs::path next = claim_log(folder, log_name(start));
  if (!there.empty())
    fs::copy_file(longest_of(there, [](const std::string&) {}).file, next,
                  fs::copy_options::overwrite_existing);
  return next;
}

StartLog longest_of(const std::vector<StartLog>& logs, const EvaluationLog::Warn& warn)
{
  StartLog best = logs.front();
  std::string longest = lines_of_log(best.file);
  for (auto log = logs.begin() + 1; log != logs.end(); ++log) {
    std::string text = lines_of_log(log->file);
    if (!text.starts_with(std::string_view(longest).substr(0, text.size()))) {
      const std::string both = fmt::format("{} and {}", best.file.string(), log->file.string());
      if (log->processor == best.processor)
        throw ComputationError(fmt::format(
            "{}: are of one search and differ, though the processors are of one kind: a file or a memory is "
            "damaged; remove the folder and compute its part again",
            both));
      warn(fmt::format(
          "warning: {}: are of one search and differ: processors of several kinds round differently", both));
      continue;
    }
    if (text.size() <= longest.size()) continue;
    best = *log;
    longest = std::move(text);
  }
  return best;
}

bool begins_with(const StartLog& log, const std::string& evaluation)
{
  const std::string lines = lines_of_log(log.file);
  const auto there = undamaged_record(std::string_view(lines).substr(0, lines.find('\n')));
  return !there || evaluation.empty() || *there == evaluation;
}

void join_evaluations(const std::vector<StartLog>& logs, std::string_view identity, const fs::path& file)
{
  std::string joined = EvaluationLog::first_line(identity) + "\n";
  for (const StartLog& log : logs) joined += lines_of_log(log.file);
  std::error_code unknown;
  if (fs::symlink_status(file, unknown).type() == fs::file_type::regular &&
      text_of_log(file).starts_with(joined))
    return;
  write_files_atomically(file.parent_path(), {{file.filename().string(), joined}}, {});
}

}  // namespace hauberk
