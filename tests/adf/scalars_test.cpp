#include "adf/detail/scalars.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ambf::adf {
namespace {

TEST(Scalars, NumbersAsYamlWritesThem) {
  for (const auto& [text, value] :
       {std::pair{"1", 1.0}, {"-1.5", -1.5}, {"+2", 2.0}, {".5", 0.5}, {"5.", 5.0}, {"1e-3", 1e-3}, {"0xff", 255.0}}) {
    ASSERT_TRUE(to_number(text)) << text;
    EXPECT_EQ(*to_number(text), value) << text;
  }
  EXPECT_TRUE(std::isinf(*to_number("-.INF")));
  EXPECT_TRUE(std::isnan(*to_number(".NaN")));
  EXPECT_TRUE(std::isinf(*to_number("1e999")));
  EXPECT_EQ(*to_number("1e-999"), 0.0);
  for (const char* text : {"", "-", "one", "1 2", "1,5", "inf", "nan", "0x", "1e", "--1", "0xfg"})
    EXPECT_FALSE(to_number(text)) << text;
}

TEST(Scalars, WholeNumbersMayHaveAPointButNoFraction) {
  EXPECT_EQ(to_integer("50"), 50);
  EXPECT_EQ(to_integer("50.0"), 50);
  EXPECT_EQ(to_integer("-3"), -3);
  for (const char* text : {"1.5", "1e30", ".nan", ".inf", "ten"}) EXPECT_FALSE(to_integer(text)) << text;
}

TEST(Scalars, BooleansOfAllSpellings) {
  for (const char* text : {"true", "True", "TRUE", "yes", "on", "y", "Y", "1"})
    EXPECT_EQ(to_boolean(text), true) << text;
  for (const char* text : {"false", "False", "NO", "off", "n", "0"}) EXPECT_EQ(to_boolean(text), false) << text;
  for (const char* text : {"", "2", "tRue", "maybe"}) EXPECT_FALSE(to_boolean(text)) << text;
}

TEST(Scalars, MessagesKeepForeignLettersAndLoseControlCharacters) {
  EXPECT_EQ(printable("Gr\xc3\xb6\xc3\x9f"
                      "e"),
            "Gr\xc3\xb6\xc3\x9f"
            "e");
  EXPECT_EQ(printable("a\x1b[31m\n"), "a?[31m?");
  EXPECT_EQ(printable("\xff\xc3"), "??");
  EXPECT_EQ(printable("\xc2\x9b"
                      "1"),
            "??1");
  EXPECT_EQ(printable("abcdef", 3), "abc...");
}

}  // namespace
}  // namespace ambf::adf
