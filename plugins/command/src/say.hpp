#pragma once
/// What commands print: text whose names come from files and plugins and must not act on a terminal.

#include "document/plain_text.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace hauberk::command {

/// To standard output. Line breaks stay, all other control characters are shown. Throws std::system_error
/// where it cannot be written.
template <class... T>
void say(fmt::format_string<T...> format, T&&... arguments)
{
  fmt::print("{}", plain_text(fmt::format(format, std::forward<T>(arguments)...), LineBreaks::kept));
}

/// A JSON text to standard output, which stays one.
inline void say_json(std::string_view text) { fmt::print("{}", plain_json(text)); }

/// To standard error; what it cannot take is lost.
template <class... T>
void say_error(fmt::format_string<T...> format, T&&... arguments)
{
  std::fputs(plain_text(fmt::format(format, std::forward<T>(arguments)...), LineBreaks::kept).c_str(),
             stderr);
}

/// That the times of a run cannot be read, and what that means.
inline void say_times_lost(const std::string& reason)
{
  say_error("hauberk: warning: {}; the times of that run are left out\n", reason);
}

}  // namespace hauberk::command
