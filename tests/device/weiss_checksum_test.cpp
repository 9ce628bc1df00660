#include "palpate/device/weiss_checksum.h"

#include <vector>

#include <gtest/gtest.h>

namespace palpate::weiss_checksum_test {
namespace {

std::uint16_t of(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
  return weissChecksum(bytes);
}

// Test vectors of the protocol document, and packets recorded on the wire.
TEST(WeissChecksum, AgreesWithThePublishedVectors) {
  EXPECT_EQ(of({}), 0xFFFF);
  EXPECT_EQ(of({0x00}), 0x1E0F);
  EXPECT_EQ(of({0xFF}), 0x00FF);
  EXPECT_EQ(of({1, 2, 3, 4}), 0x74AB);
  EXPECT_EQ(of({'1', '2', '3', '4', '5', '6', '7', '8', '9'}), 0x6EB4);
  EXPECT_EQ(of({0x03, 0x03, 0x00, 0x01, 0x00, 0x00}), 0x6A2F);
  EXPECT_EQ(of({0x03, 0x02, 0x00, 0x00, 0x00}), 0xB94B);
  EXPECT_EQ(of({0x83, 0x03, 0x00}), 0x1EDC);
}

TEST(WeissChecksum, GoesOnFromASeed) {
  const std::vector<std::byte> all = {std::byte{9}, std::byte{200}, std::byte{0}, std::byte{77}};
  const std::span<const std::byte> bytes(all);
  EXPECT_EQ(weissChecksum(bytes.subspan(2), weissChecksum(bytes.first(2))), weissChecksum(bytes));
}

// Processing several bytes at a time gives the same result as bit by bit (the textbook form, from
// the polynomial alone).
TEST(WeissChecksum, EqualsTheBitwiseFormAtEveryLength) {
  std::vector<std::byte> bytes;
  std::uint16_t bitwise = 0xFFFF;
  unsigned random = 12345;
  for (int length = 0; length <= 1000; ++length) {
    ASSERT_EQ(weissChecksum(bytes), bitwise) << length;
    random = random * 1664525u + 1013904223u;
    const unsigned byte = random >> 24;
    bytes.push_back(static_cast<std::byte>(byte));
    unsigned remainder = ((bitwise ^ byte) & 0xFFu) << 8;
    for (int bit = 0; bit < 8; ++bit)
      remainder = ((remainder << 1) ^ ((remainder & 0x8000u) != 0 ? 0x1021u : 0u)) & 0xFFFFu;
    bitwise = static_cast<std::uint16_t>(bitwise >> 8 ^ remainder);
  }
}

}  // namespace
}  // namespace palpate::weiss_checksum_test
