#pragma once
/// Where checks are made; checks.cpp puts them together.

#include "trial.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hauberk::conformance {

/// A check whose function works with a Trial and ends early by Failure, Skip or Slow. One of a kind is run
/// with every switch of the section set otherwise, too.
Check of_trial(std::string name, std::optional<PluginKind> kind, const char* about,
               std::function<void(Trial&)> function);

void add_checks_of_every_kind(std::vector<Check>& out);
/// Of those: what a plugin does to its process, and what the process does to it.
void add_process_checks(std::vector<Check>& out);
void add_speed_check(std::vector<Check>& out);
void add_shape_checks(std::vector<Check>& out);
/// Of those, in files of their own: parameters that are said to be smooth are.
void check_smoothness(Trial& trial);
/// Primitives are closed surfaces that do not meet themselves, within the spheres of the kernel.
void check_surfaces(Trial& trial);
/// Gaps between primitives as the kernel finds them, against samples of their surfaces.
void check_distances(Trial& trial);
/// How load cases move things; the load and what is allowed.
void add_load_case_motion_checks(std::vector<Check>& out);
void add_load_case_load_checks(std::vector<Check>& out);
void add_optimizer_checks(std::vector<Check>& out);
/// What they declare, and what is optional.
void add_declared_checks(std::vector<Check>& out);
/// The known problems, one check each.
void add_known_problem_checks(std::vector<Check>& out);

}  // namespace hauberk::conformance
