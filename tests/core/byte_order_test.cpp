#include "palpate/core/byte_order.h"

#include <array>

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

}  // namespace
}  // namespace palpate::byte_order_test
