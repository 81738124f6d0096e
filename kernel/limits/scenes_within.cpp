#include "limits/scenes_within.hpp"

#include "limits/donors.hpp"
#include "limits/relatives.hpp"

#include <algorithm>
#include <exception>
#include <string>

namespace hauberk {

/// A scene that another one contains, and its limits of one kind; no tasks: the other has no use for any.
struct ScenesWithin::Scene {
  std::string name;  ///< of the searches
  Model model;
  LimitSettings settings;
  std::vector<LimitTask> tasks;
};

ScenesWithin::ScenesWithin(const Model& model, const SceneSpec& spec, const std::vector<LimitTask>& tasks,
                           std::size_t asked, const LimitSettings& settings, const LimitsObserver& observer)
    : model_(model), spec_(spec), tasks_(tasks), asked_(asked), settings_(settings), observer_(observer)
{
}

bool ScenesWithin::inherits(std::size_t task, Kind kind) const
{
  const LimitTask& t = tasks_[task];
  if (kind == Kind::folding) return may_fold(model_, t);
  return is_taut(model_, t) && begins_again(model_, t, settings_.contact);
}

bool ScenesWithin::inherits(std::size_t task) const
{
  return inherits(task, Kind::folding) || inherits(task, Kind::taut);
}

bool ScenesWithin::any_inherits() const
{
  for (std::size_t k = 0; k < asked_; ++k)
    if (inherits(k)) return true;
  return false;
}

/// Limits that fold stand alone, since their states begin a search and are no answers; taut ones are as far
/// as the relative's own answer, which lessons find where searches from rest do not.
ScenesWithin::Scene ScenesWithin::scene(const Relative& relative, Kind kind) const
{
  Scene s;
  s.name = relative.name + (kind == Kind::taut ? ", taut" : "");
  const LoadCase& load = relative.load ? *relative.load : *model_.load;
  s.model = make_model(relative.scene, load, model_.clearance * model_.length);
  const bool other_elements = s.model.dofs() != model_.dofs();  // fewer of them, or of their coordinates
  for (std::size_t k = 0; k < asked_; ++k) {
    const Direction& along = tasks_[k].direction;
    const std::size_t held = model_.load->conditions(along).size();
    const bool more_held = load.conditions(along).size() != held;
    // A taut fabric under a condition goes no further for another one.
    const bool useful = other_elements || (more_held && (kind == Kind::folding || held == 0));
    if (useful && inherits(k, kind)) s.tasks.push_back(tasks_[k]);
  }
  s.settings = settings_;
  s.settings.given.clear();
  // A cell's own start is one of its multiple's, which moves copies alike; the others are new.
  const bool cell = relative.scene.elements.size() != spec_.elements.size();
  if (kind == Kind::folding) {
    s.settings.lessons = false;
    s.settings.starts = cell ? std::max(settings_.starts, settings_.fold_starts) : 1;
  }
  if (settings_.start && !s.tasks.empty()) {
    if (!cell) s.settings.start = Carrier(model_, spec_, s.model, relative.scene).state(*settings_.start);
    if (cell || !s.settings.start) s.tasks.clear();
  }
  return s;
}

std::vector<GivenState> ScenesWithin::states(unsigned threads, std::vector<LimitResult>& solved) const
{
  std::vector<GivenState> out;
  if (!any_inherits()) return out;
  const auto add = [&solved](const std::vector<LimitResult>& limits) {
    solved.insert(solved.end(), limits.begin(), limits.end());
  };
  for (const Relative& relative : relatives(model_, spec_)) {
    for (const Kind kind : {Kind::folding, Kind::taut}) {
      const Scene s = scene(relative, kind);
      if (s.tasks.empty()) continue;
      std::optional<MemoryWithin> memory;
      if (observer_.memory != nullptr) memory.emplace(*observer_.memory, s.name + ": ");
      std::vector<std::optional<State>> locked;
      LimitsObserver observer;
      observer.keep_going = observer_.keep_going;
      observer.on_states = [&locked](const auto& states) { locked = states; };
      observer.on_unreported = add;
      observer.memory = memory ? &*memory : nullptr;
      add(compute_limits(s.model, relative.scene, s.tasks, s.settings, threads, observer));
      if (!going()) return out;
      const Carrier carrier(s.model, relative.scene, model_, spec_);
      if (!carrier.joined()) continue;
      for (std::size_t k = 0; k < s.tasks.size(); ++k) {
        const std::optional<State> state = locked[k] ? carrier.state(*locked[k]) : std::nullopt;
        if (state) out.push_back({s.tasks[k].direction, s.tasks[k].sense, *state, relative.name});
      }
    }
  }
  return out;
}

std::size_t ScenesWithin::search(unsigned threads, const Share& share) const
{
  std::size_t count = 0;
  if (!any_inherits()) return count;
  for (const Relative& relative : relatives(model_, spec_)) {
    for (const Kind kind : {Kind::folding, Kind::taut}) {
      if (!going()) return count;
      try {
        const Scene s = scene(relative, kind);
        if (s.tasks.empty()) continue;
        MemoryWithin memory(*observer_.memory, s.name + ": ");
        LimitsObserver observer;
        observer.keep_going = observer_.keep_going;
        observer.on_start = observer_.on_start;
        observer.memory = &memory;
        count += compute_searches(s.model, relative.scene, s.tasks, s.settings, threads, observer,
                                  share.after(count))
                     .value_or(0);
      } catch (const std::exception&) {  // it throws again where it is asked for
      }
    }
  }
  return count;
}

}  // namespace hauberk
