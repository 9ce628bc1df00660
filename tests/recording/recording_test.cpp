// Opening and checking recordings whatever their form, and what they say of themselves.
#include "palpate/recording/recording.h"

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/recording/dsa_reader.h"

#include "recording/dsa_corpus.h"
#include "recording/palpate_samples.h"
#include "testing/testing.h"

namespace palpate::recording_test {
namespace {

TEST(Verify, countsASoundRecording) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "a.dsa", testing::compressed(testing::exampleXml()));
  const VerifyReport report = verifyRecording(folder / "a.dsa");
  EXPECT_EQ(report.state, VerifyReport::State::kSound);
  EXPECT_EQ(report.message, "2 frames, 1 angle sample, 1 temperature sample");
  const DsaVerifyReport dsa = verifyDsa(folder / "a.dsa");
  EXPECT_EQ(dsa.frames, 2u);
  EXPECT_EQ(dsa.message, "");
}

TEST(Verify, stopsWhenAsked) {
  const testing::TemporaryFolder folder;
  std::string damaged = testing::compressed(testing::longXml(60, 0, 11), 1);
  damaged[5000] = static_cast<char>(damaged[5000] ^ 4);  // in the first of several blocks
  testing::writeFile(folder / "a.dsa", damaged);
  EXPECT_THROW(verifyRecording(folder / "a.dsa", [](double) { return false; }), Cancelled);
  EXPECT_THROW(verifyRecording(folder / "a.dsa", [](double f) { return f < 0.5; }), Cancelled);
}

TEST(Recording, isToldByItsFirstBytesNotByItsName) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "recording.txt", testing::compressed(testing::exampleXml()));
  EXPECT_EQ(openRecording(folder / "recording.txt").numFrames(), 2u);
  testing::writeFile(folder / "native.dsa", std::string("SQLite format 3\0", 16) + "rest");
  try {
    openRecording(folder / "native.dsa");
    FAIL();
  } catch (const FormatError& error) {
    EXPECT_NE(std::string(error.what()).find("native.dsa"), std::string::npos);
  }
  EXPECT_EQ(verifyRecording(folder / "native.dsa").state, VerifyReport::State::kUnreadable);
}

TEST(RecordingMeta, IsWhatTheWriterWasGiven) {
  const testing::TemporaryFolder folder;
  PalpateWriterOptions options;
  options.synced = false;
  const std::string settings = R"([{"sensitivity":0.5,"threshold_counts":150}])";
  PalpateWriter writer(
      folder / "a.palpate", sdh2().layout, {{"settings", settings}, {"operator", "Ada"}}, options);
  testing::addSamples(writer, 0, 5);
  writer.commit();
  EXPECT_EQ(readRecordingMeta(folder / "a.palpate").at("settings"), settings) << "being written";
  writer.finish();
  const auto meta = readRecordingMeta(folder / "a.palpate");
  EXPECT_EQ(meta.at("settings"), settings);
  EXPECT_EQ(meta.at("operator"), "Ada");
}

TEST(RecordingMeta, OfADsaThereIsNone) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "a.dsa", "<?xml version=\"1.0\"?><measurement/>");
  EXPECT_TRUE(readRecordingMeta(folder / "a.dsa").empty());
}

TEST(RecordingMeta, NoFileOrADamagedOneIsSaid) {
  const testing::TemporaryFolder folder;
  EXPECT_THROW(readRecordingMeta(folder / "none.palpate"), FileError);
  testing::writeFile(folder / "broken.palpate",
                     std::string("SQLite format 3\0", 16) + std::string(200, 'x'));
  EXPECT_THROW(readRecordingMeta(folder / "broken.palpate"), Error);
}

}  // namespace
}  // namespace palpate::recording_test
