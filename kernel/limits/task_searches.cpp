#include "limits/task_searches.hpp"

#include "numerics/parallel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace hauberk {
TaskSearches::TaskSearches(const Model& model, const SceneSpec& spec, const std::vector<LimitTask>& asked,
                           const LimitSettings& settings, const LimitsObserver& observer)
    : model_(model), spec_(spec), asked_(asked.size()), settings_(settings), observer_(observer)
{
  for (const RestSearches& searches : rest_searches(model, asked, settings)) {
    tasks_.push_back(searches.task);
    TaskState& state = states_.emplace_back();
    state.narrow = searches.narrow;
    state.random_loads = searches.random_loads;
    state.further_starts = searches.further_starts;
    state.refolds = searches.refolds;
    state.sparing_from = searches.sparing_from;
    state.starts.resize(searches.starts);
    state.missing = searches.starts;
  }
}

/// Of searches in company of taut limits: what the most expensive of those may have. Searches those from
/// rest that are not there and are not sparing.
void TaskSearches::find_allowance(unsigned threads)
{
  std::vector<std::size_t> taut;
  for (std::size_t k = 0; k < asked_; ++k)
    if (is_taut(model_, tasks_[k])) taut.push_back(k);
  find_starts(taut, false, threads);
  for (const std::size_t k : taut) allowance_ = std::max(allowance_, allowance_of(k));
}

/// Searches from rest, for tasks that no other thread works on, what is not there: starts that are sparing,
/// or the others.
void TaskSearches::find_starts(const std::vector<std::size_t>& tasks, bool sparing, unsigned threads)
{
  std::vector<std::pair<std::size_t, std::size_t>> missing;
  for (const std::size_t k : tasks)
    for (std::size_t s = 0; s < states_[k].starts.size(); ++s)
      if (states_[k].is_sparing(s) == sparing && !states_[k].starts[s].locked) missing.emplace_back(k, s);
  parallel_for(missing.size(), threads, [&](std::size_t i) {
    const auto& [k, start] = missing[i];
    states_[k].starts[start] = attempt(k, start);
  });
}

/// Threads that have no item of their own help with the pairs of large scenes.
void TaskSearches::share_out(unsigned threads, std::size_t items)
{
  settings_.schedule.threads =
      static_cast<unsigned>(std::max<std::size_t>(1, threads / std::max<std::size_t>(1, items)));
}

/// What a search may have that begins again for a taut task.
long TaskSearches::allowance_of(std::size_t task) const
{
  long most = 0;
  const TaskState& t = states_[task];
  for (std::size_t s = 0; s < t.starts.size() && !t.is_sparing(s); ++s)
    if (t.starts[s].locked) most = std::max(most, t.starts[s].locked->evaluations);
  return allowance(most);
}

/// The settings of searches that may have so many evaluations.
LimitSettings TaskSearches::within(long evaluations) const
{
  LimitSettings settings = settings_;
  settings.schedule.most_evaluations = evaluations;
  return settings;
}

/// The settings of a start. A limit that is not reported has few stages: a lesson widens all gaps again.
LimitSettings TaskSearches::settings_of(std::size_t task, std::size_t start) const
{
  LimitSettings settings = settings_;
  if (states_[task].is_sparing(start)) settings = within(task < asked_ ? allowance_of(task) : allowance_);
  if (task >= asked_) settings.schedule.last = std::max(settings.schedule.last, last_of_unreported);
  return settings;
}

/// What the search of this name finds, or is remembered to have found. `seconds` grows by what it took.
template <class Search>
Locked TaskSearches::searched(const std::string& name, double& seconds, const Search& search) const
{
  SearchMemory* const memory = observer_.memory;
  if (memory != nullptr) {
    if (std::optional<KnownSearch> known = memory->recall(name); known && fits(model_, known->locked)) {
      seconds += known->seconds;
      return std::move(known->locked);
    }
  }
  const auto t0 = std::chrono::steady_clock::now();
  const auto taken = [&t0] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
  };
  Locked found;
  try {
    found = search();
  } catch (...) {
    seconds += taken();
    throw;
  }
  const double took = taken();
  seconds += took;
  if (memory != nullptr && found.status != LockStatus::interrupted) memory->record(name, found, took);
  return found;
}

Locked TaskSearches::from_rest(std::size_t task, std::size_t start) const
{
  const KeepGoing keep_going = [this] { return going(); };
  const LimitSettings settings = settings_of(task, start);
  const int number = static_cast<int>(start);
  if (states_[task].is_under_random_load(start))
    return limit_from_random_load(model_, tasks_[task], settings, number, keep_going);
  if (!states_[task].is_narrow(start))
    return limit_from_start(model_, tasks_[task], settings, number, keep_going);
  const State from =
      perturbed(model_, start_state(model_, settings), settings.perturbation, settings.seed, Copies::alike);
  return limit_from_state(model_, tasks_[task], settings, from, keep_going);
}

Attempt TaskSearches::attempt(std::size_t task, std::size_t start) const
{
  Attempt out;
  try {
    const TaskState& t = states_[task];
    const std::string name = t.is_narrow(start)              ? "narrow"
                             : t.is_under_random_load(start) ? fmt::format("random load {}", start)
                                                             : fmt::format("start {}", start);
    out.locked =
        searched(fmt::format("limit {} {}", task, name), out.seconds, [&] { return from_rest(task, start); });
  } catch (const std::exception& error) {
    out.error = error.what();
  }
  if (out.locked && out.locked->status == LockStatus::interrupted) out.locked.reset();
  return out;
}

/// Where a task locks under the k-th of its tilted loads.
Locked TaskSearches::tilted_search(std::size_t task, int k, double& seconds) const
{
  return searched(fmt::format("limit {} tilt {}", task, k), seconds, [&] {
    return locked_under_tilted_load(model_, tasks_[task], settings_,
                                    settings_.seed + static_cast<std::uint64_t>(k),
                                    [this] { return going(); });
  });
}

/// `allowed`: evaluations that it may have; null: as many as it takes.
Locked TaskSearches::search_from_state(std::size_t task, const State& from, double& seconds,
                                       std::optional<long> allowed) const
{
  std::string name = fmt::format("limit {} from {}", task, name_of_state(from));
  if (allowed) name += fmt::format(" within {}", *allowed);
  return searched(name, seconds, [&] {
    return limit_from_state(model_, tasks_[task], allowed ? within(*allowed) : settings_, from,
                            [this] { return going(); });
  });
}

/// The first start of a task went past every bound, with a witness: others would say no more.
bool TaskSearches::runs_away(std::size_t task) const
{
  const std::optional<Locked>& first = states_[task].starts.front().locked;
  return first && first->status == LockStatus::unbounded && !first->path.empty();
}

/// Locks a task under tilted loads too, and again from where one of them is further than all that is known.
/// False: interrupted.
bool TaskSearches::tilt(std::size_t task)
{
  if (task >= asked_ || settings_.tilts == 0) return true;
  TaskState& t = states_[task];
  const LimitTask& limit = tasks_[task];
  const MacroLoad load = macro_load(model_, limit.direction, limit.sense);
  try {
    for (int k = 0; k < settings_.tilts; ++k) {
      const std::uint64_t seed = settings_.seed + static_cast<std::uint64_t>(k);
      const Locked found = tilted_search(task, k, t.seconds);
      if (found.status == LockStatus::interrupted) return false;
      const std::vector<FoundState> known = found_of(task);
      const std::optional<std::size_t> best = furthest(model_, limit, settings_, known);
      if (found.status != LockStatus::locked ||
          (load.held.cols() == 0 && best &&
           reached(model_, limit, found.state) <
               reached(model_, limit, known[*best].locked.state) + further_than(settings_))) {
        t.iterations += found.iterations;
        t.evaluations += found.evaluations;
        continue;
      }
      Locked own = search_from_state(task, found.state, t.seconds);
      if (own.status == LockStatus::interrupted) return false;
      own.iterations += found.iterations;
      own.evaluations += found.evaluations;
      t.further.push_back({std::move(own), "tilt", seed});
    }
  } catch (const std::exception& error) {
    t.error = error.what();
  }
  return true;
}

std::vector<FoundState> TaskSearches::found_of(std::size_t task) const
{
  std::vector<FoundState> found;
  const TaskState& t = states_[task];
  for (std::size_t s = 0; s < t.starts.size(); ++s) {
    if (!t.starts[s].locked) continue;
    if (s > 0 && runs_away(task)) break;  // whatever the order in which starts were done
    if (t.is_narrow(s)) {
      found.push_back({*t.starts[s].locked, "start, narrow", settings_.seed});
    } else {
      found.push_back(
          {*t.starts[s].locked, t.is_under_random_load(s) ? "random load" : "start", settings_.seed + s});
    }
  }
  found.insert(found.end(), t.further.begin(), t.further.end());
  return found;
}

/// Out of what there is. Only called when no other thread works on this task.
LimitResult TaskSearches::result_of(std::size_t task, const KeepGoing& keep_going) const
{
  const TaskState& t = states_[task];
  double seconds = t.seconds;
  std::string error = t.error;
  for (const Attempt& a : t.starts) {
    if (error.empty()) error = a.error;
    seconds += a.seconds;
  }
  LimitResult result = limit_header(model_, tasks_[task]);
  const std::vector<FoundState> found = found_of(task);
  try {
    if (!found.empty()) result = summarize(model_, spec_, tasks_[task], settings_, found, keep_going);
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  result.seconds = seconds;
  result.iterations += t.iterations;
  result.evaluations += t.evaluations;
  if (!error.empty()) {
    result.status = LimitStatus::failed;
    result.message = error;
  } else if (!t.remark.empty()) {
    result.message += (result.message.empty() ? "" : "; ") + t.remark;
  }
  return result;
}

/// What a search of a task finds, given where to add its seconds; null: it threw, which the task remarks,
/// with `where`.
template <class Search>
std::optional<FoundState> TaskSearches::guarded(std::size_t task, const std::string& where,
                                                const Search& search)
{
  std::optional<FoundState> out;
  std::string problem;
  double seconds = 0.0;
  try {
    out = search(seconds);
  } catch (const std::exception& failure) {
    problem = fmt::format("{}: {}", where, failure.what());
  }
  const std::lock_guard lock(begun_again_);  // a task may have several at a time
  if (!problem.empty()) states_[task].remark = std::move(problem);
  states_[task].seconds += seconds;
  return out;
}

/// Locked state of a task from a state that `place` names; null: it threw, which the task remarks, and what
/// was known before stands.
std::optional<FoundState> TaskSearches::begun_from(std::size_t task, const State& from,
                                                   const std::string& place, std::uint64_t seed,
                                                   std::optional<long> allowed)
{
  return guarded(task, fmt::format("from the state of {}", place), [&](double& seconds) {
    return FoundState{search_from_state(task, from, seconds, allowed), learnt_origin + place, seed};
  });
}

void TaskSearches::enter(std::size_t task, std::size_t start, const Attempt& found)
{
  TaskState& t = states_[task];
  t.seconds += found.seconds;
  if (!found.error.empty()) t.error = found.error;
  if (found.locked) t.further.push_back({*found.locked, "start", settings_.seed + start});
}

bool TaskSearches::enter_if_further(std::size_t task, FoundState found, double than)
{
  TaskState& t = states_[task];
  const Locked& l = found.locked;
  if (l.status == LockStatus::locked &&
      reached(model_, tasks_[task], l.state) > than + further_than(settings_)) {
    t.further.push_back(std::move(found));
    return true;
  }
  t.iterations += l.iterations;
  t.evaluations += l.evaluations;
  return false;
}

std::optional<FoundState> TaskSearches::from_tilted_load(std::size_t task, double degrees, std::size_t number)
{
  LimitSettings settings = within(allowance_of(task));
  settings.tilt = degrees;
  const std::uint64_t seed = settings_.seed + number;
  const std::string name = fmt::format("limit {} load {} tilted by {}", task, seed, degrees);
  return guarded(task, "under a tilted load", [&](double& seconds) {
    const auto search = [&] {
      return limit_from_tilted_load(model_, tasks_[task], settings, seed, [this] { return going(); });
    };
    return FoundState{searched(name, seconds, search), fmt::format("tilt of {} degrees", degrees), seed};
  });
}

bool TaskSearches::gave_up_further(std::size_t task, const FoundState& found) const
{
  if (found.locked.status != LockStatus::stalled) return false;
  const std::optional<FoundState> best = furthest_of(task);
  return best && reached(model_, tasks_[task], found.locked.state) >
                     reached(model_, tasks_[task], best->locked.state) + further_than(settings_);
}

std::optional<FoundState> TaskSearches::refolded(std::size_t task, const State& furthest, std::size_t number)
{
  const std::uint64_t seed = settings_.seed + number;
  const std::string name =
      fmt::format("limit {} random load {} from {}", task, seed, name_of_state(furthest));
  return guarded(task, "under a random load", [&](double& seconds) {
    const auto search = [&] {
      return limit_refolded(model_, tasks_[task], settings_, furthest, seed, [this] { return going(); });
    };
    return FoundState{searched(name, seconds, search), "random load", seed};
  });
}

/// Solves again those of the tasks whose results came with the call.
void TaskSearches::find_states(const std::vector<std::size_t>& needed, unsigned threads)
{
  std::vector<std::size_t> unknown;
  for (const std::size_t k : needed) {
    if (states_[k].known && std::find(unknown.begin(), unknown.end(), k) == unknown.end())
      unknown.push_back(k);
  }
  for (const bool sparing : {false, true}) find_starts(unknown, sparing, threads);
  parallel_for(unknown.size(), threads, [&](std::size_t i) { tilt(unknown[i]); });
  for (const std::size_t k : unknown) states_[k].known = false;
}

/// Of a search from a state: for a taut task its allowance, unless the state is further than its own.
std::optional<long> TaskSearches::allowance_from(std::size_t task, const State& from) const
{
  if (!is_taut(model_, tasks_[task])) return std::nullopt;
  const std::optional<FoundState> best = furthest_of(task);
  const bool further =
      best && reached(model_, tasks_[task], from) >
                  reached(model_, tasks_[task], best->locked.state) + further_than(settings_);
  return further ? std::nullopt : std::optional(allowance_of(task));
}

std::optional<FoundState> TaskSearches::furthest_of(std::size_t task) const
{
  std::vector<FoundState> found = found_of(task);
  const auto best = furthest(model_, tasks_[task], settings_, found);
  if (!best) return std::nullopt;
  return std::move(found[*best]);
}

}  // namespace hauberk
