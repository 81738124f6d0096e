#include "limits/search_memory.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>

namespace hauberk {
namespace {

/// FNV-1a, 64 bits.
class Hash {
 public:
  void add(const double* x, Eigen::Index n)
  {
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto bits = std::bit_cast<std::uint64_t>(x[k]);
      for (int byte = 0; byte < 64; byte += 8) value_ = (value_ ^ (bits >> byte & 0xffU)) * 0x100000001b3U;
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace

std::string name_of_state(const State& state)
{
  Hash hash;
  hash.add(state.macro.data(), state.macro.size());
  hash.add(state.e.data(), state.e.size());
  for (const Mat3& Q : state.rotation) hash.add(Q.data(), Q.size());
  return fmt::format("{:016x}", hash.value());
}

}  // namespace hauberk
