#pragma once
/// Who decides what code runs.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hauberk {

/// A sentence for each of these folders, and each library in them, that somebody else than this process's
/// user and root can write: whoever writes there decides what this program runs. Folders that do not exist
/// are passed over; folders above them are not looked at. A group is somebody else unless it is this
/// process's own, which by the custom of user private groups has one member. Thread safe.
std::vector<std::string> open_to_others(std::span<const std::filesystem::path> folders);

}  // namespace hauberk
