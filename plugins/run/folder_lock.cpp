#include "run/folder_lock.hpp"

#include "run/first_line.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <fstream>
#include <sstream>

namespace hauberk {
namespace {

namespace fs = std::filesystem;

/// When a process began, in ticks since the machine did: field 22 of its stat, counted behind its name,
/// which may have spaces and brackets. Empty where there is no such process, or where it has ended and its
/// parent has not asked for it yet.
std::string start_of(long pid)
{
  const std::string stat = first_line(fs::path("/proc") / std::to_string(pid) / "stat");
  const std::size_t behind = stat.rfind(')');
  if (behind == std::string::npos) return "";
  std::istringstream fields(stat.substr(behind + 1));
  constexpr int from_the_state = 19;
  std::string word;
  fields >> word;
  if (word == "Z" || word == "X") return "";
  for (int k = 0; k < from_the_state; ++k) fields >> word;
  return word;
}

/// The run that a lock names.
struct Holder {
  std::string host, boot, processes, start;  ///< machine and when it began; namespace of processes
  long pid = 0;

  std::string name() const { return fmt::format("{}:{}", host, pid); }
  std::string text() const { return fmt::format("{} {} {} {} {}\n", host, pid, start, boot, processes); }
};

Holder this_run()
{
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  std::error_code error;
  Holder own{host.data(), first_line("/proc/sys/kernel/random/boot_id"),
             fs::read_symlink("/proc/self/ns/pid", error).string(), start_of(::getpid()), ::getpid()};
  for (std::string* word : {&own.host, &own.boot, &own.processes, &own.start})
    if (word->empty() || word->find(' ') != std::string::npos) *word = "-";
  return own;
}

Holder read_holder(const fs::path& file)
{
  std::istringstream in(first_line(file));
  Holder holder;
  in >> holder.host >> holder.pid >> holder.start >> holder.boot >> holder.processes;
  return holder;
}

/// Certain only of a process that this one can look for.
bool is_gone(const Holder& holder, const Holder& own)
{
  if (holder.host != own.host || holder.host == "-") return false;
  if (holder.boot != own.boot) return true;
  return holder.processes == own.processes && start_of(holder.pid) != holder.start;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, const std::string& take_over) : file_(folder / lock_file)
{
  const Holder own = this_run();
  constexpr int attempts = 3;  // others may find the same lock left behind, and be quicker
  for (int k = 0; k < attempts; ++k) {
    const int file = ::open(file_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file >= 0) {
      const std::string text = own.text();
      // A lock that a full disk leaves empty is one all the same.
      static_cast<void>(::write(file, text.data(), text.size()) < 0);
      ::close(file);
      held_ = true;
      return;
    }
    if (errno != EEXIST) return;
    const Holder holder = read_holder(file_);
    if (!is_gone(holder, own) && holder.name() != take_over) {
      throw InputError(fmt::format(
          "{}: the run {} writes into this folder; wait for it, give another folder with -o, or, if it is no "
          "more, --take-over {}{}",
          folder.string(), holder.name(), holder.name(),
          take_over.empty() ? "" : fmt::format(" (not {})", take_over)));
    }
    ::unlink(file_.c_str());
  }
  throw InputError(
      fmt::format("{}: other runs begin in this folder; give another one with -o", folder.string()));
}

FolderLock::~FolderLock()
{
  // It may have been taken over.
  if (held_ && first_line(file_) + "\n" == this_run().text()) ::unlink(file_.c_str());
}

}  // namespace hauberk
