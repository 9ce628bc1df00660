#include "palpate/core/number_text.h"

#include <array>
#include <clocale>

#include "testing/testing.h"

namespace palpate::number_text_test {
namespace {

TEST(NumberText, IsTheShortestThatReadsBack) {
  EXPECT_EQ(numberText(0.1), "0.1");
  EXPECT_EQ(numberText(3.0), "3");
  EXPECT_EQ(numberText(0.1F), "0.1");
  EXPECT_EQ(numberText(-2.5e-7), "-2.5e-07");
  for (double value : {1.0 / 3.0, 1e300, -4.9e-324, 0.849322, 1417170971302.0}) {
    const std::string text = numberText(value);
    EXPECT_EQ(parseDouble(text), value) << text;
  }
}

TEST(NumberText, FixedDecimalsHaveNoNegativeZero) {
  EXPECT_EQ(fixedText(3.14159, 2), "3.14");
  EXPECT_EQ(fixedText(-0.001, 2), "0.00");
  EXPECT_EQ(fixedText(-0.01, 2), "-0.01");
  EXPECT_EQ(fixedText(2.0, 0), "2");
}

TEST(NumberText, ParsesWholeTextsOnly) {
  EXPECT_EQ(parseDouble(" 1.5\r\n"), 1.5);
  EXPECT_EQ(parseDouble("1e3"), 1000.0);
  EXPECT_EQ(parseInteger("-42"), -42);
  EXPECT_EQ(parseInteger("9223372036854775807"), INT64_MAX);
  for (const char* bad :
       {"", " ", "1.5x", "1,5", "0x10", "nan", "inf", "-inf", "1e999", "+1", "1 2"})
    EXPECT_EQ(parseDouble(bad), std::nullopt) << bad;
  for (const char* bad : {"", "1.0", "9223372036854775808", "--1", "1e3"})
    EXPECT_EQ(parseInteger(bad), std::nullopt) << bad;
}

TEST(NumberText, IsTheSameInEveryLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  // Where the locale is not installed nothing changes, and the test still holds.
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(numberText(1.5), "1.5");
  EXPECT_EQ(fixedText(1.5, 1), "1.5");
  EXPECT_EQ(parseDouble("1.5"), 1.5);
  std::setlocale(LC_ALL, before.c_str());
}

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
}  // namespace palpate::number_text_test
