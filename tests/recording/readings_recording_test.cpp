// Recordings of sensors whose readings have a sign, three components, or noise at rest.
#include <random>

#include <sqlite3.h>

#include "palpate/core/error.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"
#include "palpate/model/touch.h"
#include "palpate/recording/crop.h"
#include "palpate/recording/event_store.h"
#include "palpate/recording/palpate_recovery.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/recording_losses.h"
#include "palpate/recording/second_summary.h"

#include "imports/import_samples.h"
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

// What its file says of each second is what was seen while recording.
TEST(ReadingsRecording, ABaselineTakenLaterIsSeenAndDamagesNothing) {
  const TemporaryFolder folder;
  const auto path = folder / "a.palpate";
  saveRecording(recorded(), rest(), path);
  const auto summary = readSeconds(path);
  Baseline later{std::vector<float>(15), {}};
  later.rest[2] = -30.0F;
  const Recording before = readRecording(path);
  std::vector<Event> events = before.events;
  events.push_back(baselineEvent(later, 1'300, kNewBaselineKind));
  saveEvents(path, {before.events, 0}, events);
  const Recording read = readRecording(path);
  EXPECT_EQ(read.profile.frame(0).values[0], 30.0F) << "also before it";
  EXPECT_EQ(read.profile.frame(39).values[0], 9.0F);
  EXPECT_EQ(read.profile.frame(39).readings, before.profile.frame(39).readings);
  EXPECT_TRUE(recoverPalpateProfile(path).whole());
  EXPECT_EQ(recoverPalpateProfile(path).damagedRows, 0u);
  EXPECT_EQ(readSeconds(path), summary);

  const auto copy = folder / "copy.palpate";
  saveRecording(read.profile, read.events, copy);
  EXPECT_EQ(recoverPalpateProfile(copy).damagedRows, 0u);
  EXPECT_EQ(readSeconds(copy), summary);
  // A part that ends before the baseline was taken is seen over it, too.
  const Profile part = cropped(read.profile, 2, 10);
  const auto cut = folder / "cut.palpate";
  saveRecording(part, eventsWithin(read.events, part), cut);
  EXPECT_EQ(openRecording(cut).frame(0).values[0], 28.0F);
  EXPECT_EQ(recoverPalpateProfile(cut).damagedRows, 0u);

  saveEvents(path, {read.events, 0}, before.events);
  EXPECT_EQ(readRecording(path).profile.frame(30).values[0], 10.0F) << "undone";
  std::vector<Event> without = before.events;
  without.erase(without.begin());
  EXPECT_THROW(saveEvents(path, {before.events, 0}, without), std::invalid_argument)
      << "what happened while recording stays";
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
  EXPECT_THROW(openRecording(folder / "a.palpate"), FormatError);
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

void execute(const std::filesystem::path& path, const std::string& sql) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
      << sqlite3_errmsg(db);
  sqlite3_close(db);
}

// Every frame that is recovered has the readings that were recorded; returns how many there are.
std::size_t soundFrames(const std::filesystem::path& path) {
  PalpateRecovery recovery;
  try {
    recovery = recoverPalpateProfile(path);
  } catch (const Error&) {
    return 0;
  }
  if (!recovery.profile) return 0;
  for (std::size_t i = 0; i < recovery.profile->numFrames(); ++i) {
    const TactileFrame frame = recovery.profile->frame(i);
    EXPECT_EQ(frame.readings, readingsOf(static_cast<int>((frame.hostUs - 1'000) / 10)));
  }
  return recovery.profile->numFrames();
}

TEST(ReadingsRecording, AnHdf5FileGivesTheReadingsBack) {
  const TemporaryFolder folder;
  const std::vector<Event> events = rest();
  const Profile profile = recorded().withBaselines(baselinesOf(events, *skin().layout));
  EXPECT_FALSE(profile.hasCounts()) << "the values are differences";
  saveRecording(profile, events, folder / "a.h5");
  EXPECT_EQ(leftOutText(profile, folder / "a.h5"), "");
  const Recording read = readRecording(folder / "a.h5");
  ASSERT_TRUE(read.profile.givesReadings());
  EXPECT_EQ(read.profile.layout(), profile.layout());
  ASSERT_EQ(read.profile.baselines().size(), 2u);
  ASSERT_EQ(read.profile.numFrames(), 40u);
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(read.profile.frame(i).readings, readingsOf(static_cast<int>(i))) << i;
    EXPECT_EQ(read.profile.frame(i).values, profile.frame(i).values) << i;
  }
  // And from there into a native recording.
  saveRecording(read.profile, read.events, folder / "b.palpate");
  EXPECT_EQ(openRecording(folder / "b.palpate").frame(30).readings, readingsOf(30));
}

TEST(ReadingsRecording, NumpyMatlabAndHdf5HaveAnArrayOfReadings) {
  const TemporaryFolder folder;
  const std::vector<Event> events = rest();
  const Profile profile = recorded().withBaselines(baselinesOf(events, *skin().layout));
  for (const char* name : {"a.npz", "a.mat", "a.h5"}) {
    saveRecording(profile, events, folder / name);
    EXPECT_EQ(leftOutText(profile, folder / name), "") << name;
  }
  runPython(folder, R"(
import json, sys, h5py, numpy as np, scipy.io
folder = sys.argv[1] + '/'
def expected(i):
  row = np.full(15, 0.25)
  row[0:3] = [0, 0, -i]
  row[14] = 100 + i
  return row[:12].reshape(2, 2, 3), row[12:].reshape(1, 3, 1)
n = np.load(folder + 'a.npz')
m = scipy.io.loadmat(folder + 'a.mat', simplify_cells=True)['tactile']
h = h5py.File(folder + 'a.h5')
assert h.attrs['format_version'] == 4
rules = json.loads(str(n['meta']))['touch_rules']
assert [r['components'] for r in rules] == [3, 1] and [r['signed'] for r in rules] == [True, False]
assert json.loads(m['touch_rules']) == rules == json.loads(h['tactile'].attrs['touch_rules'])
for i in range(40):
  a, b = expected(i)
  for f in (n['m0_readings'][i], h['tactile/m0_readings'][i]): assert np.array_equal(f, a), i
  for f in (n['m1_readings'][i], h['tactile/m1_readings'][i]): assert np.array_equal(f, b), i
  # MATLAB's axes are reversed: component x column x row x frame.
  assert np.array_equal(m['m0_readings'][..., i].T, a), i
assert [e['kind'] for e in json.loads(str(n['meta']))['events']] == ['baseline', 'baseline']
)");
}

TEST(ReadingsRecording, CsvHasTheDifferencesOfEachComponent) {
  const TemporaryFolder folder;
  Baseline baseline{std::vector<float>(15), {}};
  baseline.rest[0] = -2.0F;
  baseline.rest[14] = 100.0F;
  const Profile profile =
      recorded().withBaselines({{0, std::make_shared<const Baseline>(baseline)}});
  saveRecording(profile, {}, folder / "a.csv");
  EXPECT_NE(leftOutText(profile, folder / "a.csv").find("no place for the readings"),
            std::string::npos);
  const std::string text = readFile(folder / "a.csv");
  EXPECT_EQ(text.find("frame,time_ms,matrix,y,x,value,time_us,dx,dy,dz\n"), 0u) << text;
  EXPECT_NE(text.find("\n7,1,0,0,0,7,1070,2,0,-7\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n7,1,1,0,2,7,1070,,,7\n"), std::string::npos) << text;
}

// A file whose layout and rules are those of three components, but whose frames have two numbers
// per taxel.
TEST(ReadingsRecording, FramesThatDontFitTheRulesAreNotShown) {
  const TemporaryFolder folder;
  const auto handOf = [](const std::string& matrix) {
    return parseHand(R"({"format": "palpate-hand", "version": 1, "name": "skin", "signed": true,
        "full_scale": 1000, "matrices": [{"name": "a", "rows": 1, "pitch_mm": 4, )" +
                         matrix + "}]}",
                     "",
                     "hand.json");
  };
  ProfileBuilder flat(handOf(R"("columns": 4)"));
  for (int i = 0; i < 40; ++i) flat.addReadings(1'000 + 10 * i, std::vector<float>(4, 1.0F));
  saveRecording(flat.finish({}), {}, folder / "a.palpate");
  ProfileBuilder skin(handOf(R"("columns": 2, "components": 3)"));
  skin.addReadings(1'000, std::vector<float>(6, 1.0F));
  saveRecording(skin.finish({}), {}, folder / "b.palpate");
  execute(folder / "a.palpate",
          "ATTACH '" + (folder / "b.palpate").string() +
              "' AS b; DELETE FROM matrix; INSERT INTO matrix SELECT * FROM b.matrix;"
              "DELETE FROM meta WHERE key IN ('touch_rules', 'hand_json');"
              "INSERT INTO meta SELECT * FROM b.meta WHERE key IN ('touch_rules', 'hand_json')");
  EXPECT_THROW(openRecording(folder / "a.palpate").frame(0), Error);
  EXPECT_NE(verifyRecording(folder / "a.palpate").state, VerifyReport::State::kSound);
  EXPECT_EQ(soundFrames(folder / "a.palpate"), 0u);
}

TEST(ReadingsRecording, DamagedRulesAreRefusedAndRecoveredFromTheHand) {
  const TemporaryFolder folder;
  saveRecording(recorded(), rest(), folder / "a.palpate");
  execute(folder / "a.palpate",
          "UPDATE meta SET value=replace(value, 'true', 'null') WHERE key='touch_rules'");
  std::string error;
  try {
    openRecording(folder / "a.palpate");
  } catch (const FormatError& refused) {
    error = refused.what();
  }
  EXPECT_NE(error.find("touch_rules"), std::string::npos) << error;
  EXPECT_NE(error.find("palpate recover"), std::string::npos) << error;
  EXPECT_EQ(soundFrames(folder / "a.palpate"), 40u);
}

TEST(ReadingsRecording, OfACutOrFlippedFileOnlySoundReadingsComeBack) {
  const TemporaryFolder folder;
  saveRecording(recorded(), rest(), folder / "a.palpate");
  const std::string whole = readFile(folder / "a.palpate");
  for (std::size_t tenth = 1; tenth < 10; ++tenth) {
    writeFile(folder / "b.palpate", whole.substr(0, whole.size() * tenth / 10));
    EXPECT_LE(soundFrames(folder / "b.palpate"), 40u) << tenth;
  }
  std::mt19937 random(5);
  std::size_t most = 0;
  for (int i = 0; i < 100; ++i) {
    std::string flipped = whole;
    const std::size_t at = random() % whole.size();
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << random() % 8));
    writeFile(folder / "b.palpate", flipped);
    most = std::max(most, soundFrames(folder / "b.palpate"));
  }
  EXPECT_EQ(most, 40u);
}

}  // namespace
}  // namespace palpate::readings_recording_test
