#include "parts/search_log.hpp"

#include "numerics/fnv.hpp"
#include "parts/locked_record.hpp"
#include "parts/part_folder.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace hauberk {
namespace {

namespace fs = std::filesystem;

constexpr char origin_mark = 'H', search_mark = 'S', end_mark = 'E';

/// The outcome of a search's record: all of it but the time, which comes last.
std::uint64_t outcome_of(std::string_view record)
{
  Fnv1a hash;
  hash.add(record.substr(0, record.rfind(' ')));
  return hash.value();
}

std::string origin_line(const LogOrigin& origin)
{
  RecordWriter out(origin_mark);
  out.words(search_log_format);
  out.words(origin.identity);
  out.words(origin.part);
  out.words(origin.processor);
  out.words(origin.run);
  return std::move(out).line();
}

std::optional<LogOrigin> read_origin(std::string_view record)
{
  if (!record.starts_with(origin_mark)) return std::nullopt;
  RecordReader in(record.substr(1));
  LogOrigin origin;
  if (in.words() != search_log_format) return std::nullopt;
  origin.identity = in.words();
  origin.part = in.words();
  origin.processor = in.words();
  origin.run = in.words();
  return in.good && in.ended() ? std::optional(origin) : std::nullopt;
}

/// The name of a search's record; null where it is none.
std::optional<std::string> name_of_record(std::string_view record)
{
  if (!record.starts_with(search_mark)) return std::nullopt;
  RecordReader in(record.substr(1));
  std::string name = in.words();
  return in.good ? std::optional(std::move(name)) : std::nullopt;
}

std::optional<KnownSearch> read_search(std::string_view record)
{
  RecordReader in(record.substr(1));
  in.words();
  KnownSearch out;
  out.locked = read_locked(in);
  out.seconds = in.number<double>();
  return in.good && in.ended() ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace

SearchLogs::SearchLogs(std::string identity, Warn warn)
    : identity_(std::move(identity)), warn_(std::move(warn))
{
}

std::optional<SearchLogs::Contents> SearchLogs::read(const fs::path& file)
{
  std::error_code unknown;
  std::ifstream in;
  if (fs::symlink_status(file, unknown).type() == fs::file_type::regular) in.open(file, std::ios::binary);
  const auto refuse = [&](const char* what) -> std::optional<Contents> {
    warn_(fmt::format("warning: {}: {}; nothing of it is believed", file.string(), what));
    return std::nullopt;
  };
  if (!in.is_open()) return refuse("cannot be read as a file");
  std::string line;
  if (!std::getline(in, line) || in.eof()) return refuse("has no first line");
  const std::optional<std::string_view> first = undamaged_record(line);
  const std::optional<LogOrigin> origin = first ? read_origin(*first) : std::nullopt;
  if (!origin) return refuse(fmt::format("is no log of searches ({})", search_log_format).c_str());
  if (origin->identity != identity_)
    throw InputError(fmt::format(
        "{}: was computed from another experiment, or by another build of the program or of a plugin; remove "
        "it, or use another folder",
        file.string()));
  Contents contents{*origin, 0, false};
  files_.push_back({file, *origin});
  auto begin = static_cast<std::streamoff>(line.size() + 1);
  for (std::size_t number = 2; std::getline(in, line) && !in.eof(); ++number) {
    const std::optional<std::string_view> record = undamaged_record(line);
    if (!record) {
      warn_(fmt::format("warning: {}: line {} is damaged; it and what follows are computed again",
                        file.string(), number));
      break;
    }
    if (const std::optional<std::string> name = name_of_record(*record)) {
      enter(*name, {files_.size() - 1, begin, record->size(), outcome_of(*record)});
      ++contents.searches;
    }
    contents.complete = contents.complete || record->starts_with(end_mark);
    begin += static_cast<std::streamoff>(line.size() + 1);
  }
  return contents;
}

void SearchLogs::enter(const std::string& name, const Entry& entry)
{
  std::vector<Entry>& known = entries_[name];
  const std::string& processor = files_[entry.file].origin.processor;
  const auto same =
      std::find_if(known.begin(), known.end(), [&](const Entry& e) { return e.outcome == entry.outcome; });
  for (const Entry& other : known) {
    const bool one_processor = files_[other.file].origin.processor == processor;
    if (other.outcome == entry.outcome || (same != known.end() && !one_processor)) continue;
    conflicts_.push_back({name, where(other.file), where(entry.file), one_processor});
  }
  // Also an equal outcome on another processor, for those that come later to be compared with.
  if (same == known.end() || files_[same->file].origin.processor != processor) known.push_back(entry);
}

std::string SearchLogs::where(std::size_t file) const
{
  const File& at = files_[file];
  const LogOrigin& origin = at.origin;
  return fmt::format("{} ({}{}{})", at.path.string(), origin.run, origin.processor.empty() ? "" : ", ",
                     origin.processor);
}

void SearchLogs::write_to(fs::path folder, std::string name, LogOrigin origin)
{
  own_folder_ = std::move(folder);
  own_name_ = std::move(name);
  own_ = std::move(origin);
  own_.identity = identity_;
}

/// Called by one thread at a time. False: it could not be written, and nothing more will be.
bool SearchLogs::write(const std::string& line)
{
  if (own_folder_.empty()) return true;
  if (own_file_.empty()) {
    try {
      std::error_code unmade;
      fs::create_directories(own_folder_, unmade);
      own_file_ = claim_log(own_folder_, own_name_);
      out_.open(own_file_, std::ios::binary | std::ios::app);
      out_ << origin_line(own_) << '\n';
    } catch (const ComputationError&) {
      own_file_ = own_folder_ / own_name_;
    }
  }
  if (!out_.is_open()) return false;
  out_ << line << '\n' << std::flush;
  if (out_.good()) return true;
  out_.close();
  return false;
}

bool SearchLogs::complete()
{
  const std::lock_guard lock(mutex_);
  return write(RecordWriter(end_mark).line());
}

std::optional<KnownSearch> SearchLogs::recall(const std::string& name)
{
  const auto known = entries_.find(name);
  if (known == entries_.end()) return std::nullopt;
  {
    const std::lock_guard lock(mutex_);
    const Entry& entry = known->second.front();
    if (File& file = files_[entry.file]; checking_ && !file.withheld) {
      file.withheld = true;
      withheld_.emplace(name, entry);
      return std::nullopt;
    }
    if (withheld_.contains(name)) return std::nullopt;
  }
  return read_entry(known->second.front());
}

std::size_t SearchLogs::done_again() const
{
  const std::lock_guard lock(mutex_);
  return done_again_;
}

std::optional<KnownSearch> SearchLogs::read_entry(const Entry& entry) const
{
  std::ifstream in(files_[entry.file].path, std::ios::binary);
  std::string record(entry.length, ' ');
  in.seekg(entry.begin);
  in.read(record.data(), static_cast<std::streamsize>(record.size()));
  if (!in.good() || outcome_of(record) != entry.outcome) return std::nullopt;  // somebody changed it
  return read_search(record);
}

void SearchLogs::note_useless(const Entry& entry, const std::string& name)
{
  ++done_again_;
  File& file = files_[entry.file];
  if (file.useless) return;
  file.useless = true;
  warn_(fmt::format(
      "warning: {}: what it has of the search '{}' is of no use; this one and the like are done again",
      file.path.string(), name));
}

void SearchLogs::record(const std::string& name, const Locked& locked, double seconds)
{
  if (!is_recordable(locked)) return;
  RecordWriter out(search_mark);
  out.words(name);
  write_locked(locked, out);
  out.number(seconds);
  const std::uint64_t outcome = outcome_of(out.text());
  const std::string line = std::move(out).line();
  const std::lock_guard lock(mutex_);
  if (const auto other = withheld_.find(name); other != withheld_.end()) {
    const Entry& entry = other->second;
    files_[entry.file].checked = true;
    if (entry.outcome != outcome)
      conflicts_.push_back(
          {name, where(entry.file), "", files_[entry.file].origin.processor == own_.processor});
    return;
  }
  if (const auto known = entries_.find(name); known != entries_.end())
    note_useless(known->second.front(), name);
  const bool tried = out_.is_open() || own_file_.empty();
  if (!write(line) && tried)
    warn_(
        fmt::format("warning: {}: cannot be written; going on, but what is computed from here on is not kept",
                    own_file_.string()));
}

std::vector<SearchLogs::Conflict> SearchLogs::conflicts() const
{
  const std::lock_guard lock(mutex_);
  return conflicts_;
}

std::pair<std::size_t, std::size_t> SearchLogs::checked() const
{
  const std::lock_guard lock(mutex_);
  std::size_t checked = 0;
  for (const File& file : files_) checked += file.checked ? 1 : 0;
  return {checked, files_.size()};
}

}  // namespace hauberk
