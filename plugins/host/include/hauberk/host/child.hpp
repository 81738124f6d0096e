#pragma once
/// Functions in processes of their own: what crashes or never returns there does not end this program.

#include <functional>
#include <string>

namespace hauberk {

/// What became of a function that ran in a child process.
struct Child {
  bool returned = false;
  std::string text;    ///< what the function returned
  std::string ending;  ///< how the child ended otherwise: "ended by signal 11 (Segmentation fault)", ...
};

/// Runs `f` in a child of this process, which must have no threads that `f` needs. What the child prints is
/// kept from this program's output; its last line is part of `ending`. After `seconds` the child is ended,
/// with all that it started; an exception that leaves `f` aborts it. Throws ComputationError when no process
/// can be made.
Child in_child(const std::function<std::string()>& f, double seconds);

}  // namespace hauberk
