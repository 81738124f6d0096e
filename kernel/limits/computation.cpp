#include "limits/confidence.hpp"
#include "limits/donors.hpp"
#include "limits/limit_report.hpp"
#include "limits/rest_searches.hpp"
#include "limits/scenes_within.hpp"
#include "numerics/parallel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <mutex>

namespace hauberk {
namespace {

/// Activation distance (L) of the last stage of limits that are not reported.
constexpr double last_in_company = 1e-3;

/// One start of one task.
struct Attempt {
  std::optional<Locked> locked;  ///< null: not begun, interrupted, or it threw
  std::string error;
  double seconds = 0.0;
  bool needless = false;  ///< the first start has shown that nothing stops the load
};

/// What is known of a task.
struct TaskState {
  std::vector<Attempt> starts;
  std::vector<FoundState> further;  ///< by tilts, and from other limits
  std::string error;                ///< of those
  std::string remark;               ///< a lesson that threw
  double seconds = 0.0;             ///< of those, and of what led nowhere
  int iterations = 0;               ///< of what led nowhere
  long evaluations = 0;             ///< the same
  std::size_t missing = 0;          ///< starts not done
  std::size_t sparing_from = 0;     ///< RestSearches::sparing_from
  bool narrow = false;              ///< it may fold: the last start is that without the widest stage
  bool known = false;               ///< its result came with the call; there are no states
  bool learning = false;            ///< others have taught it something, or have begun to

  bool is_narrow(std::size_t start) const { return narrow && start + 1 == starts.size(); }
  bool is_sparing(std::size_t start) const { return start >= sparing_from; }
};

class Computation {
 public:
  Computation(const Model& model, const SceneSpec& spec, const std::vector<LimitTask>& tasks,
              const LimitSettings& settings, const LimitsObserver& observer)
      : model_(model),
        spec_(spec),
        asked_(tasks.size()),
        settings_(settings),
        observer_(observer),
        within_(model, spec, tasks_, asked_, settings_, observer)
  {
    for (const RestSearches& searches : rest_searches(model, tasks, settings)) {
      tasks_.push_back(searches.task);
      TaskState& state = states_.emplace_back();
      state.narrow = searches.narrow;
      state.sparing_from = searches.sparing_from;
      state.starts.resize(searches.starts);
      state.missing = searches.starts;
      results_.push_back(limit_header(model, searches.task));
      results_.back().status = LimitStatus::interrupted;
    }
  }

  std::vector<LimitResult> run(unsigned threads, const std::vector<std::optional<LimitResult>>& known)
  {
    const bool complete =
        known.size() == asked_ && std::all_of(known.begin(), known.end(), [](const auto& r) {
          return r.has_value() && r->confidence.is_final();
        });
    ended_ = complete;
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      // What was learnt from other limits is learnt again unless all is known: then nothing depends on
      // where a run was interrupted.
      std::optional<LimitResult> there;
      if (k < known.size() && known[k] && known[k]->confidence.word != "unfinished") there = known[k];
      if (there && there->status != LimitStatus::locked) there->confidence.word = "none";
      if (there || (complete && k >= asked_)) {
        if (there) results_[k] = std::move(*there);
        states_[k].known = true;
        states_[k].missing = 0;
        continue;
      }
      total_ += states_[k].starts.size();
      ++unfinished_;
      if (k < asked_) ++unfinished_asked_;
    }
    threads = thread_count(threads);
    if (observer_.on_start) observer_.on_start(0, total_);
    if (unfinished_asked_ < asked_ && unfinished_asked_ > 0) tell();
    solve_from_rest(false, threads);
    if (!complete) solve_from_rest(true, threads);
    if (unfinished_ == 0 && !complete) {
      const Donors donors(model_, tasks_);
      if (settings_.lessons && inherit(donors, threads)) learn(donors, threads);
      if (going()) enter_relations(results_, model_, settings_, tasks_, donors);
      ended_ = going();
    }
    keep_unfinished();
    tell();
    if (observer_.on_unreported) {
      unreported_.insert(unreported_.end(), results_.begin() + static_cast<std::ptrdiff_t>(asked_),
                         results_.end());
      observer_.on_unreported(unreported_);
    }
    if (observer_.on_states) {
      std::vector<std::optional<State>> states(asked_);
      for (std::size_t k = 0; k < asked_; ++k) {
        const std::vector<FoundState> found = found_of(k);
        if (const auto best = furthest(model_, tasks_[k], settings_, found))
          states[k] = found[*best].locked.state;
      }
      observer_.on_states(states);
    }
    return so_far();
  }

  /// A share of the searches that stand alone, for the memory. Returns how many all of them are; null:
  /// interrupted.
  std::optional<std::size_t> search(unsigned threads, const Share& share)
  {
    std::vector<std::function<void()>> items;
    std::size_t count = 0;
    const auto add = [&](auto item) {
      if (share.has(count++)) items.emplace_back(std::move(item));
    };
    bool sparing = false;
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      const std::size_t before = items.size();
      for (std::size_t s = 0; s < states_[k].starts.size(); ++s) add([this, k, s] { attempt(k, s); });
      for (int t = 0; k < asked_ && t < settings_.tilts; ++t)
        add([this, k, t] {
          double seconds = 0.0;
          try {
            tilted_search(k, t, seconds);
          } catch (const std::exception&) {  // it throws again where it is asked for
          }
        });
      sparing |= states_[k].is_sparing(states_[k].starts.size() - 1) && items.size() > before;
    }
    threads = thread_count(threads);
    if (sparing) find_allowance(threads);
    share_out(threads, items.size());
    total_ = items.size();
    if (observer_.on_start) observer_.on_start(0, total_);
    parallel_for(items.size(), threads, [&](std::size_t i) {
      if (!going()) return;
      items[i]();
      const std::lock_guard lock(mutex_);
      ++done_;
      if (observer_.on_start) observer_.on_start(done_, total_);
    });
    if (settings_.lessons) count += within_.search(threads, share.after(count));
    return going() ? std::optional(count) : std::nullopt;
  }

 private:
  /// Starts of the tasks that are not known yet: those that are sparing, or the others.
  void solve_from_rest(bool sparing, unsigned threads)
  {
    std::vector<std::pair<std::size_t, std::size_t>> items;  // task, start
    for (std::size_t k = 0; k < tasks_.size(); ++k) {
      if (states_[k].known) continue;
      for (std::size_t s = 0; s < states_[k].starts.size(); ++s)
        if (states_[k].is_sparing(s) == sparing) items.emplace_back(k, s);
    }
    if (items.empty() || !going()) return;
    if (sparing) find_allowance(threads);
    share_out(threads, items.size());
    parallel_for(items.size(), threads, [&](std::size_t i) {
      if (going()) solve(items[i].first, items[i].second);
    });
  }

  /// Of searches in company of taut limits: what the most expensive of those may have. Searches those from
  /// rest that are not there and are not sparing.
  void find_allowance(unsigned threads)
  {
    std::vector<std::size_t> taut;
    for (std::size_t k = 0; k < asked_; ++k)
      if (is_taut(model_, tasks_[k])) taut.push_back(k);
    find_starts(taut, false, threads);
    for (const std::size_t k : taut) allowance_ = std::max(allowance_, allowance_of(k));
  }

  /// Searches from rest, for tasks that no other thread works on, what is not there: starts that are sparing,
  /// or the others.
  void find_starts(const std::vector<std::size_t>& tasks, bool sparing, unsigned threads)
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
  void share_out(unsigned threads, std::size_t items)
  {
    settings_.schedule.threads =
        static_cast<unsigned>(std::max<std::size_t>(1, threads / std::max<std::size_t>(1, items)));
  }

  /// What a search may have that begins again for a taut task.
  long allowance_of(std::size_t task) const
  {
    long most = 0;
    const TaskState& t = states_[task];
    for (std::size_t s = 0; s < t.starts.size() && !t.is_sparing(s); ++s)
      if (t.starts[s].locked) most = std::max(most, t.starts[s].locked->evaluations);
    return allowance(most);
  }

  /// The settings of searches that may have so many evaluations.
  LimitSettings within(long evaluations) const
  {
    LimitSettings settings = settings_;
    settings.schedule.most_evaluations = evaluations;
    return settings;
  }

  /// The settings of a start. A limit that is not reported has few stages: a lesson widens all gaps again.
  LimitSettings settings_of(std::size_t task, std::size_t start) const
  {
    LimitSettings settings = settings_;
    if (states_[task].is_sparing(start)) settings = within(task < asked_ ? allowance_of(task) : allowance_);
    if (task >= asked_) settings.schedule.last = std::max(settings.schedule.last, last_in_company);
    return settings;
  }

  bool going() const { return !observer_.keep_going || observer_.keep_going(); }

  /// Results of the limits asked for, as far as they are.
  std::vector<LimitResult> so_far() const
  {
    std::vector<LimitResult> out(results_.begin(), results_.begin() + static_cast<std::ptrdiff_t>(asked_));
    for (std::size_t k = 0; k < asked_ && !ended_; ++k) {
      out[k].confidence.word = states_[k].learning ? "unfinished" : "alone";
    }
    return out;
  }

  void tell() const
  {
    if (observer_.on_limit) observer_.on_limit(so_far());
  }

  /// What the search of this name finds, or is remembered to have found. `seconds` grows by what it took.
  template <class Search>
  Locked searched(const std::string& name, double& seconds, const Search& search) const
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

  Attempt attempt(std::size_t task, std::size_t start) const
  {
    Attempt out;
    const KeepGoing keep_going = [this] { return going(); };
    const LimitSettings settings = settings_of(task, start);
    try {
      out.locked = searched(fmt::format("limit {} start {}", task, start), out.seconds, [&] {
        return !states_[task].is_narrow(start)
                   ? limit_from_start(model_, tasks_[task], settings, static_cast<int>(start), keep_going)
                   : limit_from_state(model_, tasks_[task], settings,
                                      perturbed(model_, start_state(model_, settings), settings.perturbation,
                                                settings.seed, Copies::alike),
                                      keep_going);
      });
    } catch (const std::exception& error) {
      out.error = error.what();
    }
    if (out.locked && out.locked->status == LockStatus::interrupted) out.locked.reset();
    return out;
  }

  /// Where a task locks under the k-th of its tilted loads.
  Locked tilted_search(std::size_t task, int k, double& seconds) const
  {
    return searched(fmt::format("limit {} tilt {}", task, k), seconds, [&] {
      const std::uint64_t seed = settings_.seed + static_cast<std::uint64_t>(k);
      const State from =
          perturbed(model_, start_state(model_, settings_), settings_.perturbation, seed, Copies::apart);
      const MacroLoad load = macro_load(model_, tasks_[task].direction, tasks_[task].sense);
      return lock(model_, from, tilted(model_, load.pull, settings_, seed), settings_.contact,
                  settings_.schedule, [this] { return going(); });
    });
  }

  /// `allowed`: evaluations that it may have; null: as many as it takes.
  Locked search_from_state(std::size_t task, const State& from, double& seconds,
                           std::optional<long> allowed = std::nullopt) const
  {
    std::string name = fmt::format("limit {} from {}", task, name_of_state(from));
    if (allowed) name += fmt::format(" within {}", *allowed);
    return searched(name, seconds, [&] {
      return limit_from_state(model_, tasks_[task], allowed ? within(*allowed) : settings_, from,
                              [this] { return going(); });
    });
  }

  /// The first start of a task went past every bound, with a witness: others would say no more.
  bool runs_away(std::size_t task) const
  {
    const std::optional<Locked>& first = states_[task].starts.front().locked;
    return first && first->status == LockStatus::unbounded && !first->path.empty();
  }

  void solve(std::size_t task, std::size_t start)
  {
    Attempt done;
    {
      const std::lock_guard lock(mutex_);
      done.needless = start > 0 && runs_away(task);
    }
    if (!done.needless) done = attempt(task, start);
    const bool finished = done.locked || !done.error.empty() || done.needless;
    bool last = false;
    {
      const std::lock_guard lock(mutex_);
      states_[task].starts[start] = std::move(done);
      if (!finished) return;
      last = --states_[task].missing == 0;
      if (last) ++states_[task].missing;  // the task itself, until its tilts are done
    }
    if (last) {
      if (!tilt(task)) return;
      // Outside the lock: forces and balances take a moment.
      LimitResult result = result_of(task, [this] { return going(); });
      if (result.status == LimitStatus::interrupted) return;
      const std::lock_guard lock(mutex_);
      states_[task].missing = 0;
      results_[task] = std::move(result);
      --unfinished_;
      // The last one is told when limits have learnt from each other: who was told all has all.
      if (task < asked_ && --unfinished_asked_ > 0) tell();
    }
    const std::lock_guard lock(mutex_);
    ++done_;
    if (observer_.on_start) observer_.on_start(done_, total_);
  }

  /// Locks a task under tilted loads too, and again from where one of them is further than all that is known.
  /// False: interrupted.
  bool tilt(std::size_t task)
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

  std::vector<FoundState> found_of(std::size_t task) const
  {
    std::vector<FoundState> found;
    const TaskState& t = states_[task];
    for (std::size_t s = 0; s < t.starts.size(); ++s) {
      if (!t.starts[s].locked) continue;
      if (s > 0 && runs_away(task)) break;  // whatever the order in which starts were done
      found.push_back(!t.is_narrow(s) ? FoundState{*t.starts[s].locked, "start", settings_.seed + s}
                                      : FoundState{*t.starts[s].locked, "start, narrow", settings_.seed});
    }
    found.insert(found.end(), t.further.begin(), t.further.end());
    return found;
  }

  /// Out of what there is. Only called when no other thread works on this task.
  LimitResult result_of(std::size_t task, const KeepGoing& keep_going) const
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

  /// The macroscopic unknowns of a result, scaled; null: it has no state.
  std::optional<Vector> macro_of(std::size_t task) const
  {
    const LimitResult& r = results_[task];
    if (static_cast<int>(r.macro.size()) != model_.macro_count) return std::nullopt;
    Vector macro(model_.macro_count);
    for (int k = 0; k < model_.macro_count; ++k) {
      const int power = model_.load->macros()[k].length_power;
      macro[k] = r.macro[k].second / std::pow(model_.length, power);
    }
    return macro;
  }

  std::optional<double> reached_by(const Donors& donors, std::size_t donor, std::size_t task) const
  {
    const std::optional<Vector> macro = macro_of(donors.task(donor));
    return macro ? donors.reached(donor, *macro, tasks_[task]) : std::nullopt;
  }

  std::string learnt_from(const Donors& donors, std::size_t donor) const
  {
    const LimitResult& r = results_[donors.task(donor)];
    return fmt::format("{}, {}{}", r.direction.text(), r.sense,
                       donors.is_own(donor) ? "" : ", by a symmetry of the scene");
  }

  /// Locked state of a task from a state that `place` names; null: it threw, which the task remarks, and what
  /// was known before stands.
  std::optional<FoundState> begun_from(std::size_t task, const State& from, const std::string& place,
                                       std::uint64_t seed, std::optional<long> allowed = std::nullopt)
  {
    std::optional<FoundState> out;
    std::string problem;
    double seconds = 0.0;
    try {
      out = FoundState{search_from_state(task, from, seconds, allowed), learnt_origin + place, seed};
    } catch (const std::exception& failure) {
      problem = fmt::format("from the state of {}: {}", place, failure.what());
    }
    const std::lock_guard lock(mutex_);  // a task may have two lessons at a time
    if (!problem.empty()) states_[task].remark = std::move(problem);
    states_[task].seconds += seconds;
    return out;
  }

  /// Locked state of a task from where a donor's best state is; null where there is none, too. `further`:
  /// that one is known to be further than the task's own.
  std::optional<FoundState> taught(const Donors& donors, std::size_t task, std::size_t donor, bool further)
  {
    const std::size_t from = donors.task(donor);
    const std::vector<FoundState> states = found_of(from);
    const auto best = furthest(model_, tasks_[from], settings_, states);
    if (!best) return std::nullopt;
    const std::optional<State> start = donors.state(donor, states[*best].locked);
    if (!start) return std::nullopt;
    std::optional<long> allowed;
    if (!further && is_taut(model_, tasks_[task])) allowed = allowance_of(task);
    return begun_from(task, *start, learnt_from(donors, donor), states[*best].seed, allowed);
  }

  /// A limit whose lessons were stopped is no answer: a run that goes on has to ask again.
  void stopped(std::size_t task, const std::string& place)
  {
    results_[task].status = LimitStatus::interrupted;
    results_[task].message = fmt::format("what the state of {} leads to was not found", place);
  }

  /// Solves again those of the tasks whose results came with the call.
  void find_states(const std::vector<std::size_t>& needed, unsigned threads)
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

  /// The same of the tasks of lessons.
  void find_states(const Donors& donors, const std::vector<Lesson>& lessons, unsigned threads)
  {
    std::vector<std::size_t> needed;
    for (const auto& [task, donor] : lessons) {
      needed.push_back(task);
      needed.push_back(donors.task(donor));
    }
    find_states(needed, threads);
  }

  /// Of a search from a state: for a taut task its allowance, unless the state is further than its own.
  std::optional<long> allowance_from(std::size_t task, const State& from) const
  {
    if (!is_taut(model_, tasks_[task])) return std::nullopt;
    const std::vector<FoundState> known = found_of(task);
    const auto best = furthest(model_, tasks_[task], settings_, known);
    const bool further =
        best && reached(model_, tasks_[task], from) >
                    reached(model_, tasks_[task], known[*best].locked.state) + further_than(settings_);
    return further ? std::nullopt : std::optional(allowance_of(task));
  }

  /// Each limit begins once more from every state that is given for it. False: interrupted.
  bool inherit(const Donors& donors, unsigned threads)
  {
    std::vector<GivenState> given = within_.states(threads, unreported_);
    given.insert(given.begin(), settings_.given.begin(), settings_.given.end());
    std::vector<std::pair<std::size_t, const GivenState*>> items;
    std::vector<Lesson> learners;
    for (std::size_t k = 0; k < asked_; ++k) {
      for (const GivenState& g : given) {
        if (g.sense != tasks_[k].sense || g.direction != tasks_[k].direction) continue;
        items.emplace_back(k, &g);
        learners.push_back({k, donors.own(k)});
      }
    }
    if (going()) find_states(donors, learners, threads);
    std::vector<std::optional<FoundState>> found(items.size());
    parallel_for(items.size(), threads, [&](std::size_t i) {
      const auto& [k, from] = items[i];
      if (going()) {
        const std::optional<long> allowed = allowance_from(k, from->state);
        found[i] = begun_from(k, from->state, from->origin, settings_.seed, allowed);
      }
    });
    if (!going()) {
      // Also where scenes were not solved that would have given a state.
      for (std::size_t k = 0; k < asked_; ++k)
        if (within_.inherits(k)) stopped(k, "a scene that this one contains");
      for (const auto& [k, from] : items) stopped(k, from->origin);
      return false;
    }
    for (std::size_t i = 0; i < items.size(); ++i) {
      const std::size_t k = items[i].first;
      if (found[i]) states_[k].further.push_back(std::move(*found[i]));
      states_[k].learning = true;
      results_[k] = result_of(k, [this] { return going(); });
    }
    return true;
  }

  /// Limits learn from each other: rounds in which each begins once more from the furthest state that any
  /// other, or a symmetric image of one, has for it; where nothing further is known, from the states of the
  /// loads beside its own, as long as these come to new ones.
  void learn(const Donors& donors, unsigned threads)
  {
    Lessons rounds(asked_, donors.count(), further_than(settings_));
    Walks walks(donors.starting_points(asked_, settings_.contact));
    const auto own = [&](std::size_t k) -> std::optional<double> {
      const LimitStatus status = results_[k].status;
      const std::size_t self = donors.own(k);
      if (status == LimitStatus::locked) return reached_by(donors, self, k);
      // One that stalled learns also from a state that is only as far as its own.
      const auto there = status == LimitStatus::stalled ? reached_by(donors, self, k) : std::nullopt;
      return there ? std::optional(*there - 2.0 * further_than(settings_)) : std::nullopt;
    };
    const auto given = [&](std::size_t donor, std::size_t k) {
      return results_[donors.task(donor)].status == LimitStatus::locked ? reached_by(donors, donor, k)
                                                                        : std::nullopt;
    };
    for (int round = 1;; ++round) {
      std::vector<Lesson> lessons = rounds.next(own, given);
      const bool further = !lessons.empty();
      if (!further) {
        lessons = walks.next(
            [&](std::size_t donor) {
              const std::size_t k = donors.task(donor);
              return given(donors.own(k), k);
            },
            further_than(settings_));
      }
      if (lessons.empty()) return;
      find_states(donors, lessons, threads);
      std::vector<std::optional<FoundState>> found(lessons.size());
      std::size_t done = 0;
      if (observer_.on_lesson) observer_.on_lesson(round, done, lessons.size());
      parallel_for(lessons.size(), threads, [&](std::size_t i) {
        if (going()) found[i] = taught(donors, lessons[i].learner, lessons[i].donor, further);
        const std::lock_guard lock(mutex_);
        ++done;
        if (observer_.on_lesson) observer_.on_lesson(round, done, lessons.size());
      });
      if (!going()) {
        for (const auto& [task, donor] : lessons) stopped(task, learnt_from(donors, donor));
        return;
      }
      for (std::size_t i = 0; i < lessons.size(); ++i) {
        const std::size_t task = lessons[i].learner;
        if (found[i]) states_[task].further.push_back(std::move(*found[i]));
        states_[task].learning = true;
        results_[task] = result_of(task, [this] { return going(); });
      }
    }
  }

  /// Starts that were done before an interrupt are worth keeping, as far as a moment suffices to report them
  /// (LimitsObserver::moment_to_report).
  void keep_unfinished()
  {
    const auto end = std::chrono::steady_clock::now() + observer_.moment_to_report;
    const KeepGoing for_a_moment = [end] { return std::chrono::steady_clock::now() < end; };
    for (std::size_t k = 0; k < asked_; ++k) keep_unfinished(k, for_a_moment);
  }

  void keep_unfinished(std::size_t task, const KeepGoing& keep_going)
  {
    const TaskState& t = states_[task];
    if (t.missing == 0) return;
    const auto done = static_cast<std::size_t>(std::count_if(
        t.starts.begin(), t.starts.end(), [](const Attempt& a) { return a.locked.has_value(); }));
    if (done == 0) return;
    LimitResult result = result_of(task, keep_going);
    result.status = LimitStatus::interrupted;
    result.message = fmt::format("{} of {} starts were done", done, t.starts.size());
    results_[task] = std::move(result);
  }

  const Model& model_;
  const SceneSpec& spec_;
  std::vector<LimitTask> tasks_;  ///< those asked for, then their company
  const std::size_t asked_;
  LimitSettings settings_;
  long allowance_ = 0;  ///< of searches of tasks that are sparing
  const LimitsObserver& observer_;
  ScenesWithin within_;
  std::size_t total_ = 0, done_ = 0;
  std::mutex mutex_;  ///< guards all below
  std::vector<TaskState> states_;
  std::size_t unfinished_ = 0, unfinished_asked_ = 0;  ///< tasks
  bool ended_ = false;                                 ///< nothing more will be learnt
  std::vector<LimitResult> results_;
  std::vector<LimitResult> unreported_;  ///< of scenes that this one contains
};

}  // namespace

double further_than(const LimitSettings& settings) { return std::max(1e-8, settings.schedule.last); }

std::vector<LimitResult> compute_limits(const Model& model, const SceneSpec& spec,
                                        const std::vector<LimitTask>& tasks, const LimitSettings& settings,
                                        unsigned threads, const LimitsObserver& observer,
                                        const std::vector<std::optional<LimitResult>>& known)
{
  return Computation(model, spec, tasks, settings, observer).run(threads, known);
}

double count_searches(const Model& model, const std::vector<LimitTask>& tasks, const LimitSettings& settings)
{
  double count = static_cast<double>(tasks.size()) * settings.tilts;
  for (const RestSearches& searches : rest_searches(model, tasks, settings))
    count += static_cast<double>(searches.starts);
  return count;
}

std::optional<std::size_t> compute_searches(const Model& model, const SceneSpec& spec,
                                            const std::vector<LimitTask>& tasks,
                                            const LimitSettings& settings, unsigned threads,
                                            const LimitsObserver& observer, const Share& share)
{
  return Computation(model, spec, tasks, settings, observer).search(threads, share);
}

}  // namespace hauberk
