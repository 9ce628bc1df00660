#include "palpate/core/byte_writer.h"

#include "palpate/core/byte_reader.h"

#include "testing/testing.h"

namespace palpate::byte_writer_test {
namespace {

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
}  // namespace palpate::byte_writer_test
