/// Digests of texts and files.

#include "run/sha256.hpp"

#include <gtest/gtest.h>

#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <string>

namespace hauberk::test {
namespace {

namespace fs = std::filesystem;

std::string of(const std::string& text)
{
  Sha256 hash;
  hash.add(text);
  return hash.digest();
}

/// The examples of FIPS 180-2, appendix B, and the digest of nothing (NIST CAVP, SHA256ShortMsg).
TEST(Sha256, PublishedVectors)
{
  EXPECT_EQ(of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(of(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, PiecesDoNotMatter)
{
  const std::string text(1000, 'x');
  for (const std::size_t piece : {1U, 55U, 56U, 63U, 64U, 65U}) {
    Sha256 hash;
    for (std::size_t at = 0; at < text.size(); at += piece) hash.add(text.substr(at, piece));
    EXPECT_EQ(hash.digest(), of(text)) << piece;
  }
}

TEST(Sha256, OfFiles)
{
  const fs::path folder = fs::path(testing::TempDir()) / ("hauberk-sha256-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const auto digest_with = [&folder](const std::string& text) {
    std::ofstream(folder / "a", std::ios::binary) << text;
    return sha256_of_file(folder / "a");
  };
  for (const std::string& text : {std::string(), std::string("abc"), std::string(200000, 'b')})
    EXPECT_EQ(digest_with(text), of(text));
  EXPECT_EQ(sha256_of_file(folder / "none"), "");
  fs::remove_all(folder);
}

}  // namespace
}  // namespace hauberk::test
