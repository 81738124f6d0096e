#include "run/run_folder.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <cstdlib>

namespace hauberk {
namespace {

/// Between partial results; a kill loses at most this much.
constexpr std::chrono::seconds write_interval{2};

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

}  // namespace

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
      own_(resuming)
{
}

void RunFolder::replace(const std::vector<NamedContent>& files)
{
  last_ = std::chrono::steady_clock::now();  // also when it fails: a full disk is not asked at every iterate
  write_files_atomically(directory_, files, names_, own_ ? FormerResults::replaced : FormerResults::kept);
  own_ = true;
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
  if (std::chrono::steady_clock::now() - last_ >= write_interval) write_partial();
}

void RunFolder::done()
{
  drop_previous(directory_, names_);
  drop_journal(directory_);
}

}  // namespace hauberk
