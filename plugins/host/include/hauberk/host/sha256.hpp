#pragma once
/// SHA-256 (FIPS 180-4), by which a result says which library it was computed with.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace hauberk {

/// The digest of what was given so far. A value: copies go on by themselves.
class Sha256 {
 public:
  void add(std::string_view bytes);
  /// 64 hexadecimal digits. Nothing may be added after it.
  std::string digest();

 private:
  void block(const unsigned char* bytes);

  std::array<std::uint32_t, 8> state_ = {0x6a09e667U, 0xbb67ae85U, 0x3c6ef372U, 0xa54ff53aU,
                                         0x510e527fU, 0x9b05688cU, 0x1f83d9abU, 0x5be0cd19U};
  std::array<unsigned char, 64> pending_{};
  std::size_t pending_count_ = 0;
  std::uint64_t length_ = 0;  ///< bytes
};

/// Digest of a file; empty where it cannot be read. Thread safe.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace hauberk
