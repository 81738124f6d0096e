#pragma once
/// Functions in processes of their own: what crashes or never returns there does not end this program.

#include <functional>
#include <limits>
#include <string>

namespace hauberk {

/// What became of a function that ran in a child process.
struct Child {
  bool returned = false;
  std::string text;    ///< what the function returned
  std::string ending;  ///< how the child ended otherwise: "ended by signal 11 (Segmentation fault)", ...
  bool out_of_time = false;        ///< it was ended for the time it took
  double processor_seconds = 0.0;  ///< what it used, its threads included, its own children not
};

/// How long a child may take. What it computes in a given processor time does not depend on what else the
/// machine does; what sleeps, or waits for itself, uses none and is seen by the elapsed time alone.
struct TimeLimits {
  double processor = std::numeric_limits<double>::infinity();  ///< seconds
  double elapsed = std::numeric_limits<double>::infinity();    ///< seconds
};

/// Runs `f` in a child of this process, which must have no threads that `f` needs. What the child prints is
/// kept from this program's output; its last line is part of `ending`. Where it takes longer than a limit the
/// child is ended, with all that it started; an exception that leaves `f` aborts it. Throws ComputationError
/// when no process can be made.
Child in_child(const std::function<std::string()>& f, const TimeLimits& limits);
/// The same with a limit of the elapsed time.
Child in_child(const std::function<std::string()>& f, double seconds);

}  // namespace hauberk
