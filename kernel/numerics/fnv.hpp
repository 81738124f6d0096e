#pragma once
/// FNV-1a, 64 bits (Fowler, Noll, Vo): to tell contents apart, not to hide or to prove anything.

#include <cstdint>
#include <string_view>

namespace hauberk {

/// The hash of what was added so far. A value.
class Fnv1a {
 public:
  void add(unsigned char byte) { value_ = (value_ ^ byte) * 0x100000001b3U; }
  void add(std::string_view bytes)
  {
    for (const char c : bytes) add(static_cast<unsigned char>(c));
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace hauberk
