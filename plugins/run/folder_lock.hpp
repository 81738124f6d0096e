#pragma once
/// One run at a time for each output folder.

#include <filesystem>
#include <string>

namespace hauberk {

/// File that says which run an output folder belongs to.
inline constexpr const char* lock_file = ".hauberk-lock";

/// Holds an output folder for this run until it is destroyed: a file made only where none is, which names
/// machine, process, when they began, and the namespace of processes. Where the file cannot be made for other
/// reasons nothing is held: what is wrong with the folder shows when results are written. Not thread safe.
class FolderLock {
 public:
  /// Takes over what is left of a run that is gone. That of another machine, or of another namespace of
  /// processes, is never taken to be gone: `take_over` names it as HOST:PID. Throws InputError naming the run
  /// that holds the folder, and the way out; also where `take_over` names another one.
  FolderLock(const std::filesystem::path& folder, const std::string& take_over);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  bool held_ = false;
};

}  // namespace hauberk
