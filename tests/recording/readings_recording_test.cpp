// Recordings of sensors whose readings have a sign, three components, or noise at rest.
#include <random>

#include <sqlite3.h>

#include "palpate/core/error.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"
#include "palpate/model/touch.h"
#include "palpate/recording/crop.h"
#include "palpate/recording/palpate_recovery.h"
#include "palpate/recording/recording.h"

#include "recording/palpate_damage.h"
#include "testing/testing.h"

namespace palpate::readings_recording_test {
namespace {

using namespace testing;

HandDescription skin() {
  return parseHand(R"({"format": "palpate-hand", "version": 1, "name": "skin", "full_scale": 1000,
      "touch_threshold": 5, "matrices": [
        {"name": "a", "rows": 2, "columns": 2, "pitch_mm": 4, "components": 3},
        {"name": "b", "rows": 1, "columns": 3, "pitch_mm": 4, "picture": {"column": 1, "row": 0}}
      ]})",
                   "",
                   "hand.json");
}

// 15 readings of frame `i`; that of z of the first taxel falls by 1 per frame.
std::vector<float> readingsOf(int i) {
  std::vector<float> readings(15, 0.25F);
  readings[0] = readings[1] = 0.0F;
  readings[2] = static_cast<float>(-i);
  readings[14] = static_cast<float>(100 + i);
  return readings;
}

Profile recorded() {
  ProfileBuilder builder(skin());
  for (int i = 0; i < 40; ++i) builder.addReadings(1'000 + 10 * i, readingsOf(i));
  return builder.finish({});
}

std::vector<Event> rest() {
  Baseline first{std::vector<float>(15), {}};
  first.rest[14] = 100.0F;
  Baseline second = first;
  second.rest[2] = -20.0F;
  return {baselineEvent(first, 900), baselineEvent(second, 1'200)};
}

TEST(ReadingsRecording, ReadingsComeBackAndAreSeenOverTheirBaselines) {
  const TemporaryFolder folder;
  const auto path = folder / "a.palpate";
  saveRecording(recorded(), rest(), path);
  const Recording read = readRecording(path);
  ASSERT_TRUE(read.profile.givesReadings());
  ASSERT_EQ(read.profile.numFrames(), 40u);
  for (std::size_t i = 0; i < 40; ++i) {
    const TactileFrame frame = read.profile.frame(i);
    ASSERT_EQ(frame.readings, readingsOf(static_cast<int>(i))) << i;
    // From frame 20 on over the second baseline.
    const float z = static_cast<float>(i < 20 ? i : i - 20);
    EXPECT_EQ(frame.values[0], z > 5.0F ? z : 0.0F) << i;
    EXPECT_EQ(frame.values[6], i > 5 ? static_cast<float>(i) : 0.0F) << i;
    EXPECT_EQ(frame.allValues()[0], z) << i;
  }
  const Profile part = cropped(read.profile, 25, 39);
  EXPECT_EQ(part.frame(14).values, read.profile.frame(39).values);
  const auto cut = folder / "cut.palpate";
  saveRecording(part, eventsWithin(read.events, part), cut);
  EXPECT_EQ(openRecording(cut).frame(14).values, read.profile.frame(39).values);
}

TEST(ReadingsRecording, AWholeOneIsVerified) {
  const TemporaryFolder folder;
  saveRecording(recorded(), rest(), folder / "a.palpate");
  const PalpateRecovery recovery = recoverPalpateProfile(folder / "a.palpate");
  EXPECT_TRUE(recovery.whole());
  ASSERT_TRUE(recovery.profile);
  EXPECT_EQ(recovery.profile->frame(7).readings, readingsOf(7));
}

// With a sign only, a frame has as many readings as values: they must not be mixed up.
TEST(ReadingsRecording, DamagedRulesAreThoseOfTheHand) {
  const TemporaryFolder folder;
  const HandDescription hand = parseHand(
      R"({"format": "palpate-hand", "version": 1, "name": "s", "full_scale": 9, "signed": true,
          "touch_threshold": 2, "matrices": [{"name": "a", "rows": 1, "columns": 2,
          "pitch_mm": 4}]})",
      "",
      "hand.json");
  ProfileBuilder builder(hand);
  for (int i = 0; i < 5; ++i)
    builder.addReadings(1'000 + 10 * i, std::vector<float>{-3.0F, static_cast<float>(i)});
  saveRecording(builder.finish({}), {}, folder / "a.palpate");
  const std::vector<float> expected = openRecording(folder / "a.palpate").frame(3).values;
  ASSERT_EQ(expected, (std::vector<float>{3.0F, 3.0F}));
  const auto change = [&](const char* sql) {
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open((folder / "a.palpate").c_str(), &db), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(db, sql, nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(db);
  };
  change("UPDATE meta SET value='[' || value WHERE key='touch_rules'");
  EXPECT_EQ(openRecording(folder / "a.palpate").frame(3).values, expected);
  const PalpateRecovery recovery = recoverPalpateProfile(folder / "a.palpate");
  EXPECT_FALSE(recovery.whole());
  ASSERT_TRUE(recovery.profile);
  EXPECT_EQ(recovery.profile->frame(3).values, expected);
  EXPECT_EQ(recovery.profile->frame(3).readings, (std::vector<float>{-3.0F, 3.0F}));
  change("UPDATE meta SET value='{' || value WHERE key='hand_json'");
  EXPECT_THROW(openRecording(folder / "a.palpate"), FormatError);
}

// Cut anywhere, bytes changed anywhere: readings that are given are those that were written.
TEST(ReadingsRecording, NeverGiveAWrongReadingWhateverIsDamaged) {
  const TemporaryFolder folder;
  saveRecording(recorded(), rest(), folder / "sound.palpate");
  const std::string sound = readFile(folder / "sound.palpate");
  std::size_t given = 0;
  const auto check = [&](const Profile& profile) {
    ASSERT_TRUE(profile.givesReadings() || profile.numFrames() == 0);
    for (std::size_t i = 0; i < profile.numFrames(); ++i, ++given) {
      const TactileFrame frame = profile.frame(i);
      ASSERT_EQ(frame.readings, readingsOf(static_cast<int>((frame.hostUs - 1'000) / 10)));
    }
  };
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::string bytes = sound;
    if (seed % 3 == 0) bytes.resize(random() % bytes.size());
    for (unsigned i = seed % 2 == 0 ? 0 : 1 + random() % 40; i > 0 && !bytes.empty(); --i) {
      char& byte = bytes[random() % bytes.size()];
      byte = static_cast<char>(byte ^ static_cast<char>(1 + random() % 255));
    }
    writeFile(folder / "damaged.palpate", bytes);
    const PalpateRecovery recovery = recoverPalpateProfile(folder / "damaged.palpate");
    if (recovery.profile) check(*recovery.profile);
    try {
      check(openRecording(folder / "damaged.palpate"));
    } catch (const FormatError&) {
    } catch (const FileError&) {
    }
  }
  EXPECT_GT(given, 1'000u);
}

TEST(ReadingsRecording, OtherFormsHoldWhatIsSeen) {
  const TemporaryFolder folder;
  const Profile profile = recorded();
  saveRecording(profile, {}, folder / "a.mcap");
  const Recording read = readRecording(folder / "a.mcap");
  EXPECT_FALSE(read.profile.givesReadings());
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(read.profile.frame(i).values, profile.frame(i).values) << i;
    EXPECT_EQ(read.profile.frame(i).allValues(), profile.frame(i).allValues()) << i;
  }
}

}  // namespace
}  // namespace palpate::readings_recording_test
