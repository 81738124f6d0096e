#pragma once
/// The weaves that an experiment may name.

#include <hauberk/experiment/experiment.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace hauberk {

/// Weaves for an experiment in `folder`: a name is NAME.json of `library`; anything with '/' or '.' in it is
/// a path, seen from `folder`.
WeaveLookup weave_lookup(const std::filesystem::path& folder, const std::filesystem::path& library);

/// The same for the experiment file `file`, with ../share/hauberk/weaves seen from this program's folder.
WeaveLookup weave_lookup(const std::string& file);

/// Names of the weaves that the program has, in alphabetical order; none where its folder of them cannot be
/// read.
std::vector<std::string> library_weaves();

}  // namespace hauberk
