#include "run/sha256.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nettle/sha2.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <vector>

namespace hauberk {

Sha256::Sha256() : context_(std::make_unique<sha256_ctx>()) { sha256_init(context_.get()); }

Sha256::~Sha256() = default;

void Sha256::add(std::string_view bytes)
{
  sha256_update(context_.get(), bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
}

std::string Sha256::digest()
{
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> bytes{};
  sha256_digest(context_.get(), bytes.size(), bytes.data());
  return fmt::format("{:02x}", fmt::join(bytes, ""));
}

std::string sha256_of_file(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  Sha256 hash;
  std::vector<char> buffer(1U << 16);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())), in.gcount() > 0)
    hash.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
  return in.eof() ? hash.digest() : std::string();
}

}  // namespace hauberk
