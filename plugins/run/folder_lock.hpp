#pragma once
/// One run at a time for each output folder.

#include <filesystem>
#include <string>

namespace hauberk {

/// File that says which run an output folder belongs to.
inline constexpr const char* lock_file = ".hauberk-lock";

/// Holds an output folder for this run until it is destroyed: an advisory lock (flock) of a file that names
/// machine and process. The system takes the lock from a process that ends, however it ends, so what a killed
/// run leaves is taken over. Other machines may not see it: the file of another one, or of one of which
/// nothing but the name is known to be the same, counts as held until `take_over` names its run as HOST:PID.
/// Where the file cannot be made nothing is held; what is wrong with the folder shows when results are
/// written. Not thread safe.
class FolderLock {
 public:
  /// Throws InputError naming the run that holds the folder, and the way out; also where `take_over` names
  /// another one, or one that is known to be going on.
  FolderLock(const std::filesystem::path& folder, const std::string& take_over);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;  ///< -1: nothing is held
};

}  // namespace hauberk
