#include "run/interrupt.hpp"

#include <hauberk/error.hpp>

#include <unistd.h>
#include <atomic>
#include <csignal>

namespace hauberk {
namespace {

// The one piece of global state: a signal handler has no other way to say that it ran, nor to know what it
// may do.
std::atomic<bool> asked{false}, nothing_to_lose{false}, scoped{false};
constexpr int interrupted_code = 130;
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void on_signal(int signal)
{
  if (nothing_to_lose) ::_exit(interrupted_code);
  if (asked.exchange(true)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

void catch_interrupts()
{
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction former = {};
  sigaction(SIGHUP, nullptr, &former);
  if (former.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  struct sigaction ignore = {};
  ignore.sa_handler = SIG_IGN;
  sigemptyset(&ignore.sa_mask);
  sigaction(SIGXFSZ, &ignore, nullptr);
  sigaction(SIGPIPE, &ignore, nullptr);
}

bool interrupted() { return asked.load(); }

NothingToLose::NothingToLose() { nothing_to_lose = true; }
NothingToLose::~NothingToLose() { nothing_to_lose = false; }

namespace {
constexpr std::array<int, 5> caught{SIGINT, SIGTERM, SIGHUP, SIGXFSZ, SIGPIPE};
}

InterruptScope::InterruptScope()
{
  if (scoped.exchange(true))
    throw InputError("another run is going on in this process, and one at a time can be interrupted");
  for (std::size_t k = 0; k < caught.size(); ++k) sigaction(caught[k], nullptr, &former_[k]);
  catch_interrupts();
}

InterruptScope::~InterruptScope()
{
  for (std::size_t k = 0; k < caught.size(); ++k) sigaction(caught[k], &former_[k], nullptr);
  asked = false;
  scoped = false;
}

}  // namespace hauberk
