#include <hauberk/error.hpp>
#include <hauberk/host/child.hpp>

#include <fmt/format.h>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <ctime>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace hauberk {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void cannot(const char* what)
{
  throw ComputationError(fmt::format("a child process cannot be made: {} failed: {}", what,
                                     std::generic_category().message(errno)));
}

/// Both ends of a pipe, closed on every way out.
class Pipe {
 public:
  Pipe()
  {
    if (::pipe(ends_.data()) != 0) cannot("pipe");
  }
  ~Pipe()
  {
    for (const int end : {0, 1}) close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void close(int end)
  {
    int& fd = ends_[end];
    if (fd >= 0) ::close(std::exchange(fd, -1));
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

void write_all(int fd, std::string_view text)
{
  while (!text.empty()) {
    const ssize_t n = ::write(fd, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

/// The child's side: never returns. An exception that leaves `f` prints its text and aborts the child. The
/// headers of the C library say that dlopen does not throw, so whether one of a static constructor gets this
/// far, or ends the child below, is the compiler's choice; it is the same to the parent.
[[noreturn]] void be_child(const std::function<std::string()>& f, int result, int output,
                           pid_t parent) noexcept
{
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it died before it was asked for
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  write_all(result, f());
  ::_exit(0);  // no destructor of the parent's objects may run here
}

/// Processor time of another process and of its threads, seconds; 0 where the system does not tell.
double processor_seconds(pid_t pid)
{
  clockid_t clock{};
  timespec used{};
  if (::clock_getcpuclockid(pid, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return 0.0;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

/// The time of a child.
class Watch {
 public:
  Watch(pid_t pid, const TimeLimits& limits) : pid_(pid), limits_(limits) {}

  /// Milliseconds until it must be looked at again; null: its time is over.
  std::optional<int> wait()
  {
    constexpr double longest = 1.0, shortest = 0.001;
    const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
    used_ = std::max(used_, processor_seconds(pid_));
    // Several threads may use it up faster than it passes.
    const double left = std::min(limits_.elapsed - elapsed, 0.25 * (limits_.processor - used_) + shortest);
    over_processor_ = used_ >= limits_.processor;
    if (over_processor_ || elapsed >= limits_.elapsed) return std::nullopt;
    return static_cast<int>(std::ceil(1e3 * std::clamp(left, shortest, longest)));
  }
  double used() const { return used_; }
  std::string ending() const
  {
    return over_processor_ ? fmt::format("did not return within {} s of processor time", limits_.processor)
                           : fmt::format("did not return within {} s", limits_.elapsed);
  }

 private:
  pid_t pid_;
  TimeLimits limits_;
  Clock::time_point start_ = Clock::now();
  double used_ = 0.0;
  bool over_processor_ = false;
};

/// Reads both pipes until they end or time is over; returns whether they ended.
bool read_until(Watch& watch, int result, std::string& text, int output, std::string& printed)
{
  std::array<pollfd, 2> waiting{pollfd{result, POLLIN, 0}, pollfd{output, POLLIN, 0}};
  std::array<std::string*, 2> into{&text, &printed};
  while (waiting[0].fd >= 0) {
    const std::optional<int> wait = watch.wait();
    if (!wait) return false;
    const int ready = ::poll(waiting.data(), waiting.size(), *wait);
    if (ready < 0 && errno != EINTR) cannot("poll");
    if (ready <= 0) continue;
    for (std::size_t k = 0; k < waiting.size(); ++k) {
      if (waiting[k].revents == 0) continue;
      std::array<char, 4096> buffer;
      const ssize_t n = ::read(waiting[k].fd, buffer.data(), buffer.size());
      if (n > 0) into[k]->append(buffer.data(), static_cast<std::size_t>(n));
      if (n == 0) waiting[k].fd = -1;  // poll passes over it
      constexpr std::size_t kept = 20000;
      if (k == 1 && printed.size() > 2 * kept) printed.erase(0, printed.size() - kept);
    }
  }
  return true;
}

std::string last_line(std::string text)
{
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  const std::size_t from = text.rfind('\n');
  return from == std::string::npos ? text : text.substr(from + 1);
}

std::string ending_of(int status, const std::string& printed)
{
  std::string text =
      WIFSIGNALED(status)
          ? fmt::format("ended by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)))
          : fmt::format("ended the process with exit code {}", WEXITSTATUS(status));
  const std::string last = last_line(printed);
  return last.empty() ? text : text + "; it last printed: " + last;
}

}  // namespace

Child in_child(const std::function<std::string()>& f, double seconds)
{
  return in_child(f, TimeLimits{.elapsed = seconds});
}

Child in_child(const std::function<std::string()>& f, const TimeLimits& limits)
{
  Pipe result, output;
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0) cannot("fork");
  if (pid == 0) be_child(f, result.write_end(), output.write_end(), parent);
  result.close(1);
  output.close(1);
  ::setpgid(pid, pid);  // whoever comes first
  Watch watch(pid, limits);
  Child child;
  std::string printed;
  const bool in_time = read_until(watch, result.read_end(), child.text, output.read_end(), printed);
  static_cast<void>(watch.wait());
  child.processor_seconds = watch.used();
  child.out_of_time = !in_time;
  if (!in_time) ::kill(-pid, SIGKILL);
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  ::kill(-pid, SIGKILL);  // what it started and left
  child.returned = in_time && WIFEXITED(status) && WEXITSTATUS(status) == 0 && !child.text.empty();
  if (!in_time) {
    child.ending = watch.ending();
  } else if (!child.returned) {
    child.ending = ending_of(status, printed);
  }
  return child;
}

}  // namespace hauberk
