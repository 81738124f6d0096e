#include <hauberk/host/process_state.hpp>

#include <unistd.h>
#include <array>
#include <climits>
#include <clocale>
#include <iostream>

namespace hauberk {
namespace {

/// In the order of ProcessState::streams_.
struct Named {
  std::ios* stream;
  const char* name;
};

std::array<Named, 4> standard_streams()
{
  return {{{&std::cin, "std::cin"},
           {&std::cout, "std::cout"},
           {&std::cerr, "std::cerr"},
           {&std::clog, "std::clog"}}};
}

}  // namespace

ProcessState::Stream ProcessState::look(const std::ios& stream)
{
  return {stream.rdbuf(),      stream.flags(), stream.precision(), stream.width(),
          stream.exceptions(), stream.fill(),  stream.getloc()};
}

void ProcessState::put_back(std::ios& stream, const Stream& before)
{
  if (stream.rdbuf() != before.buffer) stream.rdbuf(before.buffer);  // clears the error state
  // One that was imbued costs its buffer a flush.
  if (stream.getloc() != before.locale) stream.imbue(before.locale);
  stream.flags(before.flags);
  stream.precision(before.precision);
  stream.width(before.width);
  stream.fill(before.fill);
  stream.clear();
  stream.exceptions(before.exceptions);
}

std::string ProcessState::directory()
{
  std::array<char, PATH_MAX> path;
  return ::getcwd(path.data(), path.size()) == nullptr ? std::string() : std::string(path.data());
}

ProcessState::ProcessState()
    : directory_(directory()),
      c_locale_(std::setlocale(LC_ALL, nullptr)),
      streams_{look(std::cin), look(std::cout), look(std::cerr), look(std::clog)}
{
}

std::string ProcessState::restore() const
{
  std::string changed;
  const auto add = [&changed](const std::string& what) { changed += (changed.empty() ? "" : ", ") + what; };
  if (!directory_.empty() && directory() != directory_)
    add(::chdir(directory_.c_str()) == 0 ? "current directory" : "current directory, which is gone");
  // A named locale of C++ sets that of C, so that C comes last.
  const bool other = std::locale() != cpp_locale_ || std::setlocale(LC_ALL, nullptr) != c_locale_;
  if (other) {
    add("locale");
    std::locale::global(cpp_locale_);
    std::setlocale(LC_ALL, c_locale_.c_str());
  }
  const std::array<Named, 4> named = standard_streams();
  for (std::size_t k = 0; k < named.size(); ++k) {
    if (look(*named[k].stream) == streams_[k]) continue;
    add(std::string("state of ") + named[k].name);
    put_back(*named[k].stream, streams_[k]);
  }
  return changed;
}

}  // namespace hauberk
