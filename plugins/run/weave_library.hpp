#pragma once
#include <hauberk/experiment/experiment.hpp>

#include <filesystem>
#include <string>

namespace hauberk {

/// Weaves for an experiment in `folder`: a name is NAME.json of `library`; anything with '/' or '.' in it is
/// a path, seen from `folder`.
WeaveLookup weave_lookup(const std::filesystem::path& folder, const std::filesystem::path& library);

/// The same for the experiment file `file`, with ../share/hauberk/weaves seen from this program's folder.
WeaveLookup weave_lookup(const std::string& file);

}  // namespace hauberk
