#include "support.hpp"

#include <hauberk/host/sha256.hpp>

namespace hauberk::test {
namespace {

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
  const TemporaryFolder folder;
  EXPECT_EQ(sha256_of_file(folder.file("a", "abc")), of("abc"));
  EXPECT_EQ(sha256_of_file(folder.file("b", std::string(200000, 'b'))), of(std::string(200000, 'b')));
  EXPECT_EQ(sha256_of_file(folder / "none"), "");
}

}  // namespace
}  // namespace hauberk::test
