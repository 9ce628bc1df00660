// Series beside those of the hand in native recordings: written, read, damaged, recovered.
#include <cmath>

#include <sqlite3.h>

#include "palpate/device/sdh2.h"
#include "palpate/recording/crop.h"
#include "palpate/recording/recording_losses.h"

#include "recording/palpate_damage.h"
#include "recording/palpate_faults.h"

namespace palpate::palpate_series_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;

const std::vector<SeriesDescription> kSeries{
    {"wrist", "reference_force", {{"fx", "N"}, {"fy", "N"}, {"fz", "N"}}, "tcp:localhost:9871"},
    {"imu", "", {{"ax", "m/s^2"}}, ""},
    {"room", "", {{"t", "degC"}, {"p", "hPa"}}, "import room.csv"}};
constexpr std::int64_t kStepsUs[] = {1'000, 4'000, 500'000};

// The i-th sample: its values tell which one it is; every seventh lacks the first one.
Sample seriesSample(std::size_t series, std::size_t i) {
  const std::size_t further = series - kHandSeries;
  Sample sample{kSampleStartUs + static_cast<std::int64_t>(i) * kStepsUs[further] + 1, {}, series};
  for (std::size_t c = 0; c < kSeries[further].columns.size(); ++c)
    sample.values.push_back(static_cast<double>(i) + 0.1 * static_cast<double>(c + 1));
  if (i % 7 == 3) sample.values[0] = std::nan("");
  if (further == 0) sample.deviceUs = static_cast<std::int64_t>(i) * 1'001;
  return sample;
}

bool isSame(const Sample& a, const Sample& b) {
  return a.hostUs == b.hostUs && a.deviceUs == b.deviceUs &&
         std::equal(a.values.begin(),
                    a.values.end(),
                    b.values.begin(),
                    b.values.end(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

// Numbers of the samples of a series; each must be the one that was written under its time.
std::set<std::size_t> samplesOf(const Profile& profile, std::size_t series) {
  std::set<std::size_t> found;
  for (std::size_t i = 0; i < profile.numSamples(series); ++i) {
    const Sample sample = profile.sample(series, i);
    const auto number =
        static_cast<std::size_t>((sample.hostUs - kSampleStartUs) / kStepsUs[series - kHandSeries]);
    EXPECT_TRUE(isSame(sample, seriesSample(series, number))) << series << ": " << number;
    EXPECT_TRUE(found.insert(number).second) << number << " is there twice";
  }
  return found;
}

// Frames with all series up to their times.
void addAll(PalpateWriter& writer, std::size_t frames, std::size_t (&next)[3]) {
  for (std::size_t i = 0; i < frames; ++i) {
    addSamples(writer, i, i + 1);
    for (std::size_t s = 0; s < 3; ++s)
      for (; seriesSample(kHandSeries + s, next[s]).hostUs <= sampleFrame(i).hostUs; ++next[s])
        writer.addSample(seriesSample(kHandSeries + s, next[s]));
  }
}

void writeSeries(const fs::path& path, std::size_t frames, bool finish = true) {
  PalpateWriterOptions options;
  options.synced = false;
  PalpateWriter writer(path, sdh2().layout, {}, options);
  for (const SeriesDescription& each : kSeries) writer.addSeries(each);
  std::size_t next[3] = {};
  addAll(writer, frames, next);
  finish ? writer.finish() : writer.commit();
}

void change(const fs::path& path, const char* sql) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
  sqlite3_exec(db, "PRAGMA secure_delete=ON", nullptr, nullptr, nullptr);
  EXPECT_EQ(sqlite3_exec(db, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
  sqlite3_close(db);
}

void expectWhole(const Profile& profile, const Profile& as) {
  ASSERT_EQ(profile.furtherSeries(), kSeries);
  for (std::size_t s = kHandSeries; s < kHandSeries + 3; ++s) {
    EXPECT_EQ(profile.numSamples(s), as.numSamples(s));
    EXPECT_EQ(samplesOf(profile, s).size(), profile.numSamples(s));
  }
}

TEST(PalpateSeries, surviveTheRoundTrip) {
  const TemporaryFolder folder;
  writeSeries(folder / "a.palpate", 60);
  EXPECT_EQ(readFile(folder / "a.palpate").at(63), 3) << "user version";
  const Recording recording = readRecording(folder / "a.palpate");
  expectWhole(recording.profile, recording.profile);
  EXPECT_EQ(samplesOf(recording.profile, kHandSeries).size(), 1947u);  // up to the last frame
  EXPECT_TRUE(recording.profile.info().warnings.empty());
  const VerifyReport report = verifyRecording(folder / "a.palpate");
  EXPECT_EQ(report.state, VerifyReport::State::kSound) << report.message;
  EXPECT_NE(report.message.find("1947 wrist samples"), std::string::npos) << report.message;
  saveRecording(recording.profile, recording.events, folder / "b.palpate");
  expectWhole(openRecording(folder / "b.palpate"), recording.profile);
  recoverRecording(folder / "a.palpate", folder / "c.palpate");
  expectWhole(openRecording(folder / "c.palpate"), recording.profile);
}

TEST(PalpateSeries, withoutThemAFileIsOfVersion1) {
  const TemporaryFolder folder;
  writeSamples(folder / "a.palpate", 10);
  EXPECT_EQ(readFile(folder / "a.palpate").at(63), 1);
  change(folder / "a.palpate", "PRAGMA user_version=4");
  EXPECT_THROW(openRecording(folder / "a.palpate"), FormatError);
}

TEST(PalpateSeries, areInACropWithTheSamplesAroundIt) {
  const TemporaryFolder folder;
  writeSeries(folder / "a.palpate", 60);
  const Profile part = cropped(openRecording(folder / "a.palpate"), 20, 30);
  ASSERT_EQ(part.furtherSeries(), kSeries);
  for (std::size_t s = kHandSeries; s < kHandSeries + 3; ++s) {
    EXPECT_EQ(samplesOf(part, s).size(), part.numSamples(s));
    EXPECT_LE(part.sampleTimeUs(s, 0), part.frameTimeUs(0));
  }
}

TEST(PalpateSeries, aDamagedDescriptionCostsItsNamesOnly) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.palpate";
  writeSeries(path, 60);
  change(path, "UPDATE series SET name='arm' WHERE idx=4");
  for (const bool recovers : {false, true}) {
    if (recovers) {
      EXPECT_EQ(recoverRecording(path, folder / "b.palpate").state, RecoverReport::State::kPart);
    }
    const Profile profile = openRecording(recovers ? folder / "b.palpate" : path);
    ASSERT_EQ(profile.series().size(), 5u);
    EXPECT_EQ(profile.series()[2], kSeries[0]);
    EXPECT_EQ(profile.series()[3].name, "series_3");
    EXPECT_EQ(profile.series()[3].columns, (std::vector<Column>{{"1", ""}}));
    EXPECT_EQ(profile.series()[4], kSeries[2]);
    for (std::size_t s = kHandSeries; s < 5; ++s)
      EXPECT_EQ(samplesOf(profile, s).size(), profile.numSamples(s));
    EXPECT_EQ(profile.info().warnings.size(), recovers ? 0u : 1u);
  }
  EXPECT_NE(verifyRecording(path).message.find("series_3"), std::string::npos);
}

TEST(PalpateSeries, aTableThatIsGoneCostsAllNames) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.palpate";
  writeSeries(path, 60);
  change(path, "PRAGMA secure_delete=ON; DROP TABLE series");
  const PalpateRecovery recovery = recoverPalpateProfile(path);
  ASSERT_TRUE(recovery.profile);
  EXPECT_FALSE(recovery.whole());
  ASSERT_EQ(recovery.further.size(), 3u);
  EXPECT_EQ(recovery.further[0].name, "series_2");
  EXPECT_EQ(recovery.further[2].name, "series_4");
  for (const RecoveredSeries& series : recovery.further) EXPECT_TRUE(series.renamed);
  EXPECT_EQ(recovery.profile->series()[4].columns, (std::vector<Column>{{"1", ""}, {"2", ""}}));
  EXPECT_EQ(samplesOf(*recovery.profile, 2).size(), 1947u);
  EXPECT_EQ(openRecording(path).series()[2].name, "series_2");
}

TEST(PalpateSeries, whatIsLostOfEachIsToldAndKept) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.palpate";
  writeSeries(path, 60);
  change(
      path,
      "DELETE FROM block WHERE stream=3 AND first=(SELECT max(first) FROM block WHERE stream=3)");
  const PalpateRecovery recovery = recoverPalpateProfile(path);
  ASSERT_EQ(recovery.further.size(), 3u);
  EXPECT_GT(recovery.further[0].lost, 0u);
  EXPECT_EQ(recovery.further[0].samples + recovery.further[0].lost, 1947u);
  EXPECT_EQ(recovery.further[1].lost, 0u);
  recoverRecording(path, folder / "b.palpate");
  const auto losses = lossesOf(readRecording(folder / "b.palpate").events);
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_EQ(losses[0].stream, "wrist");
  EXPECT_EQ(losses[0].lost, recovery.further[0].lost);
  EXPECT_NE(losses[0].text().find("wrist sample"), std::string::npos);
}

// Cut anywhere, bytes changed anywhere: what is given is right, and it is more than nothing.
TEST(PalpateSeries, neverGiveAWrongValueWhateverIsDamaged) {
  const TemporaryFolder folder;
  writeSeries(folder / "sound.palpate", 60);
  const std::string sound = readFile(folder / "sound.palpate");
  const std::size_t all[] = {1947, 487, 4};
  std::size_t saved = 0;
  for (unsigned seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::string bytes = sound;
    if (seed % 3 == 0) bytes.resize(random() % bytes.size());
    for (unsigned i = seed % 2 == 0 ? 0 : random() % 60; i > 0 && !bytes.empty(); --i) {
      char& byte = bytes[random() % (seed % 5 == 0 ? std::min<std::size_t>(bytes.size(), 8192)
                                                   : bytes.size())];
      byte = static_cast<char>(byte ^ static_cast<char>(1 + random() % 255));
    }
    const fs::path path = folder / "damaged.palpate";
    writeFile(path, bytes);
    const PalpateRecovery recovery = recoverPalpateProfile(path);
    bool complete = recovery.profile && recovery.further.size() == 3;
    if (recovery.profile)
      for (std::size_t s = kHandSeries; s < recovery.profile->series().size(); ++s) {
        ASSERT_LT(s, kHandSeries + 3);
        const std::size_t found = samplesOf(*recovery.profile, s).size();
        complete = complete && found == all[s - kHandSeries];
        saved += found;
      }
    EXPECT_TRUE(complete || !recovery.whole());
    try {
      const Profile profile = openRecording(path);
      for (std::size_t s = kHandSeries; s < profile.series().size(); ++s) samplesOf(profile, s);
    } catch (const FormatError&) {
    } catch (const FileError&) {
    }
  }
  EXPECT_GT(saved, 100'000u);
}

TEST(PalpateSeries, aKilledWriterLeavesThemAsFarAsTheyWereCommitted) {
  for (unsigned round = 0; round < 10; ++round) {
    const TemporaryFolder folder;
    const fs::path path = folder / "r.palpate";
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
      PalpateWriter writer(path, sdh2().layout);
      for (const SeriesDescription& each : kSeries) writer.addSeries(each);
      std::int64_t told = 0;
      for (std::size_t i = 0;; ++i) {
        writer.addSample(seriesSample(kHandSeries, 33 * i));
        writer.addSample(seriesSample(kHandSeries + 1, 9 * i));
        addSamples(writer, i, i + 1);
        if (writer.framesOnDisk() == told) continue;
        told = writer.framesOnDisk();
        if (write(ends[1], &told, sizeof told) != sizeof told) _exit(1);
      }
    }
    close(ends[1]);
    std::int64_t committed = 0;
    for (unsigned i = 0; i <= round; ++i)
      EXPECT_EQ(read(ends[0], &committed, sizeof committed), ssize_t{sizeof committed});
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    close(ends[0]);
    const Profile profile = openRecording(path);
    ASSERT_EQ(profile.furtherSeries(), kSeries);
    EXPECT_GE(samplesOf(profile, kHandSeries).size(), static_cast<std::size_t>(committed));
    EXPECT_GE(samplesOf(profile, kHandSeries + 1).size(), static_cast<std::size_t>(committed));
    EXPECT_EQ(verifyRecording(path).state, VerifyReport::State::kSound);
  }
}

TEST(PalpateSeries, aFormatWithoutAPlaceForThemIsNamed) {
  const TemporaryFolder folder;
  writeSeries(folder / "a.palpate", 10);
  const Profile profile = openRecording(folder / "a.palpate");
  EXPECT_EQ(leftOutText(profile, "out.palpate"), "");
  EXPECT_EQ(leftOutText(profile, "out.dsa"),
            "a .dsa has no place for the series wrist, imu, room: they are left out");
  EXPECT_EQ(seriesText(profile, kHandSeries + 1), "75 samples, 250.0 Hz (mean); ax [m/s^2]");
}

}  // namespace
}  // namespace palpate::palpate_series_test
