#include "palpate/core/utf8.h"

#include <gtest/gtest.h>

namespace palpate::utf8_test {
namespace {

TEST(Utf8, IsToldFromOtherBytes) {
  for (const char* text : {"", "a", "\xC3\xBC", "\xE2\x82\xAC", "\xF0\x9F\x98\x80"})
    EXPECT_TRUE(isUtf8(text)) << text;
  // A byte that continues nothing, a cut character, an overlong one, a surrogate, Latin-1.
  for (const char* text : {"\x92", "a\xC3", "\xC0\x80", "\xED\xA0\x80", "gr\xFC\xDF"})
    EXPECT_FALSE(isUtf8(text)) << text;
}

TEST(Utf8, GivesItsCharacters) {
  EXPECT_EQ(codePointsOf("a\xC3\xBC\xE2\x82\xAC\xF0\x9F\x98\x80"), U"a\u00FC\u20AC\U0001F600");
  EXPECT_EQ(codePointsOf("\xF4\x8F\xBF\xBF"), std::u32string(1, 0x10FFFF));
  // A cut character, a byte that continues nothing, an overlong one, a surrogate, one too large.
  EXPECT_EQ(codePointsOf("\xE2\x82(\x92"), U"\uFFFD(\uFFFD");
  EXPECT_EQ(codePointsOf("\xE0\x80\x80\xED\xA0\x80\xF4\x90\x80\x80"), U"\uFFFD\uFFFD\uFFFD");
}

}  // namespace
}  // namespace palpate::utf8_test
