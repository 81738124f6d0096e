#include "tasks/design/design_limits.hpp"

#include "equilibrium/rest.hpp"
#include "run/interrupt.hpp"
#include "run/presets.hpp"

#include <algorithm>
#include <utility>

namespace hauberk {
namespace {

/// Designs of one scene that differ in nothing, bit for bit.
bool same_design(const SceneSpec& a, const SceneSpec& b)
{
  return std::ranges::equal(a.elements, b.elements, [](const PlacedElement& x, const PlacedElement& y) {
    return x.parameters == y.parameters && x.rest.position == y.rest.position &&
           x.rest.rotation == y.rest.rotation;
  });
}

/// Starts of a quick look: a compression has so many, as many random loads, and one search without the widest
/// stage. A state that a third of them come to is missed by one compression in twenty.
constexpr int quick_starts = 3;

LimitSettings quick(LimitSettings settings)
{
  settings.most_starts = quick_starts;
  settings.tilts = 0;
  settings.neighbours = 0.0;
  settings.inherit = false;
  return settings;
}

/// What a run remembers of one of its computations of limits.
std::optional<MemoryWithin> memory_for(const RunContext& context, const std::string& label)
{
  if (context.memory == nullptr) return std::nullopt;
  return MemoryWithin(*context.memory, label + ": ");
}

}  // namespace

ReportedScene DesignLimits::as_it_is(const SceneSpec& scene) const
{
  const Experiment& experiment = prepared_.experiment;
  // A design may have made tubes thinner, on which settings depend.
  return {scene, make_model(scene, *experiment.load_case, experiment.solver.clearance),
          limit_settings(experiment.solver, scene, experiment.length_unit)};
}

ReportedScene DesignLimits::with_open_gaps(SceneSpec scene) const
{
  const Experiment& experiment = prepared_.experiment;
  scene.length = prepared_.scene.length;
  PreparedScene prepared =
      prepare_rest(scene, make_model(scene, *experiment.load_case, experiment.solver.clearance));
  ReportedScene out = as_it_is(prepared.scene);
  out.settings.start = std::move(prepared.start);
  return out;
}

LimitsJob DesignLimits::job(const RunContext& context, const std::string& label,
                            const ReportedScene& of) const
{
  LimitsJob job;
  job.model = &of.model;
  job.scene = &of.scene;
  job.tasks = tasks_;
  job.settings = of.settings;
  job.load_case = prepared_.experiment.load_case_plugin;
  job.threads = context.threads;
  job.label = label;
  return job;
}

std::vector<LimitResult> DesignLimits::compute(const RunContext& context, const std::string& label,
                                               const ReportedScene& of, const LimitsSink& sink) const
{
  LimitsJob job = this->job(context, label, of);
  std::optional<MemoryWithin> memory = memory_for(context, label);
  job.memory = memory ? &*memory : nullptr;
  std::vector<LimitResult> out = run_limits(job, context.progress, sink);
  context.progress.clear();
  return out;
}

void DesignLimits::compute_part(const RunContext& context, const std::string& label, const ReportedScene& of,
                                const Share& share) const
{
  LimitsJob job = this->job(context, label, of);
  std::optional<MemoryWithin> memory = memory_for(context, label);
  job.memory = memory ? &*memory : nullptr;
  run_searches(job, context.progress, share);
}

LimitsReport DesignLimits::report(const RunContext& context, const DesignSpec& design)
{
  return [this, &context, &design](const SceneSpec& scene, Look look) {
    ReportedScene of = with_open_gaps(scene);
    if (const Reported* known = find(of.scene, look, &design)) return known->states;
    if (look == Look::quick) of.settings = quick(std::move(of.settings));
    LimitsJob job = this->job(context, "limits of what the search may end with", of);
    job.tasks.resize(targets_);
    Reported out;
    const auto count = [&out](const std::vector<LimitResult>& limits) {
      for (const LimitResult& limit : limits) out.states.evaluations += limit.evaluations;
    };
    job.on_states = [&out](const auto& states) { out.states.states = states; };
    job.on_unreported = count;
    if (look == Look::until_exceeded) {
      job.is_enough = [&design, &out](const std::vector<LimitResult>& found) {
        return out.states.in_part = exceeds_targets(design, found);
      };
    }
    out.limits = run_limits(job, context.progress, [](const auto& /*so_far*/) {});
    context.progress.clear();
    count(out.limits);
    out.states.scene = std::move(of.scene);
    out.states.model = std::move(of.model);
    out.look = look == Look::until_exceeded && !out.states.in_part ? Look::whole : look;
    if (!interrupted()) reported_.push_back(out);
    return out.states;
  };
}

const DesignLimits::Reported* DesignLimits::find(const SceneSpec& scene, Look look,
                                                 const DesignSpec* design) const
{
  const auto known = std::ranges::find_if(reported_, [&](const Reported& reported) {
    const bool so_looked_at =
        reported.look == look || (look == Look::until_exceeded && reported.look == Look::whole &&
                                  !exceeds_targets(*design, reported.limits));
    return so_looked_at && same_design(reported.states.scene, scene);
  });
  return known == reported_.end() ? nullptr : &*known;
}

const std::vector<LimitResult>* DesignLimits::reported(const ReportedScene& of) const
{
  const Reported* const known = targets_ == tasks_.size() ? find(of.scene, Look::whole) : nullptr;
  return known == nullptr ? nullptr : &known->limits;
}

}  // namespace hauberk
