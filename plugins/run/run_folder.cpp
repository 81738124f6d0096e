#include "run/run_folder.hpp"

#include "document/json_text.hpp"
#include "results/document.hpp"
#include "run/sha256.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <boost/json/object.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string_view>

namespace hauberk {
namespace {

/// Between partial results, and before the first ones; a kill loses at most this much.
constexpr std::chrono::milliseconds write_interval{2000}, first_interval{250};

/// Writes into a new folder for temporary files and returns its name; empty where that fails, too.
std::string rescue(const std::vector<NamedContent>& files)
{
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) return "";
  std::string name = (folder / "hauberk-results-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) return "";
  try {
    write_files_atomically(name, files, {});
    return name;
  } catch (const ComputationError&) {
    std::filesystem::remove(name, error);
    return "";
  }
}

/// Files that the results in a folder name as theirs; none where there are no results.
std::vector<std::string> former_files(const std::filesystem::path& folder)
{
  std::vector<std::string> out;
  std::error_code unknown;
  if (!std::filesystem::exists(folder / results_file, unknown)) return out;
  try {
    const boost::json::value results = read_json_file((folder / results_file).string());
    for (const auto& [what, name] : results.at("files").as_object()) out.emplace_back(name.as_string());
  } catch (const std::exception&) {  // not ours
    out.clear();
  }
  return out;
}

}  // namespace

std::optional<bool> is_as_written(const std::filesystem::path& directory)
{
  std::ifstream in;
  std::error_code unknown;
  if (std::filesystem::is_regular_file(std::filesystem::symlink_status(directory / digest_file, unknown)))
    in.open(directory / digest_file);
  if (!in.is_open()) return std::nullopt;
  const std::string now = sha256_of_file(directory / results_file);
  for (std::string digest; in >> digest;)
    if (digest == now) return true;
  return false;
}

void drop_journal(const std::filesystem::path& directory)
{
  std::error_code ignored;
  std::filesystem::remove(directory / journal_file, ignored);
}

RunFolder::RunFolder(std::filesystem::path directory, std::span<const char* const> names, bool resuming,
                     Progress& progress, Content content)
    : directory_(std::move(directory)),
      names_(names),
      progress_(progress),
      content_(std::move(content)),
      own_(resuming),
      next_(std::chrono::steady_clock::now() + first_interval)
{
  const std::vector<std::string> former = former_files(directory_);
  std::copy_if(names_.begin(), names_.end(), std::back_inserter(ours_), [&former](const char* name) {
    return name == std::string_view(results_file) ||
           std::find(former.begin(), former.end(), name) != former.end();
  });
  if (resuming) digest_ = sha256_of_file(directory_ / results_file);
}

void RunFolder::replace(const std::vector<NamedContent>& files)
{
  // Also when it fails: a full disk is not asked at every iterate.
  next_ = std::chrono::steady_clock::now() + write_interval;
  // Before the results: where a kill comes between, they are those before.
  std::vector<NamedContent> all = files;
  const auto results = std::find_if(all.begin(), all.end(),
                                    [](const NamedContent& file) { return file.name == results_file; });
  std::string now;
  if (results != all.end()) {
    Sha256 hash;
    hash.add(results->content);
    now = hash.digest();
    all.insert(results, {digest_file, now + "\n" + digest_ + "\n"});
  }
  write_files_atomically(directory_, all, ours_, own_ ? FormerResults::replaced : FormerResults::kept);
  digest_ = now;
  own_ = true;
  for (const char* name : names_) {
    const bool written =
        std::any_of(all.begin(), all.end(), [name](const auto& file) { return file.name == name; });
    if (written && std::find(ours_.begin(), ours_.end(), name) == ours_.end()) ours_.push_back(name);
  }
}

void RunFolder::write()
{
  const std::vector<NamedContent> files = content_();
  try {
    replace(files);
  } catch (const ComputationError& error) {
    const std::string elsewhere = rescue(files);
    if (elsewhere.empty())
      throw ComputationError(
          fmt::format("{}; make room, then go on with --resume from what was written before", error.what()));
    throw ComputationError(fmt::format(
        "{}; the results are in {}: make room and move them, or go on with --resume from what was "
        "written before",
        error.what(), elsewhere));
  }
}

void RunFolder::write_partial()
{
  const std::vector<NamedContent> files = content_();
  try {
    replace(files);
    warned_.clear();
  } catch (const ComputationError& error) {
    if (warned_ == error.what()) return;
    warned_ = error.what();
    progress_.warn(fmt::format("warning: {}; going on, and trying again", error.what()));
  }
}

void RunFolder::write_sometimes()
{
  if (std::chrono::steady_clock::now() >= next_) write_partial();
}

void RunFolder::done()
{
  drop_previous(directory_, names_);
  drop_journal(directory_);
  std::error_code ignored;
  std::filesystem::remove(directory_ / digest_file, ignored);
}

}  // namespace hauberk
