#include "base/hash.h"

#include <gtest/gtest.h>

namespace ambf::base {
namespace {

std::uint64_t hash_of(std::string_view text) {
  Fnv1a hash;
  hash.add_text(text);
  return hash.value();
}

// Files that users keep (saved states, window layouts) hold such values: they are those of the published algorithm.
TEST(Hash, IsThePublishedFnv1a) {
  EXPECT_EQ(hash_of(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(hash_of("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(hash_of("foobar"), 0x85944171f73967e8ULL);
  EXPECT_EQ(fnv1a_32(""), 0x811c9dc5U);
  EXPECT_EQ(fnv1a_32("foobar"), 0xbf9cf968U);
}

TEST(Hash, OfWordsSeesEachBitAndTheirOrder) {
  const auto of = [](auto first, auto second) {
    Fnv1a hash;
    hash.add_word(first);
    hash.add_word(second);
    return hash.value();
  };
  for (int bit = 0; bit < 64; ++bit) {
    EXPECT_NE(of(std::uint64_t{1} << bit, std::uint64_t{0}), of(std::uint64_t{0}, std::uint64_t{0})) << bit;
    // The lower half, which tables use, changes too.
    EXPECT_NE(of(std::uint64_t{1} << bit, std::uint64_t{0}) & 0xFFFFFFFF,
              of(std::uint64_t{0}, std::uint64_t{0}) & 0xFFFFFFFF)
        << bit;
  }
  EXPECT_NE(of(std::uint64_t{1}, std::uint64_t{2}), of(std::uint64_t{2}, std::uint64_t{1}));
  EXPECT_NE(of(0.0, 1.0), of(-0.0, 1.0));
}

}  // namespace
}  // namespace ambf::base
