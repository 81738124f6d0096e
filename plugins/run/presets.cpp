#include "run/presets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Contacts that are farther apart than tubes are thick have no direction of their own.
constexpr double last_of_tubes = 0.25;
/// Below this rounding of positions would show in gaps (L).
constexpr double least_last = 1e-11;

/// Activation distance of the paper, sqrt(d_hat) with d_hat = 1e-8 m^2: absolute. Its other thresholds have
/// fixed proportions to d_hat (contact/published.hpp).
constexpr double paper_activation = 1e-4;  // metres
/// A larger activation distance than this (L) is no contact any more.
constexpr double largest_activation = 0.1;
/// "A large unreachable value" is all that the paper says of its target strain.
constexpr double paper_target = 10.0;

ContactChoice contact_choice(const ExperimentSolver& solver)
{
  const ContactChoice named = contact_named(solver.contact);
  const bool paper = named == ContactChoice::automatic && solver.preset == "paper";
  return paper ? ContactChoice::published : named;
}

bool sampled_points(const ExperimentSolver& solver)
{
  return solver.closest_points
             ? *solver.closest_points == "sampled"
             : contact_choice(solver) == ContactChoice::published && solver.preset == "paper";
}

double metres(const std::string& unit) { return unit == "m" ? 1.0 : unit == "mm" ? 1e-3 : 1e-6; }

double paper_activation_in(const SceneSpec& scene, const std::string& unit)
{
  return paper_activation / (characteristic_length(scene) * metres(unit));
}

Schedule preset_schedule(const ExperimentSolver& solver, const SceneSpec& scene, const std::string& unit)
{
  Schedule schedule;  // accurate
  if (solver.preset == "paper") {
    schedule.first = schedule.last = paper_activation_in(scene, unit);
    schedule.ccd = CollisionCheck::sampled;
    schedule.target = paper_target;
  }
  if (solver.ccd)
    schedule.ccd = *solver.ccd == "sampled" ? CollisionCheck::sampled : CollisionCheck::certified;
  if (sampled_points(solver)) schedule.search = MinimaSearch::sampled;
  if (solver.finite_target) schedule.target = *solver.finite_target;
  return schedule;
}

/// Why preset paper, whose lengths are absolute, makes no sense for a scene; else empty.
std::string paper_problem(const SceneSpec& scene, const std::string& unit)
{
  const double length = characteristic_length(scene), activation = paper_activation_in(scene, unit);
  if (activation > largest_activation || activation < least_last) {
    return fmt::format(
        "the activation distance of preset 'paper' is 0.1 mm, {:.3g} times the median ring radius of this "
        "scene; expected {:g} .. {:g}: use preset accurate, or correct length_unit",
        activation, least_last, largest_activation);
  }
  if (const double thinnest = thinnest_tube(scene) / length; thinnest < activation) {
    return fmt::format(
        "the activation distance of preset 'paper' is 0.1 mm, but the thinnest tube has a half-axis of "
        "{:.3g} mm: contacts would act through it; use preset accurate, or correct length_unit",
        thinnest * length * metres(unit) * 1e3);
  }
  return {};
}

bool has_primitive(const SceneSpec& scene, PrimitiveKind kind)
{
  return std::any_of(scene.elements.begin(), scene.elements.end(), [&scene, kind](const PlacedElement& e) {
    const auto primitives = scene.types[e.type].shape->primitives(e.parameters);
    return std::any_of(primitives.begin(), primitives.end(),
                       [kind](const Primitive& p) { return p.kind == kind; });
  });
}

/// Triangle meshes have contact of meshes and nothing else.
void add_mesh_problems(const Experiment& e, std::vector<Problem>& out)
{
  if (meshes_without_contact(e)) {
    out.push_back({"/solver/contact", 0,
                   fmt::format("this scene has elements that are triangle meshes, and contact '{}' knows "
                               "surfaces of other kinds only: set solver.contact to \"mesh\"",
                               e.solver.contact)});
  }
  if (!has_primitive(e.scene, PrimitiveKind::triangle_mesh)) return;
  if (preset_schedule(e.solver, e.scene, e.length_unit).ccd == CollisionCheck::sampled) {
    out.push_back({"/solver", 0,
                   "this scene has elements that are triangle meshes, and sampled collision checks (ccd "
                   "'sampled', preset 'paper') know tori only; use ccd 'certified'"});
  }
}

}  // namespace

bool meshes_without_contact(const Experiment& e)
{
  return e.solver.contact != "mesh" && has_primitive(e.scene, PrimitiveKind::triangle_mesh);
}

std::vector<Problem> solver_problems(const Experiment& e)
{
  const ExperimentSolver& solver = e.solver;
  std::vector<Problem> out;
  if (solver.preset == "paper") {
    const std::string problem = paper_problem(e.scene, e.length_unit);
    if (!problem.empty()) out.push_back({"/solver/preset", 0, problem});
  }
  if (solver.facets && solver.contact != "mesh") {
    out.push_back(
        {"/solver/facets", 0, "facets belong to contact 'mesh'; remove this or choose that contact"});
  }
  const bool constrained = solver.contact == "constrained";
  if (constrained && solver.ccd)
    out.push_back({"/solver/ccd", 0, "contact 'constrained' checks no steps for collisions; remove this"});
  const bool published = contact_choice(solver) == ContactChoice::published;
  const bool tori_only = published || solver.ccd == "sampled";
  const auto refuse = [&](PrimitiveKind kind, const char* what, const char* instead) {
    if (!tori_only || !has_primitive(e.scene, kind)) return;
    out.push_back({"/solver", 0,
                   fmt::format("this scene has {}, and contact 'published', ccd 'sampled' and preset 'paper' "
                               "know tori only; use contact {}",
                               what, instead)});
  };
  refuse(PrimitiveKind::curve_tube, "tubes around curves", "auto, arc, nearest or mesh");
  refuse(PrimitiveKind::solid, "solids", "auto, arc or nearest, and ccd certified");
  add_mesh_problems(e, out);
  if (!published && solver.closest_points == "sampled") {
    out.push_back(
        {"/solver/closest_points", 0,
         "sampled closest points belong to contact 'published'; remove this or choose that contact"});
  }
  return out;
}

LimitSettings limit_settings(const ExperimentSolver& solver, const SceneSpec& scene, const std::string& unit)
{
  LimitSettings settings;
  settings.contact = contact_choice(solver);
  settings.schedule = preset_schedule(solver, scene, unit);
  Schedule& schedule = settings.schedule;
  // Gaps at equilibrium are about a tenth of the activation distance, so 1 + value is as exact as the last
  // one.
  if (solver.tolerance) {
    const double most =
        std::min(schedule.first, last_of_tubes * thinnest_tube(scene) / characteristic_length(scene));
    schedule.last = std::clamp(*solver.tolerance, least_last, std::max(most, least_last));
  }
  if (solver.max_stages)
    schedule.last =
        std::max(schedule.last, schedule.first * std::pow(schedule.ratio, *solver.max_stages - 1));
  if (solver.max_iterations) schedule.most_iterations = *solver.max_iterations;
  settings.starts = solver.starts;
  settings.perturbation = solver.perturbation;
  settings.lessons = solver.lessons;
  settings.neighbours = solver.neighbours;
  settings.tilts = solver.tilts;
  settings.tilt = solver.tilt;
  settings.further_perturbation = std::max(settings.further_perturbation, solver.perturbation);
  settings.seed = solver.start_seed;
  return settings;
}

Schedule design_schedule()
{
  Schedule schedule;
  schedule.first = 0.03;
  schedule.ratio = 0.1;
  schedule.last = 1e-4;
  // Leaves forces, and so gradients, accurate to about a thousandth.
  schedule.last_tolerance = 1e-6;
  schedule.last_quadrature = Quadrature::rough;
  return schedule;
}

}  // namespace hauberk
