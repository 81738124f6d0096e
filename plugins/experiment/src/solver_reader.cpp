#include "document/node_access.hpp"
#include "sections.hpp"

namespace hauberk {

ExperimentSolver read_solver(Node& section, std::uint64_t seed)
{
  ExperimentSolver solver;
  set_default(section, "start_seed", number_node(static_cast<double>(seed)));
  solver.preset = string_or(section, "preset", "accurate");
  solver.clearance = number_or(section, "clearance", 0.0);
  solver.contact = string_or(section, "contact", "auto");
  solver.facets = optional_int(section, "facets");
  solver.closest_points = optional_string(section, "closest_points");
  solver.ccd = optional_string(section, "ccd");
  solver.finite_target = optional_number(section, "finite_target");
  solver.starts = int_or(section, "starts", 1);
  solver.perturbation = number_or(section, "perturbation", 0.0);
  solver.lessons = boolean_or(section, "lessons", true);
  solver.neighbours = number_or(section, "neighbours", 0.0);
  solver.tilts = int_or(section, "tilts", 0);
  solver.tilt = number_or(section, "tilt", 0.0);
  solver.start_seed = seed_or(section, "start_seed", seed);
  solver.max_stages = optional_int(section, "max_stages");
  solver.max_iterations = optional_int(section, "max_iterations");
  solver.tolerance = optional_number(section, "tolerance");
  return solver;
}

}  // namespace hauberk
