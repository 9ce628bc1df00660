#include "palpate/device/weiss_checksum.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpate {
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

}  // namespace
}  // namespace palpate
