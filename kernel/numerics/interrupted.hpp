#pragma once
/// How work that takes long is given up when it is no longer wanted.

#include <exception>
#include <functional>

namespace hauberk {

/// Work was given up because whoever asked for it says so: there is no result.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// To be called at every small piece of such work, with its number: throws Interrupted where `keep_going`, if
/// not null, says no. Asks at one in 256 of them, which are well below a tenth of a second.
inline void poll(const std::function<bool()>* keep_going, long piece)
{
  if (keep_going != nullptr && (piece & 255) == 0 && !(*keep_going)()) throw Interrupted();
}

}  // namespace hauberk
