#include "palpate/core/byte_order.h"

#include <array>

#include "palpate/core/byte_reader.h"

#include "testing/testing.h"

namespace palpate::byte_order_test {
namespace {

constexpr std::array kBytes = {std::byte{0xF1},
                               std::byte{0x02},
                               std::byte{0x03},
                               std::byte{0x04},
                               std::byte{0x05},
                               std::byte{0x06},
                               std::byte{0x07},
                               std::byte{0x88}};

TEST(ByteOrder, ReadsTheLowestByteFirst) {
  EXPECT_EQ(littleEndian(kBytes), 0x88070605040302F1);
  EXPECT_EQ(littleEndian(std::span(kBytes).first(2)), 0x02F1U);
  EXPECT_EQ(littleEndian(std::span(kBytes).last(1)), 0x88U);
}

TEST(ByteOrder, ReadsTheHighestByteFirst) {
  EXPECT_EQ(bigEndian(kBytes), 0xF102030405060788);
  EXPECT_EQ(bigEndian(std::span(kBytes).first(4)), 0xF1020304U);
}

TEST(ByteOrder, OfNoBytesIsZero) {
  EXPECT_EQ(littleEndian({}), 0U);
  EXPECT_EQ(bigEndian({}), 0U);
}

TEST(ByteWriter, PutsTheLowestByteFirst) {
  std::vector<std::byte> bytes;
  appendLittleEndian(bytes, 0x0102030405060708, 8);
  appendLittleEndian(bytes, 0xABCDEF, 2);  // its lowest two
  ByteReader in(bytes);
  EXPECT_EQ(in.u8(), 8);
  EXPECT_EQ(in.take(7).back(), std::byte{1});
  EXPECT_EQ(in.u16(), 0xCDEF);
  std::string text;
  appendLittleEndian(text, 0x6261, 2);
  EXPECT_EQ(text, "ab");
}

}  // namespace
}  // namespace palpate::byte_order_test
