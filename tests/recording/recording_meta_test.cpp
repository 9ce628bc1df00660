// What a recording says of itself as a whole.
#include "palpate/recording/recording_meta.h"

#include "palpate/core/error.h"
#include "palpate/recording/recording.h"

#include "recording/palpate_samples.h"
#include "testing/testing.h"

namespace palpate::recording_meta_test {
namespace {
using namespace testing;

TEST(RecordingMeta, IsWhatTheWriterWasGiven) {
  const TemporaryFolder folder;
  PalpateWriterOptions options;
  options.synced = false;
  const std::string settings = R"([{"sensitivity":0.5,"threshold_counts":150}])";
  PalpateWriter writer(
      folder / "a.palpate", sdh2().layout, {{"settings", settings}, {"operator", "Ada"}}, options);
  addSamples(writer, 0, 5);
  writer.commit();
  EXPECT_EQ(readRecordingMeta(folder / "a.palpate").at("settings"), settings) << "being written";
  writer.finish();
  const auto meta = readRecordingMeta(folder / "a.palpate");
  EXPECT_EQ(meta.at("settings"), settings);
  EXPECT_EQ(meta.at("operator"), "Ada");
}

TEST(RecordingMeta, OfADsaThereIsNone) {
  const TemporaryFolder folder;
  writeFile(folder / "a.dsa", "<?xml version=\"1.0\"?><measurement/>");
  EXPECT_TRUE(readRecordingMeta(folder / "a.dsa").empty());
}

TEST(RecordingMeta, NoFileOrADamagedOneIsSaid) {
  const TemporaryFolder folder;
  EXPECT_THROW(readRecordingMeta(folder / "none.palpate"), FileError);
  writeFile(folder / "broken.palpate",
            std::string("SQLite format 3\0", 16) + std::string(200, 'x'));
  EXPECT_THROW(readRecordingMeta(folder / "broken.palpate"), Error);
}

}  // namespace
}  // namespace palpate::recording_meta_test
