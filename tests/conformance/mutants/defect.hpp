#pragma once
/// One planted defect, chosen by the section: {"defect": "name"}; "none" is the reference, which conforms.

#include <hauberk/plugin.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <clocale>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <locale>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace hauberk::mutants {

inline void add_defect_field(std::vector<Field>& out)
{
  Field defect;
  defect.name = "defect";
  defect.kind = Field::Kind::string;
  defect.doc = "What is wrong with it.";
  defect.default_json = "\"none\"";
  out.push_back(defect);
}

/// A section without the field, as the reference expects it.
inline Node without_defect(Node section)
{
  std::erase_if(section.members, [](const auto& member) { return member.first == "defect"; });
  return section;
}

inline std::string defect_of(const Node& section) { return section.at("defect").string; }

/// Every defect that plugins of any kind can have.
[[noreturn]] inline void crash()
{
  std::raise(SIGSEGV);
  std::abort();
}

inline void hang()
{
  std::atomic<bool> forever{true};
  while (forever.load()) {
  }
}

// What calls of any kind can do to their process, or the process to them. They are functions of their own,
// and their memory is volatile, so that the compiler takes them as they stand.

/// One double too many.
[[gnu::noinline]] inline void overwrite(std::size_t count)
{
  double* volatile block = new double[count];
  double* volatile next = new double[count];
  for (std::size_t k = 0; k <= count; ++k) static_cast<volatile double*>(block)[k] = 1.0;
  delete[] block;
  delete[] next;
}

[[gnu::noinline]] inline double freed(double value)
{
  double* volatile block = new double[3]{value, value, value};
  const volatile double* stale = block;
  delete[] block;
  return stale[0];
}

[[gnu::noinline]] inline double unset()
{
  constexpr std::size_t large = 5000;  // so that it comes from no list of small blocks
  double* volatile block = new double[large];
  const double value = static_cast<volatile double*>(block)[large / 2];
  delete[] block;
  return value;
}

inline void wait(double seconds)
{
  using Clock = std::chrono::steady_clock;
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  while (Clock::now() < end) {
  }
}

/// Leaves the process otherwise than it was.
inline void disturb(const std::string& defect)
{
  if (defect == "directory" && chdir("/") != 0) std::abort();
  if (defect == "locale") std::setlocale(LC_ALL, "C.UTF-8");
  if (defect == "cpp_locale")
    std::locale::global(std::locale(std::locale::classic(), new std::numpunct<char>));
  if (defect == "precision") std::cout.precision(3);
  if (defect == "hexadecimal") std::cerr << std::hex;
  if (defect == "deaf_stream") std::clog.rdbuf(nullptr);
  if (defect == "prints") std::printf("so far so good\n");
  if (defect == "prints_errors") std::cerr << "hm\n";
  if (defect == "environment") setenv("HAUBERK_TEST_MUTANT", "1", 1);
  if (defect == "signals") std::signal(SIGUSR1, SIG_IGN);
  if (defect == "file_mask") umask(077);
  if (defect == "descriptors") static_cast<void>(open("/dev/null", O_RDONLY));
  if (defect == "crash") crash();
  if (defect == "hang") hang();
  if (defect == "exits") std::exit(0);
  if (defect == "throws_int") throw 42;
  if (defect == "sleeps") std::this_thread::sleep_for(std::chrono::milliseconds(200));
  if (defect == "traps") feenableexcept(FE_DIVBYZERO);
}

/// Something that an answer must not depend on; 0 of other defects, and of the reference.
inline double whim(const std::string& defect, const void* self, double argument)
{
  static double last = 0.0;
  static long calls = 0;
  disturb(defect);
  if (defect == "heap_overwrite") overwrite(3);
  if (defect == "heap_overwrite_in_slack") overwrite(4);
  if (defect == "rand") return 1e-9 * (std::rand() % 100);
  if (defect == "process_id") return 1e-9 * (getpid() % 1000);
  if (defect == "address")
    return 1e-9 * static_cast<double>(reinterpret_cast<std::uintptr_t>(self) / 16 % 1000);
  if (defect == "code_address")
    return 1e-9 * static_cast<double>(reinterpret_cast<std::uintptr_t>(&crash) / 4096 % 1000);
  if (defect == "clock")
    return 1e-12 * static_cast<double>(std::chrono::steady_clock::now().time_since_epoch().count() % 1000);
  if (defect == "next_year") return std::time(nullptr) > 4102444800 ? 1e-3 : 0.0;
  if (defect == "remembers_the_last") return 1e-9 * std::exchange(last, argument);
  if (defect == "tires") return ++calls > 40 ? 1e-9 : 0.0;
  if (defect == "use_after_free") return freed(argument) - argument;
  if (defect == "not_initialised") return 1e-9 * unset();
  return 0.0;
}

}  // namespace hauberk::mutants
