#pragma once
/// SHA-256 (FIPS 180-4), by which a result says which library it was computed with.

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct sha256_ctx;

namespace hauberk {

/// The digest of what was given so far.
class Sha256 {
 public:
  Sha256();
  ~Sha256();

  void add(std::string_view bytes);
  /// 64 hexadecimal digits. What is added after it begins anew.
  std::string digest();

 private:
  std::unique_ptr<sha256_ctx> context_;
};

/// Digest of a file; empty where it cannot be read. Thread safe.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace hauberk
