#include "palpate/model/frame_coding.h"

#include <random>
#include <stdexcept>

#include "testing/testing.h"

namespace palpate::frame_coding_test {
namespace {

std::vector<std::byte> encoded(const std::vector<float>& values, FrameCoding coding) {
  std::vector<std::byte> bytes;
  encodeFrame(values, coding, bytes);
  return bytes;
}

TEST(FrameCoding, CountsAreUnitsOfRunAndValue) {
  // 17 zeros = runs of 15 and 2; then 100 once. 15 << 12 | 0, 2 << 12 | 0, 1 << 12 | 100.
  std::vector<float> values(17, 0.0F);
  values.push_back(100.0F);
  const std::vector<std::byte> expected = {std::byte{0x00},
                                           std::byte{0xF0},
                                           std::byte{0x00},
                                           std::byte{0x20},
                                           std::byte{0x64},
                                           std::byte{0x10}};
  EXPECT_EQ(encoded(values, FrameCoding::kCounts), expected);
}

TEST(FrameCoding, RandomFramesComeBack) {
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    std::vector<float> values(486);
    const bool counts = round % 2 == 0;
    for (float& value : values) {
      const auto draw = random() % 4096;
      value = random() % 3 ? 0.0F : static_cast<float>(draw);
      if (!counts && random() % 5 == 0) value = static_cast<float>(draw) * 0.37F - 500.0F;
    }
    const FrameCoding coding = codingFor(values);
    auto bytes = encoded(values, coding);
    const std::size_t size = bytes.size();
    bytes.push_back(std::byte{0x55});  // what follows is not touched
    std::vector<float> back(486);
    EXPECT_EQ(decodeFrame(bytes, coding, back), size);
    EXPECT_EQ(back, values);
  }
}

TEST(FrameCoding, ChoosesFloatsOnlyWhereItMust) {
  EXPECT_EQ(codingFor(std::vector<float>{0.0F, 4095.0F}), FrameCoding::kCounts);
  EXPECT_EQ(codingFor(std::vector<float>{0.5F}), FrameCoding::kFloats);
  EXPECT_EQ(codingFor(std::vector<float>{4096.0F}), FrameCoding::kFloats);
  EXPECT_EQ(codingFor(std::vector<float>{-1.0F}), FrameCoding::kFloats);
  std::vector<std::byte> out;
  EXPECT_THROW(encodeFrame(std::vector<float>{0.5F}, FrameCoding::kCounts, out),
               std::invalid_argument);
}

TEST(FrameCoding, DamagedBytesAreRefused) {
  const std::vector<float> values(486, 3.0F);
  for (FrameCoding coding : {FrameCoding::kCounts, FrameCoding::kFloats}) {
    const auto bytes = encoded(values, coding);
    std::vector<float> back(486);
    for (std::size_t cut = 0; cut < bytes.size(); ++cut)
      EXPECT_EQ(decodeFrame(std::span(bytes).first(cut), coding, back), 0u);
    auto zeroRun = bytes;
    zeroRun[coding == FrameCoding::kCounts ? 1 : 0] = std::byte{0};
    EXPECT_EQ(decodeFrame(zeroRun, coding, back), 0u);
    std::vector<float> fewer(485);  // a run that reaches beyond the frame
    EXPECT_EQ(decodeFrame(bytes, coding, fewer), 0u);
  }
}

}  // namespace
}  // namespace palpate::frame_coding_test
