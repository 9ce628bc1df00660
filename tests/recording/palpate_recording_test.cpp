// Native recordings: round trips, what an independent reader finds in them, events, summaries.
#include <algorithm>
#include <random>
#include <thread>

#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/crop.h"
#include "palpate/recording/dsa_reader.h"
#include "palpate/recording/palpate_reader.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/second_summary.h"

#include "recording/palpate_samples.h"
#include "testing/program.h"
#include "testing/testing.h"

namespace palpate::palpate_recording_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;

void expectIndependentlyEqual(const fs::path& file, const std::string& expected) {
  const TemporaryFolder folder;
  const ProgramResult result = runProgram(
      "/usr/bin/python3", {PALPATE_INDEPENDENT_READER, file.string(), (folder / "dump").string()});
  ASSERT_EQ(result.exitCode, 0) << file << ": " << result.err;
  EXPECT_TRUE(readFile(folder / "dump") == expected) << file << ": other values";
}

TEST(PalpateRecording, sharedRecordingsSurviveTheRoundTrip) {
  const auto folder = recordingsFolder();
  PALPATE_NEED(folder);
  const TemporaryFolder made;
  std::size_t files = 0;
  for (const fs::path& path : testing::recordingsToTry(*folder)) {
    SCOPED_TRACE(path.string());
    const Profile original = openRecording(path);
    const std::string values = dumped(original);
    saveRecording(original, {}, made / "native.palpate", Overwrite::kReplace);
    const Profile native = openRecording(made / "native.palpate");
    EXPECT_TRUE(dumped(native) == values);
    EXPECT_EQ(native.layout(), original.layout());
    EXPECT_EQ(native.info().serial, original.info().serial);
    EXPECT_EQ(native.info().firmware, original.info().firmware);
    EXPECT_EQ(native.info().valueType, original.info().valueType);
    EXPECT_TRUE(native.info().warnings.empty());
    // Back to .dsa: the same bytes as from the original, and the same values.
    saveRecording(native, {}, made / "back.dsa", Overwrite::kReplace);
    saveRecording(original, {}, made / "direct.dsa", Overwrite::kReplace);
    EXPECT_TRUE(readFile(made / "back.dsa") == readFile(made / "direct.dsa"));
    EXPECT_TRUE(dumped(readDsa(made / "back.dsa")) == values);
    if (files++ % 10 == 0) {
      expectIndependentlyEqual(made / "native.palpate", values);
      EXPECT_EQ(verifyRecording(made / "native.palpate").state, VerifyReport::State::kSound);
    }
  }
  EXPECT_GE(files, testing::exhaustive() ? 600u : 60u);
}

TEST(PalpateRecording, anIndependentReaderFindsWhatWasWritten) {
  const TemporaryFolder folder;
  writeSamples(folder / "a.palpate", 300);
  std::string expected;
  const auto put = [&expected](const auto& value) {
    expected.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(std::int64_t{300});
  for (std::size_t i = 0; i < 300; ++i) {
    const TactileFrame frame = sampleFrame(i);
    put(frame.hostUs);
    put(*frame.deviceUs);
    for (float value : frame.values) put(value);
  }
  put(std::int64_t{1200});
  for (std::size_t i = 0; i < 1200; ++i) {
    put(sampleAngles(i).hostUs);
    put(std::int64_t{INT64_MIN});
    for (double deg : sampleAngles(i).values) put(deg);
  }
  put(std::int64_t{10});
  for (std::size_t i = 0; i < 10; ++i) {
    put(sampleTemperatures(i).hostUs);
    put(std::int64_t{INT64_MIN});
    for (double degC : sampleTemperatures(i).values) put(degC);
  }
  expectIndependentlyEqual(folder / "a.palpate", expected);
  EXPECT_TRUE(dumped(openRecording(folder / "a.palpate")) == expected);
}

// arrays A2: senders of streams have clocks of microseconds.
TEST(PalpateRecording, deviceTimesAreKeptToTheMicrosecond) {
  const TemporaryFolder folder;
  const auto timeOf = [](std::size_t i) -> std::optional<std::int64_t> {
    if (i % 7 == 3) return std::nullopt;
    // Whole milliseconds at first.
    return 32'000 * static_cast<std::int64_t>(i) - (i < 100 ? 1'000'000 : 999'500);
  };
  PalpateWriterOptions options;
  options.synced = false;
  PalpateWriter writer(folder / "a.palpate", sdh2().layout, {}, options);
  const auto add = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      TactileFrame frame = sampleFrame(i);
      frame.deviceUs = timeOf(i);
      writer.addFrame(frame);
    }
    writer.commit();
  };
  // The last byte of the user version in the header of an SQLite file.
  const auto version = [&] { return int{testing::readFile(folder / "a.palpate").at(63)}; };
  add(0, 100);
  EXPECT_EQ(version(), 1) << "readable by older programs";
  add(100, 200);
  EXPECT_EQ(version(), 2);
  writer.finish();
  const Profile profile = openRecording(folder / "a.palpate");
  EXPECT_EQ(profile.info().valueType, ValueType::kCounts);
  ASSERT_EQ(profile.numFrames(), 200u);
  for (std::size_t i = 0; i < 200; ++i) {
    EXPECT_EQ(profile.frame(i).deviceUs, timeOf(i)) << i;
    EXPECT_EQ(profile.frame(i).values, sampleFrame(i).values) << i;
  }
  expectIndependentlyEqual(folder / "a.palpate", dumped(profile));
  EXPECT_EQ(verifyRecording(folder / "a.palpate").state, VerifyReport::State::kSound);
}

TEST(PalpateRecording, floatValuesAreKeptToTheBit) {
  const TemporaryFolder folder;
  {
    PalpateWriter writer(folder / "f.palpate", sdh2().layout);
    for (std::size_t i = 0; i < 40; ++i) {
      TactileFrame frame = sampleFrame(i, i % 3 != 0);
      if (i % 3 == 1)
        for (std::size_t k = 0; k < frame.values.size(); ++k)
          frame.values[k] = -1e-3F * static_cast<float>(k * i + 1);
      writer.addFrame(frame);
    }
    writer.finish();
  }
  const Profile profile = openRecording(folder / "f.palpate");
  EXPECT_EQ(profile.info().valueType, ValueType::kFloat);
  ASSERT_EQ(profile.numFrames(), 40u);
  for (std::size_t i = 0; i < 40; ++i) {
    if (i % 3 == 1) continue;
    EXPECT_EQ(profile.frame(i).values, sampleFrame(i, i % 3 != 0).values) << i;
  }
  EXPECT_EQ(profile.frame(31).values[485], -1e-3F * static_cast<float>(485 * 31 + 1));
  expectIndependentlyEqual(folder / "f.palpate", dumped(profile));
}

TEST(PalpateRecording, randomAccessGivesWhatReadingInOrderGives) {
  const TemporaryFolder folder;
  writeSamples(folder / "r.palpate", 5000);
  const Profile profile = openRecording(folder / "r.palpate");
  ASSERT_EQ(profile.numFrames(), 5000u);
  const auto look = [&](unsigned seed) {
    std::mt19937 random(seed);
    for (int round = 0; round < 3000; ++round) {
      const std::size_t i = random() % 5000;
      const TactileFrame expected = sampleFrame(i);
      const TactileFrame frame = profile.frame(i);
      ASSERT_EQ(frame.values, expected.values) << i;
      ASSERT_EQ(frame.hostUs, expected.hostUs);
      ASSERT_EQ(frame.deviceUs, expected.deviceUs);
      ASSERT_EQ(profile.frameAt(expected.hostUs + 1), i);
      const std::size_t k = random() % 20000;
      ASSERT_EQ(profile.angles(k).values, sampleAngles(k).values);
      ASSERT_EQ(profile.angleSampleAt(sampleAngles(k).hostUs), k);
    }
  };
  std::jthread other(look, 1);
  look(2);
}

TEST(PalpateRecording, eventsSurviveEveryFormThatHasAPlaceForThem) {
  const TemporaryFolder folder;
  writeSamples(folder / "e.palpate", 100);
  const std::vector<Event> expected{
      {kSampleStartUs,
       kSampleStartUs + 10,
       "label",
       3,
       "f\xC3\xBC"
       "r",
       "{\"a\":1}"},
      {kSampleStartUs + 5, kSampleStartUs + 5, "note", {}, "two\nlines", ""}};
  const Profile profile = openRecording(folder / "e.palpate");
  EXPECT_EQ(readEvents(folder / "e.palpate").events, expected);
  saveRecording(profile, expected, folder / "e.dsa");
  EXPECT_TRUE(fs::exists(folder / "e.dsa.notes.json"));
  EXPECT_EQ(readEvents(folder / "e.dsa").events, expected);
  saveRecording(openRecording(folder / "e.dsa"), expected, folder / "again.palpate");
  EXPECT_EQ(readEvents(folder / "again.palpate").events, expected);
  // Notes of another recording never come to a new one.
  fs::remove(folder / "e.dsa");
  EXPECT_THROW(saveRecording(profile, {}, folder / "e.dsa"), FileError);
  EXPECT_FALSE(fs::exists(folder / "e.dsa"));
  saveRecording(profile, {}, folder / "e.dsa", Overwrite::kReplace);
  EXPECT_TRUE(readEvents(folder / "e.dsa").events.empty());
}

TEST(PalpateRecording, aCropKeepsItsHand) {
  const HandDescription& hand = builtInHand("sole");
  ProfileBuilder builder(hand);
  for (std::int64_t i = 0; i < 10; ++i)
    builder.addFrame(i * 10'000, std::vector<float>(hand.layout->numCells(), 1.5F));
  const Profile crop = cropped(builder.finish({}), 2, 5);
  EXPECT_EQ(crop.hand().name, hand.name);
  EXPECT_EQ(crop.hand().unit, hand.unit);
  EXPECT_EQ(crop.hand().file, hand.file);
}

TEST(PalpateRecording, aCropKeepsTheEventsInsideAndTheDeviceTimes) {
  const TemporaryFolder folder;
  writeSamples(folder / "c.palpate", 100);
  const Profile crop = cropped(openRecording(folder / "c.palpate"), 10, 19);
  ASSERT_EQ(crop.numFrames(), 10u);
  EXPECT_EQ(crop.frame(3).deviceUs, sampleFrame(13).deviceUs);
  const std::int64_t begin = crop.frameTimeUs(0);
  const std::int64_t end = crop.frameTimeUs(9);
  const std::vector<Event> events{{begin - 9, begin - 1, "a", {}, "", ""},
                                  {begin - 9, begin, "b", {}, "", ""},
                                  {end, end + 5, "c", {}, "", ""},
                                  {end + 1, end + 5, "d", {}, "", ""}};
  const auto within = eventsWithin(events, crop);
  ASSERT_EQ(within.size(), 2u);
  EXPECT_EQ(within[0].kind, "b");
  EXPECT_EQ(within[1].kind, "c");
}

TEST(PalpateRecording, theSummaryIsThatOfTheFrames) {
  const TemporaryFolder folder;
  writeSamples(folder / "s.palpate", 400);
  writeSamples(folder / "u.palpate", 400, false);
  // 33 ms apart from half past: second 0 holds 16 frames (0 .. 495 ms), ..
  std::vector<SecondSummary> rows = readSeconds(folder / "s.palpate");
  ASSERT_EQ(rows.size(), 14u * 6);
  EXPECT_EQ(rows[0].frames, 16);
  EXPECT_EQ(rows[0].tS, kSampleStartUs / 1'000'000);
  float highest = 0.0F;
  for (std::size_t i = 0; i < 16; ++i)
    for (std::size_t k = 0; k < 84; ++k) highest = std::max(highest, sampleFrame(i).values[k]);
  EXPECT_EQ(rows[0].maximum, static_cast<double>(highest));
  rows.resize(rows.size() - 6);  // the last second of an unfinished recording is not there yet
  EXPECT_EQ(readSeconds(folder / "u.palpate"), rows);
}

TEST(PalpateRecording, anUnfinishedButWholeRecordingIsSound) {
  const TemporaryFolder folder;
  writeSamples(folder / "u.palpate", 100, false);
  const VerifyReport report = verifyRecording(folder / "u.palpate");
  EXPECT_EQ(report.state, VerifyReport::State::kSound) << report.message;
  EXPECT_NE(report.message.find("unfinished"), std::string::npos) << report.message;
  EXPECT_EQ(recoverRecording(folder / "u.palpate", folder / "r.palpate").state,
            RecoverReport::State::kWhole);
  EXPECT_TRUE(dumped(openRecording(folder / "r.palpate")) ==
              dumped(openRecording(folder / "u.palpate")));
  EXPECT_EQ(readEvents(folder / "r.palpate").events, readEvents(folder / "u.palpate").events);
}

TEST(PalpateRecording, theWriterRefusesWhatNoReaderCouldRead) {
  const TemporaryFolder folder;
  PalpateWriter writer(folder / "w.palpate", sdh2().layout);
  TactileFrame frame = sampleFrame(1);
  writer.addFrame(frame);
  EXPECT_THROW(writer.addFrame(frame), std::invalid_argument);  // not later
  frame.hostUs = INT64_MAX;
  EXPECT_THROW(writer.addFrame(frame), std::invalid_argument);
  frame.hostUs = sampleFrame(2).hostUs;
  frame.values[5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(writer.addFrame(frame), std::invalid_argument);
  EXPECT_THROW(writer.addSample({1, std::vector<double>(65)}), std::invalid_argument);
  writer.addSample({1, {1.0, 2.0}});
  EXPECT_THROW(writer.addSample({2, {1.0}}), std::invalid_argument);
  writer.addEvent({});
  EXPECT_THROW(writer.addEvent({0, 0, "", {}, std::string(kMaxEventBytes + 1, 'a'), ""}),
               std::invalid_argument);
  writer.addFrame(sampleFrame(2));
  writer.finish();
  EXPECT_EQ(openRecording(folder / "w.palpate").numFrames(), 2u);
  EXPECT_EQ(verifyRecording(folder / "w.palpate").state, VerifyReport::State::kSound);
}

// O-A6.
TEST(PalpateRecording, theSummaryOfADsaIsThatOfItsFrames) {
  const TemporaryFolder folder;
  writeSamples(folder / "s.palpate", 100);
  saveRecording(openRecording(folder / "s.palpate"), {}, folder / "s.dsa");
  // Of the .dsa again: it holds no values where the sensor has no taxels.
  saveRecording(openRecording(folder / "s.dsa"), {}, folder / "again.palpate");
  const std::vector<SecondSummary> rows = readSeconds(folder / "s.dsa");
  EXPECT_EQ(rows.size(), 4u * 6);
  EXPECT_TRUE(rows == readSeconds(folder / "again.palpate"));
  const Profile open = openRecording(folder / "s.dsa");
  EXPECT_TRUE(rows == secondsOf(open));
  EXPECT_THROW(secondsOf(open, [](double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace palpate::palpate_recording_test
