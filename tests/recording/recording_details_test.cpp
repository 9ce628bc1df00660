// What a list of recordings says of one: in every form, in every state it can be in.
#include "palpate/recording/recording_details.h"

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/event_store.h"
#include "palpate/recording/recording.h"

#include "recording/palpate_samples.h"
#include "testing/testing.h"

namespace palpate::recording_details_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;
using State = RecordingDetails::State;

const std::map<std::string, std::string> kMeta{{"operator", "Ada"},
                                               {"object", "foam ball"},
                                               {"run", "7"},
                                               {"notes", "cold room"},
                                               {"program", "palpate"}};

Event event(std::int64_t at, const char* kind, const char* text) {
  return {kSampleStartUs + at, kSampleStartUs + at, kind, {}, text, ""};
}

fs::path writeRecording(const fs::path& path, std::size_t frames, bool finish = true) {
  PalpateWriterOptions options;
  options.synced = false;
  PalpateWriter writer(path, sdh2().layout, kMeta, options);
  addSamples(writer, 0, frames);
  writer.addEvent(event(9, "label", "slip"));
  writer.addEvent(event(1, "label", "touch"));
  writer.addEvent(event(12, "label", "slip"));
  writer.addEvent(event(3, "segment", "ball"));
  writer.addEvent(event(5, "note", "it fell"));
  writer.addEvent(event(6, "gap", "no frames"));
  writer.addEvent(event(7, "mark", ""));
  if (finish)
    writer.finish();
  else
    writer.commit();
  return path;
}

void expectContent(const RecordingDetails& details, std::int64_t frames) {
  EXPECT_EQ(details.form, "palpate");
  EXPECT_EQ(details.operatorName, "Ada");
  EXPECT_EQ(details.object, "foam ball");
  EXPECT_EQ(details.run, "7");
  EXPECT_EQ(details.notes, "cold room\nit fell");
  EXPECT_EQ(details.labels, (std::vector<std::string>{"touch", "ball", "slip"}));
  EXPECT_EQ(details.numFrames, frames);
  EXPECT_EQ(details.startUs, kSampleStartUs);
  EXPECT_EQ(details.durationUs, (frames - 1) * kSampleStepUs);
}

TEST(RecordingDetails, ofAFinishedRecording) {
  const TemporaryFolder folder;
  const fs::path path = writeRecording(folder / "r.palpate", 500);
  const RecordingDetails details = readDetails(path);
  EXPECT_EQ(details.state, State::kFinished);
  EXPECT_EQ(details.message, "");
  EXPECT_EQ(details.path, path);
  EXPECT_EQ(details.sizeBytes, fs::file_size(path));
  EXPECT_GT(details.changedUs, kSampleStartUs);
  expectContent(details, 500);
}

// In Palpate's own format without its samples, in others by reading them.
TEST(RecordingDetails, namesFurtherSeries) {
  const TemporaryFolder folder;
  ProfileBuilder builder(sdh2());
  const std::size_t wrist = builder.addSeries({"wrist", "", {{"fx", "N"}, {"fy", ""}}, ""});
  builder.addSeries({"empty", "", {{"a", ""}}, ""});
  TactileFrame frame(sdh2().layout);
  for (int i = 0; i < 3; ++i) {
    frame.hostUs = kSampleStartUs + i * 10'000;
    builder.addFrame(frame);
  }
  for (int i = 0; i < 2001; ++i)
    builder.addSample(wrist, kSampleStartUs + i * 1000, std::vector<double>{1.0 * i, 0.0});
  const Profile profile = builder.finish({});
  for (const char* name : {"r.palpate", "r.mcap"}) {
    saveRecording(profile, {}, folder / name);
    const RecordingDetails details = readDetails(folder / name);
    ASSERT_FALSE(details.series.empty()) << name;
    EXPECT_EQ(details.series[0].name, "wrist");
    EXPECT_EQ(details.series[0].samples, 2001);
    EXPECT_NEAR(details.series[0].rateHz, 1000.0, 1e-6);
    EXPECT_EQ(details.series[0].columns, (std::vector<Column>{{"fx", "N"}, {"fy", ""}}));
    EXPECT_EQ(details.series[0].text(), "wrist: fx [N], fy, 1000.0 Hz");
  }
}

TEST(RecordingDetails, namesFurtherSeriesOfOneThatIsBeingRecorded) {
  const TemporaryFolder folder;
  PalpateWriter writer(folder / "r.palpate", sdh2().layout);
  const std::size_t wrist = writer.addSeries({"wrist", "", {{"fx", "N"}}, ""});
  for (int i = 0; i < 2001; ++i) {
    Sample sample;
    sample.series = wrist;
    sample.hostUs = kSampleStartUs + i * 1000;
    sample.values = {1.0 * i};
    writer.addSample(sample);
  }
  writer.commit();
  const RecordingDetails details = readDetails(folder / "r.palpate");
  EXPECT_EQ(details.state, State::kRecording);
  EXPECT_EQ(details.numFrames, 0);
  ASSERT_EQ(details.series.size(), 1u);
  EXPECT_EQ(details.series[0].samples, 2001);
  EXPECT_NEAR(details.series[0].rateHz, 1000.0, 1e-6);
}

TEST(RecordingDetails, framesArentRead) {
  const TemporaryFolder folder;
  const fs::path path = writeRecording(folder / "r.palpate", 2000);
  // Every block of data is spoilt in its middle; pages of 4096 bytes, one block each.
  std::string bytes = readFile(path);
  std::size_t spoilt = 0;
  for (std::size_t page = 20 * 4096; page + 4096 < bytes.size() / 2; page += 4096) {
    bytes.replace(page + 2000, 100, 100, 'x');
    ++spoilt;
  }
  ASSERT_GT(spoilt, 20u);
  writeFile(path, bytes);
  EXPECT_NE(verifyRecording(path).state, VerifyReport::State::kSound);
  expectContent(readDetails(path), 2000);
}

TEST(RecordingDetails, ofOneThatIsBeingRecordedAndOfOneWhoseWriterDied) {
  const TemporaryFolder folder;
  const fs::path path = folder / "r.palpate";
  {
    PalpateWriter writer(path, sdh2().layout, kMeta);
    addSamples(writer, 0, 90);
    writer.commit();
    const RecordingDetails details = readDetails(path);
    EXPECT_EQ(details.state, State::kRecording);
    EXPECT_EQ(details.numFrames, 90);
    EXPECT_EQ(details.durationUs, 89 * kSampleStepUs);
  }
  const RecordingDetails details = readDetails(writeRecording(folder / "u.palpate", 90, false));
  EXPECT_EQ(details.state, State::kUnfinished);
  EXPECT_NE(details.message.find("recovered"), std::string::npos);
  expectContent(details, 90);
}

TEST(RecordingDetails, ofARecordingWithoutFrames) {
  const TemporaryFolder folder;
  {
    PalpateWriter writer(folder / "r.palpate", sdh2().layout);
    writer.addSample(sampleAngles(0));
    writer.finish();
  }
  const RecordingDetails details = readDetails(folder / "r.palpate");
  EXPECT_EQ(details.state, State::kFinished);
  EXPECT_EQ(details.numFrames, 0);
  EXPECT_FALSE(details.startUs);
  EXPECT_FALSE(details.durationUs);
}

TEST(RecordingDetails, ofADsaWithItsNotes) {
  const TemporaryFolder folder;
  writeSamples(folder / "a.palpate", 50);
  const fs::path path = folder / "r.dsa";
  saveRecording(openRecording(folder / "a.palpate"), {}, path);
  saveEvents(path, {}, std::vector{event(4, "label", "slip"), event(2, "note", "old glove")});
  RecordingDetails details = readDetails(path);
  EXPECT_EQ(details.form, "dsa");
  EXPECT_EQ(details.state, State::kFinished);
  EXPECT_EQ(details.numFrames, 50);
  EXPECT_EQ(details.startUs, kSampleStartUs);  // whole milliseconds in a .dsa: so is this one
  EXPECT_EQ(details.durationUs, 49 * kSampleStepUs);
  EXPECT_EQ(details.labels, std::vector<std::string>{"slip"});
  EXPECT_EQ(details.notes, "old glove");
  // Notes that can't be read make no recording bad.
  writeFile(path.string() + ".notes.json", "nonsense");
  details = readDetails(path);
  EXPECT_EQ(details.state, State::kFinished);
  EXPECT_EQ(details.numFrames, 50);
  EXPECT_NE(details.message.find("notes.json"), std::string::npos);
}

TEST(RecordingDetails, ofBadFiles) {
  const TemporaryFolder folder;
  writeFile(folder / "empty.dsa", "");
  writeFile(folder / "text.palpate", "hello, this is no recording");
  writeFile(folder / "text.dsa", "hello, this is no recording");
  writeRecording(folder / "cut.palpate", 300);
  fs::resize_file(folder / "cut.palpate", 6000);
  writeSamples(folder / "a.palpate", 300);
  saveRecording(openRecording(folder / "a.palpate"), {}, folder / "cut.dsa");
  fs::resize_file(folder / "cut.dsa", fs::file_size(folder / "cut.dsa") / 2);
  for (const char* name : {"empty.dsa", "text.palpate", "text.dsa", "cut.palpate", "cut.dsa"}) {
    const RecordingDetails details = readDetails(folder / name);
    EXPECT_EQ(details.state, State::kDamaged) << name;
    EXPECT_NE(details.message, "") << name;
  }
  EXPECT_EQ(readDetails(folder / "missing.dsa").state, State::kUnreadable);
  fs::create_directory(folder / "folder.palpate");
  EXPECT_EQ(readDetails(folder / "folder.palpate").state, State::kUnreadable);
}

TEST(RecordingDetails, readingADsaCanBeCancelled) {
  const TemporaryFolder folder;
  writeSamples(folder / "a.palpate", 3000);
  saveRecording(openRecording(folder / "a.palpate"), {}, folder / "r.dsa");
  EXPECT_THROW(readDetails(folder / "r.dsa", [](double) { return false; }), Cancelled);
}

TEST(RecordingDetails, whatIsKeptIsBounded) {
  const TemporaryFolder folder;
  {
    PalpateWriter writer(folder / "r.palpate", sdh2().layout, {{"object", std::string(9000, 'o')}});
    addSamples(writer, 0, 10);
    for (int i = 0; i < 1000; ++i) {
      writer.addEvent(event(i, "label", ("l" + std::to_string(i)).c_str()));
      writer.addEvent(event(i, "note", std::string(500, 'n').c_str()));
    }
    writer.finish();
  }
  const RecordingDetails details = readDetails(folder / "r.palpate");
  EXPECT_EQ(details.labels.size(), 200u);
  EXPECT_EQ(details.object.size(), 2000u);
  EXPECT_LE(details.notes.size(), 2001u);
}

TEST(RecordingDetails, statesHaveNames) {
  for (const State state : {State::kFinished,
                            State::kRecording,
                            State::kUnfinished,
                            State::kDamaged,
                            State::kUnreadable})
    EXPECT_EQ(detailsStateFrom(nameOf(state)), state);
  EXPECT_FALSE(detailsStateFrom("fine"));
}

}  // namespace
}  // namespace palpate::recording_details_test
