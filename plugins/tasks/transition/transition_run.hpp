#pragma once
/// A transition experiment, computed.

#include "equilibrium/locking.hpp"
#include "tasks/transition/motion.hpp"
#include "tasks/transition/transition_results.hpp"

#include <functional>
#include <string>
#include <vector>

namespace hauberk {

/// A named motion and the number of steps at which it is looked at.
struct TransitionMotion {
  std::string name;
  RigidMotion motion;  ///< scaled by L
  int steps = 200;
};

/// What is computed. Lengths in L.
struct TransitionSpec {
  const Model* model = nullptr;
  int fixed = 0, moving = 1;
  double g_hat = 0.02;
  double range = 0.06;                ///< minima with a smaller surface distance are listed
  std::vector<std::string> contacts;  ///< nearest, published, arc, auto
  Schedule schedule;                  ///< says where auto changes
  std::vector<TransitionMotion> paths;
  std::string length_unit;
};

/// What is wrong with the paths, a sentence each, with the path's number: surfaces that touch or overlap at
/// one of the samples.
std::vector<std::pair<std::size_t, std::string>> transition_problems(const TransitionSpec& spec);

/// Called after every finished part, one call at a time.
using TransitionObserver = std::function<void(std::size_t done, std::size_t total)>;

/// Samples every path, numbers its contacts, looks for discontinuities of every formulation, and measures the
/// quadrature of arc against panels half as long. Results do not depend on `threads`. A path on which
/// `keep_going` said no, or something could not be computed (`message`), is left out.
TransitionResult run_transition(const TransitionSpec& spec, unsigned threads,
                                const TransitionObserver& observer, const KeepGoing& keep_going);

}  // namespace hauberk
