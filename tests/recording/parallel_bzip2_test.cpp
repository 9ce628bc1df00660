// Decompression on several threads: the same profiles, and word for word the same messages, as on
// the caller's thread alone, whatever the data.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/recording/bzip2_blocks.h"
#include "palpate/recording/dsa_reader.h"

#include "recording/dsa_corpus.h"
#include "testing/process_facts.h"
#include "testing/testing.h"

namespace palpate::parallel_bzip2_test {
namespace {

using testing::compressed;

std::span<const std::byte> bytesOf(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

DsaReadOptions onThreads(std::size_t threads) {
  DsaReadOptions options;
  options.threads = threads;
  return options;
}

// Everything that reading told: samples and warnings, or the message.
std::string told(std::string_view bytes, std::size_t threads) {
  std::string out;
  try {
    const Profile profile = readDsaBytes(bytesOf(bytes), "test.dsa", onThreads(threads));
    TactileFrame frame;
    std::uint64_t hash = 1469598103934665603u;
    for (std::size_t i = 0; i < profile.numFrames(); ++i) {
      profile.readFrame(i, frame);
      hash = (hash ^ static_cast<std::uint64_t>(frame.hostUs)) * 1099511628211u;
      for (const float value : frame.values)
        hash = (hash ^ static_cast<std::uint64_t>(value)) * 1099511628211u;
    }
    out = std::to_string(profile.numFrames()) + " frames " + std::to_string(hash) + ", " +
          std::to_string(profile.numAngles()) + " angles";
    for (const std::string& warning : profile.info().warnings) out += "\n" + warning;
  } catch (const Error& error) {
    out = error.what();
  }
  return out;
}

// Reads with several numbers of threads, more than there are cores among them.
void expectTheSame(std::string_view bytes, const std::string& what) {
  const std::string alone = told(bytes, 1);
  for (const std::size_t threads : {0u, 3u, 64u})
    EXPECT_EQ(told(bytes, threads), alone) << what << ", " << threads << " threads";
}

const std::string& longText() {
  static const std::string text = testing::longXml(200, 40, 5);
  return text;
}

// Many blocks of 100 kB.
const std::string& manyBlocks() {
  static const std::string packed = compressed(longText(), 1);
  return packed;
}

TEST(ParallelBzip2, readsTheSameWhateverTheBlockSizeAndTheNumberOfThreads) {
  const std::string alone = told(longText(), 1);
  EXPECT_EQ(alone.substr(0, 10), "200 frames");
  for (const int level : {1, 2, 5, 9})
    for (const std::size_t threads : {0u, 1u, 2u, 64u})
      EXPECT_EQ(told(compressed(longText(), level), threads), alone) << level << " " << threads;
}

TEST(ParallelBzip2, readsSeveralStreamsInARow) {
  const std::string text = longText();
  const std::size_t half = text.size() / 2;
  expectTheSame(compressed(text.substr(0, half), 1) + compressed(text.substr(half), 5), "two");
  expectTheSame(compressed("") + compressed(text, 1) + compressed("") + compressed(""), "empty");
  std::string many;
  for (std::size_t at = 0; at < text.size(); at += 70'001)
    many += compressed(text.substr(at, 70'001), 1 + static_cast<int>(at % 9));
  expectTheSame(many, "many");
  EXPECT_EQ(told(many, 2), told(text, 1));
}

TEST(ParallelBzip2, givesTheSameMessagesForBytesBehindTheRecording) {
  for (const std::string behind : {"B", "BZ", "BZh", "BZh9", "BZh0", "x", "no bzip2 data at all"})
    expectTheSame(manyBlocks() + behind, behind);
  expectTheSame(manyBlocks() + std::string(100, '\0'), "zeros");
}

TEST(ParallelBzip2, givesTheSameMessagesForCutData) {
  const std::string& packed = manyBlocks();
  std::mt19937 random(7);
  for (int i = 0; i < 20; ++i) {
    const std::size_t size = random() % packed.size();
    expectTheSame(std::string_view(packed).substr(0, size), "cut at " + std::to_string(size));
  }
  for (std::size_t less = 1; less <= 16; ++less)
    expectTheSame(std::string_view(packed).substr(0, packed.size() - less),
                  "without the last " + std::to_string(less));
}

TEST(ParallelBzip2, givesTheSameMessagesForFlippedBits) {
  std::mt19937 random(11);
  const auto flipped = [&](std::size_t bit) {
    std::string packed = manyBlocks();
    packed[bit / 8] = static_cast<char>(packed[bit / 8] ^ 0x80 >> bit % 8);
    return packed;
  };
  for (int i = 0; i < 30; ++i) {
    const std::size_t bit = random() % (8 * manyBlocks().size());
    expectTheSame(flipped(bit), "bit " + std::to_string(bit));
  }
  // Headers, marks and checksums of blocks, and the checksum of the stream.
  const std::vector<Bzip2Block> blocks = findBzip2Blocks(bytesOf(manyBlocks()));
  ASSERT_GE(blocks.size(), 8u);
  for (const std::size_t block : {std::size_t{0}, std::size_t{3}, blocks.size() - 1})
    for (std::size_t bit = 0; bit < 80; bit += 9)
      expectTheSame(flipped(blocks[block].beginBit + bit),
                    "block " + std::to_string(block) + ", bit " + std::to_string(bit));
  for (std::size_t bit = 1; bit < 100; bit += 7)
    expectTheSame(flipped(8 * manyBlocks().size() - bit),
                  "bit " + std::to_string(bit) + " from the end");
  for (std::size_t bit = 0; bit < 32; bit += 3) expectTheSame(flipped(bit), "header");
}

TEST(ParallelBzip2, aBlockLargerThanTheHeaderAllowsIsDamageAsEver) {
  std::string packed = compressed(longText(), 9);
  packed[3] = '1';
  EXPECT_NE(told(packed, 1).find("is damaged near byte"), std::string::npos);
  expectTheSame(packed, "BZh1 with blocks of 900 kB");
}

// Text whose code holds the 48 bits of a mark: bzip2 stores which symbols occur as plain bits, so
// a set of characters can be chosen that gives them.
TEST(ParallelBzip2, bitsWithinABlockThatLookLikeAMarkDoNoHarm) {
  // The symbol map of a block: 16 bits that tell which groups of 16 characters occur, then 16 bits
  // for each of them. Three neighbouring groups hold the mark 0x314159265359.
  std::string text = testing::exampleXml();
  std::string odd;
  const std::uint16_t groups[3] = {0x3141, 0x5926, 0x5359};
  for (int group = 0; group < 3; ++group)
    for (int i = 0; i < 16; ++i)
      if (groups[group] >> (15 - i) & 1) odd += static_cast<char>(0x80 + 16 * group + i);
  // These characters alone in a block of their own, behind the document's text: not UTF-8, so the
  // message is that of the XML. The blocks before and behind it are regular.
  std::string alone;
  while (alone.size() < 2000) alone += odd;
  const std::string packed = compressed(alone);
  const std::vector<Bzip2Block> blocks = findBzip2Blocks(bytesOf(packed));
  ASSERT_EQ(blocks.size(), 2u) << "the false mark was not made";
  EXPECT_FALSE(decodeBzip2Block(bytesOf(packed), blocks[0], 1u << 20).intact);
  expectTheSame(packed, "alone");
  expectTheSame(compressed(text.substr(0, 200), 1) + packed + compressed(text.substr(200), 1),
                "within a document");
}

TEST(ParallelBzip2, aFileWithAFalseMarkIsRead) {
  // The same in a text that is a right document: characters of UTF-8 within a comment.
  std::string text = testing::exampleXml();
  // Which characters occur in a block is up to us: a block that holds only the continuation of a
  // comment, in characters from U+0080 on, has lead bytes C2..DF and continuation bytes 80..BF.
  // Groups 8 (0x80..), 9, A are 0x3141, 0x5926, 0x5359; lead bytes lie in group C, behind them.
  std::string comment;
  const std::uint16_t groups[3] = {0x3141, 0x5926, 0x5359};
  for (int group = 0; group < 3; ++group)
    for (int i = 0; i < 16; ++i)
      if (groups[group] >> (15 - i) & 1)
        comment += std::string("\xC3") + static_cast<char>(0x80 + 16 * group + i);
  std::string many;
  while (many.size() < 4000) many += comment;
  const std::size_t root = text.find("<root>") + 6;
  const std::string packed = compressed(text.substr(0, root) + "<!--") + compressed(many) +
                             compressed("-->" + text.substr(root));
  ASSERT_EQ(findBzip2Blocks(bytesOf(packed)).size(), 4u) << "the false mark was not made";
  EXPECT_EQ(told(packed, 1).substr(0, 8), "2 frames") << told(packed, 1);
  expectTheSame(packed, "false mark");
}

TEST(ParallelBzip2, expandsNoFartherThanAllowed) {
  std::string packed;
  for (int i = 0; i < 4; ++i) packed += compressed(std::string(20u << 20, ' '));
  expectTheSame(packed, "blanks");
  EXPECT_NE(told("BZh9" + packed, 1), told(packed, 1));
}

TEST(ParallelBzip2, textBeyondTheLargestPiecesIsReadInOrder) {
  // A block of 3 MB of text: more than the threads keep.
  std::string text = testing::exampleXml();
  text.insert(text.find("<data>"), std::string(3u << 20, ' '));
  const std::string packed = compressed(text) + compressed("");
  EXPECT_EQ(told(packed + compressed(" "), 2).substr(0, 8), "2 frames");
  expectTheSame(packed + compressed(" "), "long blanks");
}

TEST(ParallelBzip2, aFileThatShrinksWhileItIsReadIsCut) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path path = folder / "long.dsa";
  const std::string packed = compressed(testing::longXml(600, 0, 3), 1);
  for (const std::size_t size : {packed.size() / 2, std::size_t{70'000}, std::size_t{0}}) {
    testing::writeFile(path, packed);
    int calls = 0;
    const auto shrink = [&](double) {
      if (++calls == 2) std::filesystem::resize_file(path, size);
      return true;
    };
    try {
      readDsa(path, shrink, onThreads(2));
      // The threads were faster than the first report.
    } catch (const FormatError& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.find("its bzip2 data ends early, at byte") != std::string::npos ||
                  message.find("it was changed while it was read") != std::string::npos)
          << message;
    }
  }
}

TEST(ParallelBzip2, aFileThatIsReplacedWhileItIsReadIsNeverMixed) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path path = folder / "long.dsa";
  const std::string one = compressed(testing::longXml(1500, 0, 3), 1);
  const std::string other = compressed(testing::longXml(1500, 0, 4), 1);
  testing::writeFile(path, one);
  int calls = 0;
  const auto replace = [&](double) {
    if (++calls == 2) {
      const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
      EXPECT_EQ(::pwrite(descriptor, other.data(), other.size(), 0),
                static_cast<ssize_t>(other.size()));
      ::close(descriptor);
    }
    return true;
  };
  EXPECT_THROW(readDsa(path, replace, onThreads(2)), FormatError);
}

TEST(ParallelBzip2, stopsWhenAskedAndLeavesNoThread) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path path = folder / "long.dsa";
  testing::writeFile(path, compressed(testing::longXml(600, 0, 3), 1));
  const std::size_t before = testing::leastProcessFacts().threads;
  for (int stopAt = 1; stopAt < 6; ++stopAt) {
    int calls = 0;
    EXPECT_THROW(readDsa(
                     path, [&](double) { return ++calls < stopAt; }, onThreads(3)),
                 Cancelled);
    EXPECT_EQ(calls, stopAt);
    EXPECT_EQ(testing::leastProcessFacts().threads, before);
  }
  // Also while an irregular file is read again.
  std::string packed = testing::readFile(path);
  packed.resize(packed.size() - 3);
  testing::writeFile(path, packed);
  int calls = 0;
  EXPECT_THROW(readDsa(
                   path,
                   [&](double) {
                     ++calls;
                     return true;
                   },
                   onThreads(3)),
               FormatError);
  const int all = calls;
  for (int stopAt = 1; stopAt <= all; ++stopAt) {
    calls = 0;
    EXPECT_THROW(readDsa(
                     path, [&](double) { return ++calls < stopAt; }, onThreads(3)),
                 Cancelled);
    EXPECT_EQ(calls, stopAt);
  }
  EXPECT_EQ(testing::leastProcessFacts().threads, before);
}

TEST(ParallelBzip2, progressGrowsAlsoWhereAFileIsReadAgain) {
  std::string packed = compressed(testing::longXml(600, 0, 3), 1);
  packed.resize(packed.size() - 3);
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "cut.dsa", packed);
  std::vector<double> fractions;
  const auto note = [&](double fraction) {
    fractions.push_back(fraction);
    return true;
  };
  EXPECT_THROW(readDsa(folder / "cut.dsa", note, onThreads(2)), FormatError);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
}

}  // namespace
}  // namespace palpate::parallel_bzip2_test
