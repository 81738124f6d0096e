#include "limits/state_forces.hpp"

#include "limits/kinks.hpp"

#include <fmt/format.h>

#include <array>

namespace hauberk {
namespace {

/// Contacts of the last stage, with what forces and sensitivities need.
ContactEnergy contacts_of(const Model& m, const Locked& l, const KeepGoing& keep_going)
{
  ContactSettings settings = l.stage.contact;
  settings.keep_going = &keep_going;
  Request request;
  request.order = 1;
  request.parameters = request.points = true;
  return contact_energy(m, l.state, stage_pairs(m, l.state, l.stage), settings, request);
}

/// Largest component by which the gradient of arc's energy changes with panels half as long, whose quadrature
/// is better by orders of magnitude; times the stiffness. At the last stages rounding of the gap is part of
/// it.
double quadrature_error(const Model& m, const Matrix& held, const Locked& l, const ContactEnergy& e,
                        const KeepGoing& keep_going)
{
  ContactSettings finer = l.stage.contact;
  finer.keep_going = &keep_going;
  finer.panel_ratio *= 0.5;
  Request request;
  request.order = 1;
  const ContactEnergy better = contact_energy(m, l.state, stage_pairs(m, l.state, l.stage), finer, request);
  return l.stage.mu * unheld(m, held, better.gradient - e.gradient).cwiseAbs().maxCoeff();
}

ContactForce reported_contact(const Model& m, const ContactEnergy::Point& p, double mu, const Vec3& shift)
{
  ContactForce c;
  if (p.wall >= 0) {
    c.elements = {p.a, -1};
    c.primitives = {-1, -1};
    c.wall = m.walls[p.wall].name;
  } else {
    const Body& A = m.bodies[p.a];
    const Body& B = m.bodies[p.b];
    c.elements = {A.element, B.element};
    c.primitives = {A.index, B.index};
    c.image = p.image;
  }
  c.points = {(p.contact.on_p + shift) * m.length, (p.contact.on_f + shift) * m.length};
  c.normal = p.contact.normal;
  c.gap = p.contact.gap * m.length;
  c.force = mu * p.contact.force / m.length;
  return c;
}

void fill_kink(LimitResult& r, const Model& m, const LimitTask& task, const Locked& l)
{
  const std::optional<OneSidedSensitivities> sides = one_sided_sensitivities(m, task, l);
  if (!sides) return;
  const double scale = m.value_unit();
  const auto times = [](const std::array<double, 2>& x, double by) {
    return std::array{x[0] * by, x[1] * by};
  };
  r.kink = true;
  r.clearance_one_sided = times(sides->clearance, scale / m.length);
  for (const auto& p : sides->parameters) r.parameters_one_sided.push_back(times(p, scale));
}

}  // namespace

StateForces::StateForces(const Model& of, const LimitTask& asked, const Locked& found, const KeepGoing& keep)
    : model(of),
      task(asked),
      locked(found),
      keep_going(keep),
      contacts(found.pressed ? *found.pressed : contacts_of(of, found, keep)),
      load(macro_load(of, asked.direction, asked.sense)),
      full(load.pull.norm()),
      scale(of.value_unit())
{
  load.pull = driving_load(of, found.state, load.pull, found.stage);
  driving = load.pull.norm() / full;
}

double energy_imbalance(const StateForces& h)
{
  Vector rest = h.locked.stage.mu * h.contacts.gradient;
  rest.head(h.model.macro_count) -= h.load.pull;
  return unheld(h.model, h.load.held, rest).cwiseAbs().maxCoeff();
}

void balance_forces(StateForces& h)
{
  const Formulation f = h.locked.stage.contact.formulation;
  if (h.locked.status != LockStatus::locked || h.locked.pressed || !traits(f).is_of_gaps) return;
  const double mu = h.locked.stage.mu, most = noticed_imbalance * h.driving * h.full;
  const auto imbalance = [&] {
    return force_balance(h.model, h.locked.state, h.load, h.contacts.points, mu).imbalance;
  };
  const double before = imbalance();
  if (!(before > most) || !(energy_imbalance(h) > most)) return;
  const std::optional<Vector> parts = balancing_parts(h.model, h.locked.state, h.load, h.contacts.points, mu);
  if (!parts) return;
  ContactEnergy as_found = h.contacts;
  if (!change_forces(h.contacts, h.model, h.locked.state, f, *parts)) return;
  if (imbalance() < most)
    h.missed_before = before / h.full;
  else
    h.contacts = std::move(as_found);
}

void fill_forces(LimitResult& r, const StateForces& h, const Vec3& shift)
{
  for (const ContactEnergy::Point& p : h.contacts.points)
    r.contacts.push_back(reported_contact(h.model, p, h.locked.stage.mu, shift));
  const ForceBalance forces =
      force_balance(h.model, h.locked.state, h.load, h.contacts.points, h.locked.stage.mu);
  r.force_balance = forces.imbalance / h.full;
  const std::vector<MacroCondition> conditions = h.model.load->conditions(h.task.direction);
  for (std::size_t k = 0; k < conditions.size(); ++k) {
    const double rise = forces.reactions[k];
    r.reactions.emplace_back(conditions[k].name, h.task.sense == Sense::positive ? rise : -rise);
  }
  r.contact = h.locked.pressed ? "constrained" : name_of(h.locked.stage.contact.formulation);
  if (traits(h.locked.stage.contact.formulation).is_integral)
    r.quadrature_error = quadrature_error(h.model, h.load.held, h.locked, h.contacts, h.keep_going) / h.full;
}

void fill_sensitivities(LimitResult& r, const StateForces& h, const SceneSpec& spec)
{
  const double by = -h.sign() * h.locked.stage.mu;
  r.sensitivity_clearance = by * h.contacts.d_clearance * h.scale / h.model.length;
  for (int k = 0; k < h.model.element_count(); ++k) {
    const std::size_t i = k;
    const auto& infos = spec.types[spec.elements[i].type].shape->parameters();
    for (std::size_t c = 0; c < infos.size(); ++c) {
      r.sensitivity_parameters.emplace_back(fmt::format("{}/{}", k, infos[c].name),
                                            by * h.contacts.parameters(static_cast<int>(c), k) * h.scale);
    }
  }
  if (h.locked.status == LockStatus::locked) fill_kink(r, h.model, h.task, h.locked);
}

}  // namespace hauberk
