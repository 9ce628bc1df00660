// The run-length code of frames: the examples of docs/notes/dsa_format.md, and round trips.
#include "palpate/recording/frame_text.h"

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::frame_text_test {
namespace {

std::vector<float> decoded(std::string_view text, std::size_t numValues) {
  std::vector<float> values(numValues, -1.0F);
  FrameTextDecoder decoder;
  decoder.begin(values);
  decoder.add(text);
  decoder.finish();
  return values;
}

std::string errorOf(std::string_view text, std::size_t numValues) {
  try {
    decoded(text, numValues);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(FrameText, decodesTheExamplesOfTheFormat) {
  EXPECT_EQ(decoded("C3F30000", 486), std::vector<float>(486, 0.0F));
  EXPECT_EQ(decoded("BF800000", 1), std::vector<float>(1, 0.0F));
  EXPECT_EQ(decoded("C0000000 42C80000 BF800000 447A0000 BF800000", 6),
            (std::vector<float>{0, 0, 100, 0, 1000, 0}));
  EXPECT_EQ(decoded("", 0), std::vector<float>());
}

TEST(FrameText, whiteSpaceAndCaseMeanNothing) {
  const auto expected = decoded("C000000042C80000", 3);
  EXPECT_EQ(decoded("c000000042c80000", 3), expected);
  EXPECT_EQ(decoded("\r\n        C0000000\r\n\t42 C8 00 00  \r\n      ", 3), expected);
}

TEST(FrameText, decodesTheSameHoweverTheTextIsCut) {
  const std::string text = "\r\n  C0000000 42C80000 BF80\r\n0000 447A0000BF800000\r\n";
  for (std::size_t step = 1; step < text.size(); ++step) {
    std::vector<float> values(6);
    FrameTextDecoder decoder;
    decoder.begin(values);
    for (std::size_t at = 0; at < text.size(); at += step)
      decoder.add(std::string_view(text).substr(at, step));
    decoder.finish();
    EXPECT_EQ(values, (std::vector<float>{0, 0, 100, 0, 1000, 0})) << step;
    EXPECT_EQ(decoder.numTokens(), 5u);
  }
}

TEST(FrameText, fractionalAndZeroValuesAreValues) {
  EXPECT_EQ(decoded("4537D2E1", 1)[0], 0x1.6fa5c2p+11F);  // 2941.18, as in the synthetic recording
  EXPECT_EQ(decoded("0000000000000000", 2), std::vector<float>(2, 0.0F));
  const float negativeZero = decoded("80000000", 1)[0];  // no run: a value of 0
  EXPECT_EQ(negativeZero, 0.0F);
  EXPECT_FALSE(std::signbit(negativeZero));
}

TEST(FrameText, refusesWhatDoesNotFit) {
  EXPECT_EQ(errorOf("C3F30000", 485), "a run of 486 zeros does not fit (0 of 485 values so far)");
  EXPECT_EQ(errorOf("42C80000 C9742400", 486),
            "a run of 1000000 zeros does not fit (1 of 486 values so far)");
  EXPECT_EQ(errorOf("C0200000", 6),
            "a run of 2.5 zeros is not a whole number (0 of 6 values so far)");
  EXPECT_EQ(errorOf("80000001", 6).substr(0, 8), "a run of");  // the smallest negative number
  EXPECT_EQ(errorOf("42C80000 42C80000", 1), "more than 1 values");
  EXPECT_EQ(errorOf("42C80000", 2), "only 1 of 2 values");
  EXPECT_NE(errorOf("7FC00000", 1), "");
  EXPECT_NE(errorOf("FF800000", 1), "");
  EXPECT_NE(errorOf("42C8", 1), "");
  EXPECT_NE(errorOf("42C8000x", 1).find("'x'"), std::string::npos);
  EXPECT_NE(errorOf(std::string("42C8") + std::string(1, '\0'), 1).find("code 0"),
            std::string::npos);
}

TEST(FrameText, writesLongestRunsAndSevenTokensALine) {
  std::string text;
  appendFrameText(std::vector<float>{0, 0, 100, 0, 1000, 0}, 7, "", "", text);
  EXPECT_EQ(text, "C000000042C80000BF800000447A0000BF800000");
  text.clear();
  appendFrameText(std::vector<float>(486, 0.0F), 7, "  ", "\r\n", text);
  EXPECT_EQ(text, "  C3F30000\r\n");
  text.clear();
  appendFrameText(std::vector<float>(8, 1.0F), 7, "_", ";", text);
  EXPECT_EQ(text,
            "_3F8000003F8000003F8000003F8000003F8000003F8000003F800000;"
            "_3F800000;");
}

TEST(FrameText, refusesToWriteWhatWouldReadAsSomethingElse) {
  std::string text;
  EXPECT_THROW(appendFrameText(std::vector<float>{-1.0F}, 7, "", "", text), std::invalid_argument);
  EXPECT_THROW(appendFrameText(std::vector<float>{std::nanf("")}, 7, "", "", text),
               std::invalid_argument);
  EXPECT_THROW(appendFrameText(std::vector<float>{HUGE_VALF}, 7, "", "", text),
               std::invalid_argument);
}

TEST(FrameText, whatIsWrittenIsReadBack) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<float> values(1 + random() % 500);
    for (float& value : values)
      value = random() % 3 == 0 ? static_cast<float>(random() % 4096) / 8.0F : 0.0F;
    std::string text;
    appendFrameText(values, 7, "        ", "\r\n", text);
    EXPECT_EQ(decoded(text, values.size()), values);
  }
}

}  // namespace
}  // namespace palpate::frame_text_test
