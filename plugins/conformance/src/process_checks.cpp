/// What a plugin does to the process that it runs in, what that process does to its answers, and how long
/// they take.

#include "checks.hpp"
#include "trace.hpp"

#include <hauberk/conformance/known_problems.hpp>
#include <hauberk/error.hpp>
#include <hauberk/host/child.hpp>
#include <hauberk/host/plugin_library.hpp>
#include <hauberk/host/process_state.hpp>

#include <dlfcn.h>
#include <fcntl.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>

namespace hauberk::conformance {
namespace {

namespace fs = std::filesystem;

// ----- the same answers in two processes -----

std::string bytes_of(const std::vector<double>& numbers)
{
  std::string out(numbers.size() * sizeof(double), '\0');
  if (!numbers.empty()) std::memcpy(out.data(), numbers.data(), out.size());
  return 'n' + out;  // no answers are an answer, too
}

std::vector<double> numbers_of(const std::string& bytes)
{
  std::vector<double> out((bytes.size() - 1) / sizeof(double));
  if (!out.empty()) std::memcpy(out.data(), bytes.data() + 1, out.size() * sizeof(double));
  return out;
}

/// A folder that is removed with what it holds.
class Scratch {
 public:
  Scratch()
  {
    std::string name = (fs::temp_directory_path() / "hauberk-XXXXXX").native();
    require(::mkdtemp(name.data()) != nullptr, "no temporary folder can be made: {}",
            std::generic_category().message(errno));
    path_ = name;
  }
  ~Scratch()
  {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Everything that an object of this table answers. Memory that is not set has `filled` in it where the C
/// library can see to that.
std::string answers(const PluginTable& table, const Section& section, std::uint64_t seed, int filled = 0x55)
{
#if defined(M_PERTURB)
  ::mallopt(M_PERTURB, filled);
#else
  static_cast<void>(filled);
#endif
  Trial trial(table, section, seed);
  const Object object = trial.make();
  return bytes_of(Exercise(object, trial)(object));
}

/// The same of a copy of the library, which lies elsewhere in memory, between other blocks of the heap.
std::string answers_elsewhere(const PluginTable& at_hand, const fs::path& copy, const Section& section,
                              std::uint64_t seed)
{
  constexpr std::size_t apart = 37 << 20, blocks = 200;
  static_cast<void>(::mmap(nullptr, apart, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  std::vector<std::unique_ptr<char[]>> heap;
  for (std::size_t k = 0; k < blocks; ++k) heap.push_back(std::make_unique<char[]>(16 + 41 * (k % 29)));
  for (std::size_t k = 0; k < blocks; k += 3) heap[k].reset();
  const PluginTable* table = &at_hand;
  try {
    table = &PluginLibrary::load(copy).table(at_hand.id);
  } catch (
      const PluginError&) {  // nothing may be run from the temporary folder: the heap differs all the same
  }
  return answers(*table, section, seed, 0xaa);
}

bool is_in(const PluginTable& table, const fs::path& file)
{
  try {
    const PluginLibrary library = PluginLibrary::load(file);
    return std::ranges::find(library.tables(), &table) != library.tables().end();
  } catch (const PluginError&) {
    return false;  // the table is a copy in another program, such as a test
  }
}

/// The library that a table is in.
fs::path library_of(const PluginTable& table)
{
  Dl_info info{};
  const bool found = ::dladdr(&table, &info) != 0 && info.dli_fname != nullptr;
  const fs::path file = found ? info.dli_fname : "";
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored) || !is_in(table, file)) skip("its library is not known");
  return file;
}

void processes(Trial& trial)
{
  constexpr double seconds = 300.0;  // what calls this has its own limit
  const Scratch scratch;
  const fs::path file = library_of(trial.table), copy = scratch.path() / file.filename();
  static_cast<void>(trial.make());  // a section that is refused is no matter of processes
  fs::copy_file(file, copy);
  const std::uint64_t seed = 1 + static_cast<std::uint64_t>(trial.random.between(0.0, 1e9));
  const auto answer_of = [&](const std::function<std::string()>& f) {
    const Child child = in_child(f, seconds);
    require(child.returned, "asked in a process of its own it {}", child.ending);
    return numbers_of(child.text);
  };
  const std::vector<double> one = answer_of([&] { return answers(trial.table, trial.section, seed); });
  const std::vector<double> other =
      answer_of([&] { return answers_elsewhere(trial.table, copy, trial.section, seed); });
  require(same_bits(one, other), "in another process, at other addresses, it answers otherwise: {}",
          first_difference(one, other));
}

// ----- the process is left as it was -----

/// What is printed between construction and `text`, to the descriptors 1 and 2, goes to a file without a
/// name.
class Captured {
 public:
  Captured() : file_(::memfd_create("hauberk", MFD_CLOEXEC))
  {
    flush();
    for (const int k : {0, 1}) {
      kept_[k] = ::fcntl(k + 1, F_DUPFD_CLOEXEC, 3);
      if (file_ >= 0) ::dup2(file_, k + 1);
    }
  }
  ~Captured() { static_cast<void>(text()); }
  Captured(const Captured&) = delete;
  Captured& operator=(const Captured&) = delete;

  /// What was printed, at most its first 80 bytes.
  std::string text()
  {
    put_back();
    std::string out(80, '\0');
    const ssize_t n = file_ < 0 ? 0 : ::pread(file_, out.data(), out.size(), 0);
    out.resize(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
    if (file_ >= 0) ::close(std::exchange(file_, -1));
    return out.substr(0, out.find('\n'));
  }

 private:
  static void flush()
  {
    std::cout.flush();
    std::clog.flush();
    std::fflush(nullptr);
  }
  void put_back()
  {
    flush();
    for (const int k : {0, 1}) {
      if (kept_[k] < 0) continue;
      ::dup2(kept_[k], k + 1);
      ::close(std::exchange(kept_[k], -1));
    }
  }

  int file_;
  int kept_[2] = {-1, -1};
};

/// What else belongs to the process.
struct Surroundings {
  std::vector<std::string> environment;
  std::vector<void (*)(int)> handlers;  ///< of signals
  mode_t mask;                          ///< of new files
  std::size_t descriptors = 0;          ///< open files

  Surroundings() : mask(::umask(0))
  {
    ::umask(mask);
    for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable)
      environment.emplace_back(*variable);
    for (int k = 1; k < 32; ++k) {
      struct sigaction action {};
      handlers.push_back(::sigaction(k, nullptr, &action) == 0 ? action.sa_handler : SIG_DFL);
    }
    std::error_code error;
    for (fs::directory_iterator it("/proc/self/fd", error), end; !error && it != end; it.increment(error))
      ++descriptors;
  }

  /// In words, empty: nothing.
  std::string changes(const Surroundings& after) const
  {
    if (after.environment != environment) return "the environment";
    if (after.handlers != handlers) return "what signals do";
    if (after.mask != mask) return "the mask of new files";
    if (after.descriptors > descriptors) return "how many files are open";
    return {};
  }
};

void surroundings(Trial& trial)
{
  const ProcessState state;
  const Surroundings before;
  Captured captured;
  {
    const Object object = trial.make();
    const Exercise exercise(object, trial);
    const int rounds = object.optimizer ? 1 : 2;  // a run of one is many calls
    for (int k = 0; k < rounds; ++k) static_cast<void>(exercise(object));
  }
  const std::string changed = state.restore();  // of calls that the guard does not look after
  const std::string printed = captured.text();
  require(changed.empty(), "its calls changed the state of the process ({})", changed);
  require(printed.empty(), "it prints; what it wants to say it throws or reports: '{}'", printed);
  const std::string other = before.changes(Surroundings());
  require(other.empty(), "its calls changed {}", other);
}

// ----- time of a call -----

using Clock = std::chrono::steady_clock;

/// The least time of a call among many: what else the machine does only adds, as does what a first call
/// loads.
template <class F>
double least_seconds(F&& f)
{
  constexpr int fewest = 3, most = 200;
  constexpr double enough = 0.01, most_of_few = 1.0;  // seconds, of all calls
  double least = std::numeric_limits<double>::infinity(), total = 0.0;
  for (int k = 0; k < most && total < (k < fewest ? most_of_few : enough); ++k) {
    const auto start = Clock::now();
    f();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    least = std::min(least, seconds);
    total += seconds;
  }
  return least;
}

/// Longest times. A limit takes some 1e6 positions, a design some 1e3 sets of primitives.
constexpr double longest_position = 1e-4, longest_other = 1e-2, longest_primitives = 0.1;
/// Of an optimizer with a problem of two variables, for each of its evaluations.
constexpr double longest_evaluation = 1e-2;

using Times = std::vector<std::pair<std::string, double>>;

/// A name, a call, and how long it may take.
void time_call(Times& times, const char* name, double longest, const std::function<void()>& call)
{
  times.emplace_back(name, least_seconds(call));
  if (times.back().second > longest)
    throw Slow(fmt::format("'{}' takes {:.3g} s, and may take {:.3g} s", name, times.back().second, longest));
}

void time_shape(const Shape& shape, Trial& trial, Times& times)
{
  std::vector<double> p;
  for (const ParameterInfo& info : shape.parameters()) {
    const Node* given = trial.section.parameters.find(info.name);
    p.push_back(given != nullptr ? given->number : info.default_value);
  }
  const bool known = std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); });
  if (!known || refused(shape, p, trial)) p = draw_point(shape, trial).p;
  time_call(times, "primitives", longest_primitives, [&] { static_cast<void>(shape.primitives(p)); });
  time_call(times, "jacobians", longest_primitives, [&] { static_cast<void>(shape.jacobians(p)); });
}

void time_load_case(const LoadCase& load_case, Trial& trial, Times& times)
{
  const std::vector<double> macro = draw_macro(load_case, trial.random, 0.3),
                            e(static_cast<std::size_t>(load_case.coordinate_count()), 0.1);
  const Vec3 X = trial.random.vector(2.0), T = draw_translation(load_case, trial.random);
  const Direction direction = Direction::at_radians(0.3);
  PositionMap map;
  std::vector<double> load(macro.size());
  time_call(times, "position", longest_position, [&] { load_case.position(macro, e, X, T, map); });
  time_call(times, "acceleration_bound", longest_position,
            [&] { load_case.acceleration_bound(macro, macro, e, e, X, T); });
  time_call(times, "admissible", longest_position, [&] { static_cast<void>(load_case.admissible(macro)); });
  time_call(times, "stretch_range", longest_other,
            [&] { static_cast<void>(load_case.stretch_range(macro)); });
  time_call(times, "load", longest_other, [&] { load_case.load(direction, load); });
  time_call(times, "value", longest_other, [&] { static_cast<void>(load_case.value(direction, macro)); });
}

void time_optimizer(const Optimizer& optimizer, Times& times)
{
  std::size_t evaluations = 1;
  const double seconds = least_seconds([&] {
    KnownProblem k = known_problem("rosenbrock_bound");
    Recorder recorder;
    static_cast<void>(optimizer.minimize(k.problem, k.start, recorder));
    evaluations = std::max<std::size_t>(1, k.problem.evaluated.size());
  });
  times.emplace_back("minimize, for each evaluation", seconds / static_cast<double>(evaluations));
  if (times.back().second > longest_evaluation)
    throw Slow(
        fmt::format("'minimize' takes {:.3g} s for each evaluation of a problem with two variables, and may "
                    "take {:.3g} s",
                    times.back().second, longest_evaluation));
}

Check speed()
{
  return {"speed", std::nullopt, "a call takes no longer than computations with many of them can bear",
          [](const PluginTable& table, const Setup& setup, std::uint64_t seed) {
            Trial trial(table, read_section(table, setup), seed);
            const Object object = trial.make();
            Outcome outcome;
            if (object.shape) time_shape(*object.shape, trial, outcome.times);
            if (object.load_case) time_load_case(*object.load_case, trial, outcome.times);
            if (object.optimizer) time_optimizer(*object.optimizer, outcome.times);
            return outcome;
          }};
}

}  // namespace

void add_process_checks(std::vector<Check>& out)
{
  out.push_back(of_trial("processes", std::nullopt,
                         "another process, with other addresses, gets the same answers, to the bit",
                         processes));
  out.push_back(
      of_trial("surroundings", std::nullopt,
               "directory, locale, streams, environment, signals and open files are left alone, and "
               "nothing is printed",
               surroundings));
}

void add_speed_check(std::vector<Check>& out) { out.push_back(speed()); }

}  // namespace hauberk::conformance
