/// Loaded before everything else: a wall clock that goes back by an hour whenever it is asked.

#include <dlfcn.h>
#include <sys/time.h>
#include <atomic>
#include <ctime>

namespace {

constexpr long hour = 3600;
std::atomic<long> asked{0};

long back() { return hour * ++asked; }

template <class Function>
Function* real(const char* name)
{
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept
{
  const int answer = real<int(clockid_t, timespec*)>("clock_gettime")(clock, time);
  if (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE) time->tv_sec -= back();
  return answer;
}

extern "C" int gettimeofday(timeval* time, void* zone) noexcept
{
  const int answer = real<int(timeval*, void*)>("gettimeofday")(time, zone);
  time->tv_sec -= back();
  return answer;
}

extern "C" time_t time(time_t* out) noexcept
{
  const time_t now = real<time_t(time_t*)>("time")(nullptr) - back();
  if (out != nullptr) *out = now;
  return now;
}
