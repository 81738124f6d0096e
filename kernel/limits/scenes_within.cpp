#include "limits/scenes_within.hpp"

#include "limits/donors.hpp"
#include "limits/relatives.hpp"
#include "limits/rest_searches.hpp"

#include <algorithm>
#include <exception>
#include <memory>
#include <optional>
#include <string>

namespace hauberk {

/// A scene that another one contains, with its limits of use to that one.
struct ScenesWithin::Scene {
  std::string name;  ///< of its searches, and where its states come from
  SceneSpec spec;
  std::shared_ptr<const LoadCase> load;  ///< null: the outermost scene's
  Model model;
  LimitSettings settings;
  std::vector<LimitTask> tasks;
  std::vector<std::size_t> contained;          ///< scenes that this one contains itself, by index
  std::vector<std::optional<State>> locked{};  ///< of `tasks`, once it is solved
};

ScenesWithin::ScenesWithin(const Model& model, const SceneSpec& spec, const std::vector<LimitTask>& tasks,
                           std::size_t asked, const LimitSettings& settings, const LimitsObserver& observer)
    : model_(model), spec_(spec), tasks_(tasks), asked_(asked), settings_(settings), observer_(observer)
{
}

bool ScenesWithin::inherits(std::size_t task) const
{
  const LimitTask& t = tasks_[task];
  return settings_.inherit &&
         (may_fold(model_, t) || (is_taut(model_, t) && begins_again(model_, t, settings_.contact)));
}

namespace {

/// Whether a limit of a scene is of use to that of the one that contains it. A taut fabric under a condition
/// goes no further for another one.
bool is_useful(const Model& outer, const Model& inner, const LimitTask& task)
{
  if (inner.dofs() != outer.dofs()) return true;  // fewer elements, or coordinates of elements
  const std::size_t held = outer.load->conditions(task.direction).size();
  return inner.load->conditions(task.direction).size() != held && (held == 0 || may_fold(outer, task));
}

}  // namespace

/// Those that `outer` contains, and those that they contain, each once; the indices of its own. Every scene
/// stands behind those that it contains.
std::vector<std::size_t> ScenesWithin::enter(const Outer& outer, std::vector<Scene>& scenes) const
{
  std::vector<std::size_t> own;
  for (Relative& relative : relatives(outer.model, outer.spec)) {
    Scene s;
    s.name = outer.name.empty() ? relative.name : outer.name + ", " + relative.name;
    s.spec = std::move(relative.scene);
    s.load = relative.load ? relative.load : outer.load;
    s.model = make_model(s.spec, s.load ? *s.load : *model_.load, model_.clearance * model_.length);
    s.settings = settings_;
    s.settings.given.clear();
    if (s.spec.elements.size() == spec_.elements.size())  // those with fewer cost less
      s.settings.fold_starts = std::max(1, s.settings.fold_starts / share_of_unreported);
    s.settings.inherit = false;  // it is given what scenes within it lock in
    s.settings.schedule.last = std::max(s.settings.schedule.last, last_of_unreported);
    for (const LimitTask& task : outer.tasks)
      if (is_useful(outer.model, s.model, task)) s.tasks.push_back(task);
    if (outer.start) {
      const bool cell = s.spec.elements.size() != outer.spec.elements.size();
      s.settings.start =
          cell ? std::nullopt : Carrier(outer.model, outer.spec, s.model, s.spec).state(*outer.start);
      if (!s.settings.start) s.tasks.clear();
    }
    if (s.tasks.empty()) continue;
    const auto same = std::find_if(scenes.begin(), scenes.end(), [&s](const Scene& other) {
      return contains(s.model, s.spec, other.model, other.spec) &&
             contains(other.model, other.spec, s.model, s.spec);
    });
    if (same != scenes.end()) {
      own.push_back(static_cast<std::size_t>(same - scenes.begin()));
      continue;
    }
    s.contained = enter({s.name, s.model, s.spec, s.load, s.tasks, s.settings.start}, scenes);
    scenes.push_back(std::move(s));
    own.push_back(scenes.size() - 1);
  }
  return own;
}

std::vector<ScenesWithin::Scene> ScenesWithin::all(std::vector<std::size_t>& own) const
{
  std::vector<Scene> scenes;
  std::vector<LimitTask> tasks;
  for (std::size_t k = 0; k < asked_; ++k)
    if (inherits(k)) tasks.push_back(tasks_[k]);
  if (!tasks.empty()) own = enter({"", model_, spec_, nullptr, tasks, settings_.start}, scenes);
  return scenes;
}

/// What the limits of a scene that is solved give those of one that contains it; nothing where their rests
/// are not joined.
void ScenesWithin::give(const Scene& from, const Model& to, const SceneSpec& spec,
                        std::vector<GivenState>& out)
{
  const Carrier carrier(from.model, from.spec, to, spec);
  if (!carrier.joined()) return;
  for (std::size_t k = 0; k < from.tasks.size(); ++k) {
    const std::optional<State> state =
        k < from.locked.size() && from.locked[k] ? carrier.state(*from.locked[k]) : std::nullopt;
    if (state) out.push_back({from.tasks[k].direction, from.tasks[k].sense, *state, from.name});
  }
}

std::vector<GivenState> ScenesWithin::states(unsigned threads, std::vector<LimitResult>& solved) const
{
  std::vector<GivenState> out;
  std::vector<std::size_t> own;
  std::vector<Scene> scenes = all(own);
  const auto add = [&solved](const std::vector<LimitResult>& limits) {
    solved.insert(solved.end(), limits.begin(), limits.end());
  };
  for (Scene& s : scenes) {
    for (const std::size_t k : s.contained) give(scenes[k], s.model, s.spec, s.settings.given);
    std::optional<MemoryWithin> memory;
    if (observer_.memory != nullptr) memory.emplace(*observer_.memory, s.name + ": ");
    LimitsObserver observer;
    observer.keep_going = observer_.keep_going;
    observer.on_states = [&s](const auto& states) { s.locked = states; };
    observer.on_unreported = add;
    observer.memory = memory ? &*memory : nullptr;
    add(compute_limits(s.model, s.spec, s.tasks, s.settings, threads, observer));
    if (!going()) return out;
  }
  for (const std::size_t k : own) give(scenes[k], model_, spec_, out);
  return out;
}

std::size_t ScenesWithin::search(unsigned threads, const Share& share) const
{
  std::size_t count = 0;
  std::vector<std::size_t> own;
  for (const Scene& s : all(own)) {
    if (!going()) return count;
    try {
      MemoryWithin memory(*observer_.memory, s.name + ": ");
      LimitsObserver observer;
      observer.keep_going = observer_.keep_going;
      observer.on_start = observer_.on_start;
      observer.memory = &memory;
      count += compute_searches(s.model, s.spec, s.tasks, s.settings, threads, observer, share.after(count))
                   .value_or(0);
    } catch (const std::exception&) {  // it throws again where it is asked for
    }
  }
  return count;
}

}  // namespace hauberk
