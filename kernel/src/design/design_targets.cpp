/// The limits that a design's targets ask for, with their gradients.

#include <hauberk/design/design_problem.hpp>
#include <hauberk/parallel.hpp>

#include <fmt/format.h>

#include <cmath>

namespace hauberk {
namespace {

constexpr double same_value = 1e-9;    ///< two locked states closer than that are taken for one
constexpr int attempts_from_rest = 2;  ///< per limit and evaluation, with different perturbations

}  // namespace

Locked DesignProblem::lock_target(const DesignPoint& p, const Vector& load,
                                  const std::vector<WarmStart>& warm, std::vector<WarmStart>& trail,
                                  long& evaluations) const
{
  const auto run = [&](const State& from, const Schedule& schedule) {
    Locked l = lock(p.model, from, load, limits_.contact, schedule, keep_going_);
    evaluations += l.evaluations;
    return l;
  };
  const auto enter = [](const Locked& l, std::vector<WarmStart>& out) {
    for (std::size_t i = 0; i < l.trail.size(); ++i) out.push_back({l.stages[i].g_hat, l.trail[i]});
  };
  // A limit is the furthest locked state. One search starts loose, and may find another state than the
  // iterate's; one follows the iterate's state, which may be further, as tightly as it can.
  Locked loose;
  if (!warm.empty()) {
    const std::optional<State> start = followed(*current_, warm.front(), p, design_.variables);
    if (start) loose = run(*start, schedule_);
  }
  for (int attempt = 0; attempt < attempts_from_rest && loose.status == LockStatus::stalled; ++attempt) {
    const std::uint64_t seed = limits_.seed + static_cast<std::uint64_t>(attempt);
    loose = run(perturbed(p.model, p.rest, limits_.perturbation, seed, Copies::apart), schedule_);
  }
  if (loose.status != LockStatus::locked && loose.status != LockStatus::stalled) return loose;
  for (std::size_t j = warm.size(); j-- > 1;) {
    if (warm[j].g_hat < schedule_.last) continue;
    const std::optional<State> start = followed(*current_, warm[j], p, design_.variables);
    if (!start) continue;
    Schedule schedule = schedule_;
    schedule.first = warm[j].g_hat;
    Locked tight = run(*start, schedule);
    if (tight.status != LockStatus::locked) continue;
    const bool further = loose.status != LockStatus::locked ||
                         load.dot(tight.state.macro) > load.dot(loose.state.macro) + same_value;
    if (!further) break;
    if (!loose.trail.empty()) trail.push_back({loose.stages.front().g_hat, loose.trail.front()});
    // Looser stages of the same state: the next change of parameters may be too large for the tightest.
    for (std::size_t i = loose.trail.empty() ? 0 : 1; i < j; ++i) {
      std::optional<State> s = followed(*current_, warm[i], p, design_.variables);
      if (s) trail.push_back({warm[i].g_hat, std::move(*s)});
    }
    enter(tight, trail);
    return tight;
  }
  enter(loose, trail);
  return loose;
}

void DesignProblem::solve_targets(DesignPoint& p)
{
  std::vector<std::vector<WarmStart>> warm = current_->warm;  // p may be the iterate itself
  warm.resize(tasks_.size());                                 // a starting design has none
  p.warm.assign(tasks_.size(), {});
  std::vector<Locked> locked(tasks_.size());
  std::vector<double> estimate(tasks_.size());
  std::vector<long> evaluations(tasks_.size(), 0);
  std::vector<Vector> gradient(tasks_.size());
  const auto nv = static_cast<int>(design_.variables.size());
  parallel_for(tasks_.size(), threads_, [&](std::size_t k) {
    const Vector load = load_vector(p.model, tasks_[k].direction_deg * degree, tasks_[k].sense);
    locked[k] = lock_target(p, load, warm[k], p.warm[k], evaluations[k]);
    const Locked& l = locked[k];
    if (l.status != LockStatus::locked) return;
    // -E = +-value - mu contact; its gradient in the parameters is explicit (envelope theorem).
    Request request;
    request.order = 1;
    request.parameters = true;
    const ContactEnergy e =
        contact_energy(p.model, l.state, stage_pairs(p.model, l.state, l.stage), l.stage.contact, request);
    const double scale = std::pow(p.model.length, load_.value_length_power());
    const double sign = tasks_[k].sense == Sense::positive ? 1.0 : -1.0;
    estimate[k] = sign * (load.dot(l.state.macro) - l.stage.mu * e.energy) * scale;
    gradient[k] = Vector::Zero(nv);
    for (int v = 0; v < nv; ++v) {
      for (const auto& [element, parameter] : design_.variables[static_cast<std::size_t>(v)].entries) {
        gradient[k][v] -= sign * l.stage.mu * e.parameters(parameter, element) * scale;
      }
    }
  });
  for (std::size_t k = 0; k < tasks_.size(); ++k) {
    evaluations_ += evaluations[k];
    if (locked[k].status != LockStatus::locked) {
      p.why = fmt::format("no limit at {} degrees: {}", tasks_[k].direction_deg, locked[k].message);
      return;
    }
  }
  const auto nt = static_cast<int>(design_.targets.size());
  p.value_gradients = Matrix::Zero(nt, nv);
  p.values.assign(design_.targets.size(), 0.0);
  p.objective = 0.0;
  p.gradient = Vector::Zero(nv);
  for (int i = 0; i < nt; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (design_.quantity == DesignQuantity::eta) {
      // eta = (s - c)/(1 + c)
      const double s = estimate[2 * k], c = estimate[2 * k + 1];
      p.values[k] = (s - c) / (1.0 + c);
      p.value_gradients.row(i) =
          (gradient[2 * k] / (1.0 + c) - gradient[2 * k + 1] * (1.0 + s) / ((1.0 + c) * (1.0 + c)))
              .transpose();
    } else {
      p.values[k] = estimate[k];
      p.value_gradients.row(i) = gradient[k].transpose();
    }
    const DesignTarget& t = design_.targets[k];
    const double r = p.values[k] - t.value;
    p.objective += 0.5 * t.weight * r * r;
    p.gradient += t.weight * r * p.value_gradients.row(i).transpose();
  }
  p.evaluated = true;
}

}  // namespace hauberk
