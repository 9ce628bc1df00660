// What is saved of damaged recordings: everything in intact bzip2 blocks, also behind the damage,
// and nothing that was not written.
#include "palpate/recording/dsa_recovery.h"

#include <cstdlib>
#include <random>

#include "palpate/core/error.h"
#include "palpate/recording/bzip2_blocks.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/recording_losses.h"

#include "recording/dsa_corpus.h"
#include "testing/testing.h"

namespace palpate::dsa_recovery_test {
namespace {

constexpr std::uint32_t kSeed = 11;
constexpr std::size_t kNumFrames = 150;
constexpr std::size_t kNumAngles = 400;

std::span<const std::byte> asBytes(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

// Text split into bzip2 blocks of at most 100 kB, as level 1 does.
const std::string& longText() {
  static const std::string text = testing::longXml(kNumFrames, kNumAngles, kSeed);
  return text;
}
const std::string& longPacked() {
  static const std::string packed = testing::compressed(longText(), 1);
  return packed;
}

// Whether frame n of the profile is the frame of longXml() that its stamp says.
void expectTrueFrames(const Profile& profile) {
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    const std::int64_t ms = profile.frameTimeUs(i) / 1000 - 1'400'000'000'000;
    ASSERT_EQ(ms % 32, 0);
    const auto original = static_cast<std::size_t>(ms / 32);
    ASSERT_LT(original, kNumFrames);
    const TactileFrame frame = profile.frame(i);
    for (std::size_t place = 0; place < frame.values.size(); ++place)
      ASSERT_EQ(frame.values[place], testing::longXmlValue(original, place, kSeed))
          << "frame " << original << ", place " << place;
  }
}

// Bytes of text that each block holds, in order, of an undamaged file.
std::vector<std::size_t> blockSizes(const std::string& packed) {
  std::vector<std::size_t> sizes;
  for (const Bzip2Block& block : findBzip2Blocks(asBytes(packed)))
    sizes.push_back(decodeBzip2Block(asBytes(packed), block, 1u << 20).bytes.size());
  return sizes;
}

// How many whole frames lie in the text when the range [from, to) is taken out.
std::size_t framesOutside(std::size_t from, std::size_t to) {
  const std::string& text = longText();
  std::size_t count = 0;
  for (std::size_t at = text.find("<frame index"); at != std::string::npos;
       at = text.find("<frame index", at + 1)) {
    const std::size_t end = text.find("</frame>", at) + std::string_view("</frame>").size();
    if (end <= from || at >= to) ++count;
  }
  return count;
}

TEST(DsaRecovery, savesAllOfASoundRecording) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "a.dsa", longPacked());
  const DsaRecovery saved = recoverDsaProfile(folder / "a.dsa");
  EXPECT_EQ(saved.frames, kNumFrames);
  EXPECT_EQ(saved.angles, kNumAngles);
  EXPECT_EQ(saved.cutSamples, 0u);
  EXPECT_EQ(saved.badSamples, 0u);
  EXPECT_EQ(saved.intactBlocks, saved.blocks);
  ASSERT_TRUE(saved.profile);
  EXPECT_EQ(saved.profile->info().serial, "0000ABCD");
  expectTrueFrames(*saved.profile);
}

TEST(DsaRecovery, savesAllWholeFramesBeforeAndBehindADamagedBlock) {
  const testing::TemporaryFolder folder;
  const std::vector<Bzip2Block> blocks = findBzip2Blocks(asBytes(longPacked()));
  const std::vector<std::size_t> sizes = blockSizes(longPacked());
  for (std::size_t hit = 1; hit + 1 < blocks.size(); ++hit) {
    std::string damaged = longPacked();
    const std::size_t byte =
        static_cast<std::size_t>((blocks[hit].beginBit + blocks[hit].endBit) / 16);
    damaged[byte] = static_cast<char>(damaged[byte] ^ 0x20);
    testing::writeFile(folder / "a.dsa", damaged);
    std::size_t from = 0;
    for (std::size_t i = 0; i < hit; ++i) from += sizes[i];
    const DsaRecovery saved = recoverDsaProfile(folder / "a.dsa");
    EXPECT_EQ(saved.frames, framesOutside(from, from + sizes[hit])) << hit;
    EXPECT_EQ(saved.intactBlocks, blocks.size() - 1);
    EXPECT_FALSE(saved.layoutAssumed);
    ASSERT_TRUE(saved.profile);
    expectTrueFrames(*saved.profile);

    const VerifyReport report = verifyRecording(folder / "a.dsa");
    EXPECT_EQ(report.state, VerifyReport::State::kDamaged);
    EXPECT_NE(report.message.find(std::to_string(saved.frames) + " frames"), std::string::npos);
  }
}

TEST(DsaRecovery, assumesTheHandWhenTheFirstBlockIsLost) {
  const testing::TemporaryFolder folder;
  const std::vector<std::size_t> sizes = blockSizes(longPacked());
  std::string damaged = longPacked();
  damaged[5000] = static_cast<char>(damaged[5000] ^ 4);
  testing::writeFile(folder / "a.dsa", damaged);
  const DsaRecovery saved = recoverDsaProfile(folder / "a.dsa");
  EXPECT_TRUE(saved.layoutAssumed);
  EXPECT_EQ(saved.frames, framesOutside(0, sizes[0]));
  EXPECT_EQ(saved.angles, kNumAngles);
  ASSERT_TRUE(saved.profile);
  expectTrueFrames(*saved.profile);
  EXPECT_NE(verifyRecording(folder / "a.dsa").message.find("SDH-2 is assumed"), std::string::npos);
}

// Frames are 32 ms apart, the first one at the time of the first angle (see longXml()).
TEST(DsaRecovery, saysWhichFramesAreLostBeforeTheFirstOne) {
  const testing::TemporaryFolder folder;
  std::string damaged = longPacked();
  damaged[5000] = static_cast<char>(damaged[5000] ^ 4);
  testing::writeFile(folder / "a.dsa", damaged);
  const DsaRecovery saved = recoverDsaProfile(folder / "a.dsa");
  ASSERT_TRUE(saved.profile);
  const std::int64_t firstUs = saved.profile->frameTimeUs(0);
  const std::int64_t beginUs = 1'400'000'000'000'000;
  const std::int64_t lost = (firstUs - beginUs) / 32'000;
  ASSERT_GT(lost, 0);
  ASSERT_EQ(saved.losses.size(), 1u);
  EXPECT_EQ(saved.losses[0].kind, "gap");
  EXPECT_EQ(saved.losses[0].tUs, beginUs);
  EXPECT_EQ(saved.losses[0].t1Us, firstUs);
  const std::string text = std::to_string(lost) + " frames before the first one that can be read";
  EXPECT_TRUE(saved.losses[0].text.starts_with(text)) << saved.losses[0].text;
  EXPECT_TRUE(saved.lossText.starts_with(text)) << saved.lossText;
  EXPECT_NE(saved.lossText.find("the joint angles begin "), std::string::npos);
  const Recording readable = readableRecording(folder / "a.dsa");
  EXPECT_NE(readable.damage.text.find(text), std::string::npos);
  EXPECT_EQ(readable.events, saved.losses) << "drawn in the timeline";
  EXPECT_EQ(readable.damage.notInFile, saved.losses);
  EXPECT_NE(verifyRecording(folder / "a.dsa").message.find(text), std::string::npos);

  recoverRecording(folder / "a.dsa", folder / "saved.palpate", Overwrite::kRefuse);
  const std::vector<RecordingLoss> losses =
      lossesOf(readableRecording(folder / "saved.palpate").events);
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_EQ(losses[0].stream, "tactile");
  EXPECT_TRUE(losses[0].counted);
  EXPECT_EQ(losses[0].lost, static_cast<std::uint64_t>(lost));
  EXPECT_NEAR(losses[0].seconds, static_cast<double>(firstUs - beginUs) / 1e6, 1e-9);
}

TEST(DsaRecovery, tellsTheFramesLostBetweenOthers) {
  std::string damaged = longPacked();
  const Bzip2Block block = findBzip2Blocks(asBytes(damaged)).at(1);
  const auto byte = static_cast<std::size_t>((block.beginBit + block.endBit) / 16);
  damaged[byte] = static_cast<char>(damaged[byte] ^ 0x20);
  const DsaRecovery saved = recoverDsaProfileBytes(asBytes(damaged), "a.dsa");
  ASSERT_EQ(saved.losses.size(), 1u) << saved.lossText;
  const std::vector<RecordingLoss> losses = lossesOf(saved.losses);
  EXPECT_EQ(losses.at(0).lost, kNumFrames - saved.frames);
  EXPECT_EQ(saved.losses[0].t1Us - saved.losses[0].tUs,
            static_cast<std::int64_t>(kNumFrames - saved.frames + 1) * 32'000);
  EXPECT_TRUE(saved.lossText.starts_with("lost between them: ")) << saved.lossText;
}

// The number of a frame is damaged, too: no loss follows from it.
TEST(DsaRecovery, aDamagedNumberIsNoLoss) {
  const std::string cut = longText().substr(0, longText().rfind("<frame index"));
  for (const char* number : {"9000", "9223372036854775807", "-9223372036854775808"}) {
    const std::string damaged = testing::replaced(
        cut, "<frame index=\"50\"", "<frame index=\"" + std::string(number) + "\"");
    const DsaRecovery saved = recoverDsaProfileBytes(asBytes(damaged), "a.dsa");
    EXPECT_EQ(saved.frames, kNumFrames - 1) << number;
    for (const RecordingLoss& loss : lossesOf(saved.losses)) EXPECT_EQ(loss.lost, 0u) << number;
    EXPECT_EQ(saved.lossText.find("between"), std::string::npos) << saved.lossText;
  }
}

TEST(DsaRecovery, nothingIsSaidToBeLostOfASoundFile) {
  EXPECT_TRUE(recoverDsaProfileBytes(asBytes(longPacked()), "a.dsa").losses.empty());
}

TEST(DsaRecovery, savesNothingOfALostLayoutThatIsNotTheHands) {
  const testing::TemporaryFolder folder;
  std::vector<std::string> frames;
  for (int i = 0; i < 4000; ++i) {
    std::string text;
    for (int k = 0; k < 6; ++k)
      text += "42" + std::to_string(1000 + (i * 7919 + k * 104729) % 9000) + "00";
    frames.push_back(text);
  }
  std::string packed = testing::compressed(testing::framesXml(2, 3, frames), 1);
  ASSERT_GE(findBzip2Blocks(asBytes(packed)).size(), 3u);
  packed[2000] = static_cast<char>(packed[2000] ^ 4);
  testing::writeFile(folder / "a.dsa", packed);
  const DsaRecovery saved = recoverDsaProfile(folder / "a.dsa");
  EXPECT_FALSE(saved.profile);
  EXPECT_EQ(saved.frames, 0u);
  EXPECT_GT(saved.badSamples, 0u);
  EXPECT_EQ(verifyRecording(folder / "a.dsa").state, VerifyReport::State::kUnreadable);
}

TEST(DsaRecovery, aCutFileKeepsItsWholeBlocks) {
  const testing::TemporaryFolder folder;
  const std::vector<Bzip2Block> blocks = findBzip2Blocks(asBytes(longPacked()));
  const std::vector<std::size_t> sizes = blockSizes(longPacked());
  for (std::size_t whole = 0; whole + 1 < blocks.size(); ++whole) {
    // Cut in the middle of block number `whole`: those before it are whole, but the last one's end
    // is known by the mark that follows.
    const auto size =
        static_cast<std::size_t>((blocks[whole].beginBit + blocks[whole].endBit) / 16);
    testing::writeFile(folder / "a.dsa", longPacked().substr(0, size));
    std::size_t textBytes = 0;
    for (std::size_t i = 0; i < whole; ++i) textBytes += sizes[i];
    const DsaRecovery saved = recoverDsaProfile(folder / "a.dsa");
    EXPECT_EQ(saved.intactBlocks, whole);
    EXPECT_EQ(saved.frames, framesOutside(textBytes, longText().size())) << whole;
    EXPECT_EQ(verifyRecording(folder / "a.dsa").state,
              whole == 0 ? VerifyReport::State::kUnreadable : VerifyReport::State::kDamaged);
  }
}

TEST(DsaRecovery, cutPlainXmlKeepsTheFramesBeforeTheCut) {
  const testing::TemporaryFolder folder;
  const std::string text = testing::exampleXml();
  testing::writeFile(folder / "a.dsa", text.substr(0, text.find("447A0000")));
  const DsaRecovery saved = recoverDsaProfile(folder / "a.dsa");
  EXPECT_EQ(saved.frames, 1u);
  EXPECT_EQ(saved.cutSamples, 1u);
  const VerifyReport report = verifyRecording(folder / "a.dsa");
  EXPECT_EQ(report.state, VerifyReport::State::kDamaged);
  EXPECT_NE(report.message.find("1 frame,"), std::string::npos) << report.message;
}

TEST(DsaRecovery, oneWrongFrameHarmsNoOther) {
  const testing::TemporaryFolder folder;
  testing::writeFile(
      folder / "a.dsa",
      testing::compressed(testing::replaced(testing::exampleXml(), "C0C00000", "C9742400")));
  const DsaRecovery saved = recoverDsaProfile(folder / "a.dsa");
  EXPECT_EQ(saved.frames, 1u);
  EXPECT_EQ(saved.badSamples, 1u);
  EXPECT_EQ(saved.angles, 1u);
  EXPECT_EQ(saved.temperatures, 1u);
}

// Reliability table, R5, short form: whatever happens to a file, no frame is shown that was not
// written, and the blocks that were not touched give all their frames.
// 60 files in the fast suite; the slow one asks for 10,000.
int numDamagedFiles() {
  const char* asked = std::getenv("PALPATE_DAMAGED_FILES");
  return asked ? std::atoi(asked) : 60;
}

TEST(DsaRecovery, neverShowsAWrongValue) {
  const testing::TemporaryFolder folder;
  std::mt19937 random(5);
  for (int round = 0; round < numDamagedFiles(); ++round) {
    std::string damaged = longPacked();
    const int flips = 1 + static_cast<int>(random() % (round % 2 == 0 ? 3 : 100));
    for (int i = 0; i < flips; ++i)
      damaged[4 + random() % (damaged.size() - 4)] = static_cast<char>(random());
    if (round % 4 == 0) damaged.resize(random() % damaged.size());
    testing::writeFile(folder / "a.dsa", damaged);
    try {
      const DsaRecovery saved = recoverDsaProfile(folder / "a.dsa");
      if (saved.profile) expectTrueFrames(*saved.profile);
    } catch (const FormatError&) {  // not even the first bytes are left
    }
  }
}

}  // namespace
}  // namespace palpate::dsa_recovery_test
