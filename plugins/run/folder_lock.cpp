#include "run/folder_lock.hpp"

#include "run/first_line.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <sstream>
#include <string>

namespace hauberk {
namespace {

namespace fs = std::filesystem;

constexpr const char* unknown = "-";

/// The run that a lock names.
struct Holder {
  std::string host, pid, machine, boot;  ///< machine: its id, whatever its name; boot: the time it is up

  std::string name() const { return host.empty() ? "?" : host + ":" + pid; }
  std::string text() const { return fmt::format("{} {} {} {}\n", host, pid, machine, boot); }
};

Holder this_run()
{
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  Holder own{host.data(), std::to_string(::getpid()), first_line("/etc/machine-id"),
             first_line("/proc/sys/kernel/random/boot_id")};
  for (std::string* word : {&own.host, &own.machine, &own.boot})
    if (word->empty() || word->find_first_of(" \t") != std::string::npos) *word = unknown;
  return own;
}

/// What the file says; nothing in it where a run was killed before it had written.
Holder read_holder(int descriptor)
{
  std::array<char, 1024> text{};
  const ssize_t length = ::pread(descriptor, text.data(), text.size(), 0);
  std::istringstream in(std::string(text.data(), static_cast<std::size_t>(std::max<ssize_t>(0, length))));
  Holder holder;
  in >> holder.host >> holder.pid >> holder.machine >> holder.boot;
  return holder;
}

/// Whether the locks of this machine would tell if the run was going on.
bool is_of_this_machine(const Holder& holder, const Holder& own)
{
  const auto same = [](const std::string& a, const std::string& b) { return a == b && a != unknown; };
  return holder.host.empty() || same(holder.boot, own.boot) ||
         (same(holder.host, own.host) && same(holder.machine, own.machine));
}

/// Of a file that another run has taken away in the meantime there is nothing to hold.
bool is_still_there(int descriptor, const fs::path& file)
{
  struct stat opened {
  }, found{};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(file.c_str(), &found) == 0 &&
         opened.st_dev == found.st_dev && opened.st_ino == found.st_ino;
}

[[noreturn]] void refuse(const fs::path& folder, const std::string& holder, const std::string& take_over,
                         bool going_on)
{
  const std::string other =
      take_over.empty() || take_over == holder ? "" : fmt::format(" (not {})", take_over);
  throw InputError(
      fmt::format("{}: the run {} writes into this folder; wait for it, or give another folder with -o{}",
                  folder.string(), holder,
                  going_on ? "" : fmt::format("; if it is no more, --take-over {}{}", holder, other)));
}

enum class Answer {
  free,    ///< no process that this machine knows has the lock
  taken,   ///< one has it
  unknown  ///< this file system has no locks
};

struct Opened {
  int descriptor = -1;  ///< -1: the file cannot be made
  Answer answer = Answer::unknown;
};

Answer ask_for_lock(int descriptor)
{
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return Answer::free;
  return errno == EWOULDBLOCK ? Answer::taken : Answer::unknown;
}

Opened open_locked(const fs::path& file)
{
  for (;;) {
    const int descriptor = ::open(file.c_str(), O_CREAT | O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    if (descriptor < 0) return {};
    const Answer answer = ask_for_lock(descriptor);
    if (is_still_there(descriptor, file)) return {descriptor, answer};
    ::close(descriptor);
  }
}

/// Whether what the file says leaves it to this run.
bool is_left(const Holder& holder, const Holder& own, Answer answer)
{
  if (answer == Answer::unknown) return holder.host.empty();
  return answer == Answer::free && is_of_this_machine(holder, own);
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, const std::string& take_over) : file_(folder / lock_file)
{
  std::error_code error;
  const fs::file_status there = fs::symlink_status(file_, error);
  if (fs::exists(there) && !fs::is_regular_file(there))
    throw InputError(fmt::format("{}: is not a file; remove it", file_.string()));
  const Opened opened = open_locked(file_);
  if (opened.descriptor < 0) return;
  const Holder own = this_run(), holder = read_holder(opened.descriptor);
  const std::string name = holder.name();
  const bool going_on = opened.answer == Answer::taken;
  if (!is_left(holder, own, opened.answer) && (going_on || name != take_over)) {
    ::close(opened.descriptor);
    refuse(folder, name, take_over, going_on);
  }
  descriptor_ = opened.descriptor;
  // What a full disk does not take is missing in messages alone.
  const std::string text = own.text();
  static_cast<void>(::ftruncate(descriptor_, 0) != 0 ||
                    ::pwrite(descriptor_, text.data(), text.size(), 0) < 0);
}

FolderLock::~FolderLock()
{
  if (descriptor_ < 0) return;
  // While it is held: whoever has opened it sees that it is gone, and makes a new one.
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace hauberk
