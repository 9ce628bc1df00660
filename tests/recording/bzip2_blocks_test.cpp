// Finding and decoding single bzip2 blocks, in whole and in damaged data.
#include "palpate/recording/bzip2_blocks.h"

#include <set>
#include <string>

#include "recording/dsa_corpus.h"
#include "testing/testing.h"

namespace palpate::bzip2_blocks_test {
namespace {

std::span<const std::byte> asBytes(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

// Text split into bzip2 blocks of at most 100 kB, as level 1 does.
const std::string& longText() {
  static const std::string text = testing::longXml(150, 400, 11);
  return text;
}
const std::string& longPacked() {
  static const std::string packed = testing::compressed(longText(), 1);
  return packed;
}

TEST(Bzip2Blocks, areFoundAtAnyBitAndDecodeByThemselves) {
  std::string text;
  const std::vector<Bzip2Block> blocks = findBzip2Blocks(asBytes(longPacked()));
  ASSERT_GE(blocks.size(), 5u);
  std::set<std::uint64_t> places;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Bzip2BlockContent content = decodeBzip2Block(asBytes(longPacked()), blocks[i], 1u << 20);
    EXPECT_TRUE(content.intact);
    EXPECT_TRUE(content.endsAtMark);
    text.append(content.bytes.begin(), content.bytes.end());
    places.insert(blocks[i].beginBit % 8);
    if (i > 0) {
      EXPECT_EQ(blocks[i].beginBit, blocks[i - 1].endBit);
    }
  }
  EXPECT_EQ(blocks.front().beginBit, 32u);  // behind "BZh1"
  EXPECT_GE(places.size(), 3u);             // not only whole bytes
  EXPECT_EQ(text, longText());
}

TEST(Bzip2Blocks, aFlippedBitHarmsItsOwnBlockOnly) {
  const std::vector<Bzip2Block> blocks = findBzip2Blocks(asBytes(longPacked()));
  std::string damaged = longPacked();
  const std::size_t byte = static_cast<std::size_t>((blocks[2].beginBit + blocks[2].endBit) / 16);
  damaged[byte] = static_cast<char>(damaged[byte] ^ 1);
  const std::vector<Bzip2Block> found = findBzip2Blocks(asBytes(damaged));
  ASSERT_EQ(found.size(), blocks.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_EQ(decodeBzip2Block(asBytes(damaged), found[i], 1u << 20).intact, i != 2) << i;
}

TEST(Bzip2Blocks, aBlockBeforeADamagedMarkIsStillWhole) {
  const std::vector<Bzip2Block> blocks = findBzip2Blocks(asBytes(longPacked()));
  std::string damaged = longPacked();
  const std::size_t byte = static_cast<std::size_t>(blocks[3].beginBit / 8 + 2);  // of its mark
  damaged[byte] = static_cast<char>(damaged[byte] ^ 0x18);
  const std::vector<Bzip2Block> found = findBzip2Blocks(asBytes(damaged));
  ASSERT_EQ(found.size(), blocks.size() - 1);
  const Bzip2BlockContent content = decodeBzip2Block(asBytes(damaged), found[2], 1u << 20);
  EXPECT_TRUE(content.intact);
  EXPECT_FALSE(content.endsAtMark);
}

TEST(Bzip2Blocks, areNotFoundWhereThereAreNone) {
  EXPECT_TRUE(findBzip2Blocks({}).empty());
  EXPECT_TRUE(findBzip2Blocks(asBytes("BZh9 and no mark")).empty());
  EXPECT_TRUE(findBzip2Blocks(asBytes(testing::compressed(""))).empty());
}

TEST(Bzip2Blocks, aMarkWithNothingBehindIsNoBlock) {
  const std::string mark = "\x31\x41\x59\x26\x53\x59";  // pi, as bzip2 writes it
  const std::vector<Bzip2Block> found = findBzip2Blocks(asBytes(mark));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(decodeBzip2Block(asBytes(mark), found[0], 1u << 20).intact);
}

TEST(Bzip2Blocks, expandNoFartherThanAllowed) {
  const std::string packed = testing::compressed(std::string(10u << 20, ' '));
  const std::vector<Bzip2Block> found = findBzip2Blocks(asBytes(packed));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(decodeBzip2Block(asBytes(packed), found[0], 10u << 20).intact);
  EXPECT_FALSE(decodeBzip2Block(asBytes(packed), found[0], 1u << 20).intact);
}

}  // namespace
}  // namespace palpate::bzip2_blocks_test
