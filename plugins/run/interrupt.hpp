#pragma once
/// Ctrl-C, SIGTERM and a closed terminal: the first asks the computation to stop, the second kills the
/// program.

#include <array>
#include <csignal>

namespace hauberk {

/// Catches SIGINT and SIGTERM from now on, and SIGHUP unless it is ignored (nohup). A file that grows beyond
/// what is allowed and a reader of the progress that went away are errors of writing, not the end: SIGXFSZ
/// and SIGPIPE are ignored.
void catch_interrupts();

/// True after the first of them. Thread safe.
bool interrupted();

/// While there is one, nothing is lost by ending: an interrupt ends the process at once, with exit code 130.
/// One at a time.
class NothingToLose {
 public:
  NothingToLose();
  ~NothingToLose();
  NothingToLose(const NothingToLose&) = delete;
  NothingToLose& operator=(const NothingToLose&) = delete;
};

/// The same for as long as it lives, for programs that outlive a run: at its end signals do what they did
/// before, and nothing is interrupted any more. One at a time: throws InputError where there is another.
class InterruptScope {
 public:
  InterruptScope();
  ~InterruptScope();
  InterruptScope(const InterruptScope&) = delete;
  InterruptScope& operator=(const InterruptScope&) = delete;

 private:
  std::array<struct sigaction, 5> former_{};
};

}  // namespace hauberk
