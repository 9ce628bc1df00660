#include "palpate/core/byte_reader.h"

#include <array>

#include "testing/testing.h"

namespace palpate::byte_reader_test {
namespace {

template <typename... Values>
std::array<std::byte, sizeof...(Values)> bytes(Values... values) {
  return {static_cast<std::byte>(values)...};
}

TEST(ByteReader, ReadsLittleEndianNumbers) {
  const auto data = bytes(0x01, 0x34, 0x12, 0x78, 0x56, 0x34, 0x12);
  ByteReader in(data);
  EXPECT_EQ(in.u8(), 0x01);
  EXPECT_EQ(in.u16(), 0x1234);
  EXPECT_EQ(in.u32(), 0x12345678u);
  EXPECT_EQ(in.remaining(), 0u);
  EXPECT_TRUE(in.ok());
}

TEST(ByteReader, ReadsIeeeFloats) {
  // 1.5f = 0x3FC00000; -2.0 = 0xC000000000000000
  const auto data = bytes(0x00, 0x00, 0xC0, 0x3F, 0, 0, 0, 0, 0, 0, 0, 0xC0);
  ByteReader in(data);
  EXPECT_EQ(in.f32(), 1.5F);
  EXPECT_EQ(in.f64(), -2.0);
}

TEST(ByteReader, NeverReadsPastTheEndAndStaysFailed) {
  const auto data = bytes(0xFF, 0xFF, 0xFF);
  ByteReader in(data);
  EXPECT_EQ(in.u32(), 0u);
  EXPECT_FALSE(in.ok());
  EXPECT_EQ(in.u8(), 0);  // a byte is left, but a failed reader gives nothing more
  EXPECT_FALSE(in.ok());
}

TEST(ByteReader, TakesSpansAndRefusesHugeCounts) {
  const auto data = bytes(1, 2, 3);
  ByteReader in(data);
  EXPECT_EQ(in.take(2).size(), 2u);
  EXPECT_EQ(in.position(), 2u);
  EXPECT_TRUE(in.take(SIZE_MAX).empty());
  EXPECT_FALSE(in.ok());
}

}  // namespace
}  // namespace palpate::byte_reader_test
