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

}  // namespace
}  // namespace palpate::utf8_test
