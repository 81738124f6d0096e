#pragma once
/// How checks say what they found.

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>
#include <utility>

namespace hauberk::conformance {

/// Ends a check: the plugin is wrong.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Ends a check: it does not apply to this plugin.
class Skip : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Ends a check: the plugin takes too long.
class Slow : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args)
{
  throw Failure(fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
void require(bool holds, fmt::format_string<Args...> format, Args&&... args)
{
  if (!holds) fail(format, std::forward<Args>(args)...);
}

template <class... Args>
[[noreturn]] void skip(fmt::format_string<Args...> format, Args&&... args)
{
  throw Skip(fmt::format(format, std::forward<Args>(args)...));
}

/// Whether `name` stands in `text` as a word of its own: not as a part of another name.
bool mentions(std::string_view text, std::string_view name);

}  // namespace hauberk::conformance
