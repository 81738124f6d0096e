#pragma once
/// What `weave -o` leaves in a folder: a maker's answers, the results that they come from, and pictures.

#include "document/atomic_file.hpp"
#include "maker/weave_sheet.hpp"

#include <filesystem>
#include <vector>

namespace hauberk::command {

/// Names of all files that weave_files may give, results.json first.
std::vector<const char*> weave_file_names();

/// weave.html, weave.txt, weave.json, experiment.json, and the files of the run that the answers rest on: its
/// results are those of `hauberk run` of experiment.json. Without libpng the page has no pictures, which a
/// warning says.
std::vector<NamedContent> weave_files(const maker::Sheet& sheet, const std::filesystem::path& folder,
                                      unsigned threads);

}  // namespace hauberk::command
