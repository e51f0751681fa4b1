#include "framework/core/math/fnv.h"

#include <gtest/gtest.h>

namespace presa {
namespace {

std::uint64_t hashOf(std::string_view text) {
  Fnv1a hash;
  hash.add(text);
  return hash.value();
}

// Published test vectors of FNV-1a, 64 bit (draft-eastlake-fnv, appendix): the hash means the same everywhere.
TEST(Fnv1a, MatchesThePublishedVectors) {
  EXPECT_EQ(hashOf(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(hashOf("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(hashOf("foobar"), 0x85944171f73967e8ULL);
}

TEST(Fnv1a, AWordIsItsBytesTheLeastSignificantFirst) {
  Fnv1a word;
  word.addWord(std::uint32_t{0x636261});  // "abc", and a zero
  EXPECT_EQ(word.value(), hashOf(std::string_view("abc\0", 4)));
}

TEST(Fnv1a, ZerosAreBytesOfZero) {
  Fnv1a zeros;
  zeros.add("a");
  zeros.addZeros<8>();
  EXPECT_EQ(zeros.value(), hashOf(std::string_view("a\0\0\0\0\0\0\0\0", 9)));
}

}  // namespace
}  // namespace presa
