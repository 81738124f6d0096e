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
#include <csignal>
#include <cstring>
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

/// Reads both pipes until they end or time is over; returns whether they ended.
bool read_until(Clock::time_point end, int result, std::string& text, int output, std::string& printed)
{
  std::array<pollfd, 2> waiting{pollfd{result, POLLIN, 0}, pollfd{output, POLLIN, 0}};
  std::array<std::string*, 2> into{&text, &printed};
  while (waiting[0].fd >= 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) return false;
    const int ready = ::poll(waiting.data(), waiting.size(), static_cast<int>(std::min<long>(left, 1000)));
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
  Pipe result, output;
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0) cannot("fork");
  if (pid == 0) be_child(f, result.write_end(), output.write_end(), parent);
  result.close(1);
  output.close(1);
  ::setpgid(pid, pid);  // whoever comes first
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  Child child;
  std::string printed;
  const bool in_time = read_until(end, result.read_end(), child.text, output.read_end(), printed);
  if (!in_time) ::kill(-pid, SIGKILL);
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  ::kill(-pid, SIGKILL);  // what it started and left
  child.returned = in_time && WIFEXITED(status) && WEXITSTATUS(status) == 0 && !child.text.empty();
  if (!in_time) {
    child.ending = fmt::format("did not return within {} s", seconds);
  } else if (!child.returned) {
    child.ending = ending_of(status, printed);
  }
  return child;
}

}  // namespace hauberk
