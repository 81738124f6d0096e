#pragma once
/// The errors that cross the boundary of plugins, with the exit code that each ends in.

#include <stdexcept>
#include <string>

namespace hauberk {

/// Bad input: names the thing, the place and the way out. The command exits with 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A computation that cannot go on; what was computed before it stays valid. The command exits with 1.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A plugin broke its contract (threw, returned wrong sizes, not-a-number); the message names the plugin.
class PluginError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace hauberk
