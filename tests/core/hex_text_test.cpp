#include "palpate/core/hex_text.h"

#include <array>

#include "testing/testing.h"

namespace palpate::hex_text_test {
namespace {

TEST(HexText, WritesTheLowestDigitsHighestFirst) {
  EXPECT_EQ(hexDigits(0x1234ABCD, 8), "1234ABCD");
  EXPECT_EQ(hexDigits(0x1234ABCD, 4), "ABCD");
  EXPECT_EQ(hexDigits(0xF, 2), "0F");
  EXPECT_EQ(hexDigits(0xFEDCBA9876543210, 16), "FEDCBA9876543210");
}

TEST(HexText, WritesTwoDigitsPerByte) {
  constexpr std::array bytes = {std::byte{0x28}, std::byte{0xFF}, std::byte{0x00}, std::byte{0xAB}};
  EXPECT_EQ(hexDigits(bytes), "28FF00AB");
  EXPECT_EQ(hexDigits(bytes, HexLetters::kSmall), "28ff00ab");
  EXPECT_EQ(hexDigits(std::span<const std::byte>()), "");
}

TEST(HexText, AppendsInSmallLetters) {
  std::string text = "\\u";
  appendHexDigits(text, 0xE9, 4, HexLetters::kSmall);
  EXPECT_EQ(text, "\\u00e9");
}

}  // namespace
}  // namespace palpate::hex_text_test
