#pragma once
/// What belongs to the whole process, so that a plugin that changes it changes what the rest of the program
/// reads, prints and finds: the current directory, the locale of C and of C++, the standard streams.

#include <array>
#include <ios>
#include <locale>
#include <streambuf>
#include <string>
#include <utility>

namespace hauberk {

/// The state at one moment. Taking it makes two calls to the system and costs about a microsecond. The calls
/// of several threads do not disturb each other as long as none of them changes the state.
class ProcessState {
 public:
  /// Takes the state as it is. A current directory that cannot be looked at is not part of it.
  ProcessState();

  /// Puts back what is no longer as it was taken, and returns that in words: "current directory",
  /// "locale", "state of std::cout", ..., joined by commas; empty: nothing changed. A directory that was
  /// removed in the meantime cannot be put back.
  std::string restore() const;

 private:
  /// How a stream writes or reads, and where.
  struct Stream {
    std::streambuf* buffer;
    std::ios_base::fmtflags flags;
    std::streamsize precision, width;
    std::ios_base::iostate exceptions;
    char fill;
    std::locale locale;
    bool operator==(const Stream&) const = default;
  };
  static Stream look(const std::ios& stream);
  static void put_back(std::ios& stream, const Stream& before);
  static std::string directory();

  std::string directory_;
  std::string c_locale_;
  std::locale cpp_locale_;
  std::array<Stream, 4> streams_;  ///< std::cin, cout, cerr, clog
};

}  // namespace hauberk
