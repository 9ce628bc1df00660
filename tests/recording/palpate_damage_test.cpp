// Damaged and hostile native recordings: everything intact comes back, nothing wrong is ever shown,
// one clear error otherwise.
#include "recording/palpate_damage.h"

#include <algorithm>

#include <sys/resource.h>

#include "palpate/device/sdh2.h"
#include "palpate/emulator/synthetic_profile.h"
#include "palpate/recording/palpate_recovery.h"
#include "palpate/recording/palpate_schema.h"
#include "palpate/recording/recording_losses.h"

namespace palpate::palpate_damage_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // shadow memory counts as memory
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif
#else
constexpr bool kSanitized = false;
#endif

TEST(PalpateDamage, everyBlockThatWasNotHitComesBack) {
  DamageRun run(400);
  for (unsigned seed = 0; seed < 300; ++seed) run.round(seed);
  EXPECT_GT(run.framesExpected(), 20'000u);
}

TEST(PalpateDamage, aKilledRecoveryIsRepeatedWithTheSameResult) {
  KilledRecovery recovery;
  std::mt19937 random(4);
  for (int i = 0; i < 20; ++i) recovery.round(random() % 40'000'000);
  EXPECT_GT(recovery.killed(), 0);
}

TEST(PalpateDamage, flippedValuesOfTheSummaryAreNoticedAndRebuilt) {
  const TemporaryFolder folder;
  writeSamples(folder / "a.palpate", 200);
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open((folder / "a.palpate").c_str(), &db), SQLITE_OK);
  ASSERT_EQ(
      sqlite3_exec(db, "UPDATE second SET max=max+1 WHERE rowid=7", nullptr, nullptr, nullptr),
      SQLITE_OK);
  sqlite3_close(db);
  const VerifyReport report = verifyRecording(folder / "a.palpate");
  EXPECT_EQ(report.state, VerifyReport::State::kDamaged);
  EXPECT_NE(report.message.find("1 damaged row"), std::string::npos) << report.message;
  recoverRecording(folder / "a.palpate", folder / "b.palpate");
  EXPECT_EQ(verifyRecording(folder / "b.palpate").state, VerifyReport::State::kSound);
}

// A loss shorter than a gap would be joined by a straight line, and nobody could tell.
TEST(PalpateDamage, theRecoveredRecordingTellsOfEachLostSpan) {
  const TemporaryFolder folder;
  writeSamples(folder / "a.palpate", 200);
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open((folder / "a.palpate").c_str(), &db), SQLITE_OK);
  const auto number = [&](const std::string& query) {
    sqlite3_stmt* statement = nullptr;
    EXPECT_EQ(sqlite3_prepare_v2(db, query.c_str(), -1, &statement, nullptr), SQLITE_OK);
    EXPECT_EQ(sqlite3_step(statement), SQLITE_ROW) << query;
    const std::int64_t value = sqlite3_column_int64(statement, 0);
    sqlite3_finalize(statement);
    return value;
  };
  ASSERT_GE(number("SELECT count(*) FROM block WHERE stream=0"), 5);
  const std::string third =
      "(SELECT first FROM block WHERE stream=0 ORDER BY first LIMIT 1 OFFSET 2)";
  const std::int64_t first = number("SELECT " + third);
  const std::int64_t lost = number("SELECT n FROM block WHERE stream=0 AND first=" + third);
  const std::int64_t beforeUs =
      number("SELECT max(t1_us) FROM block WHERE stream=0 AND first<" + third);
  const std::int64_t behindUs =
      number("SELECT min(t0_us) FROM block WHERE stream=0 AND first>" + third);
  ASSERT_EQ(sqlite3_exec(db,
                         ("UPDATE block SET data=zeroblob(length(data)) WHERE stream=0 AND first=" +
                          std::to_string(first))
                             .c_str(),
                         nullptr,
                         nullptr,
                         nullptr),
            SQLITE_OK);
  sqlite3_close(db);
  recoverRecording(folder / "a.palpate", folder / "b.palpate");
  const std::vector<Event> before = readEvents(folder / "a.palpate").events;
  const std::vector<Event> events = readEvents(folder / "b.palpate").events;
  ASSERT_EQ(events.size(), before.size() + 2);
  const auto gap = std::find_if(events.begin(), events.end(), [&](const Event& event) {
    return event.kind == "gap" && event.tUs == beforeUs;
  });
  ASSERT_NE(gap, events.end());
  EXPECT_EQ(gap->t1Us, behindUs);
  EXPECT_EQ(gap->json,
            R"({"stream":"tactile","lost":)" + std::to_string(lost) +
                R"(,"reason":"the file was damaged"})");
  EXPECT_NE(gap->text.find(std::to_string(lost) + " frame"), std::string::npos) << gap->text;
  const auto note = std::find_if(events.begin(), events.end(), [](const Event& event) {
    return event.kind == "note" &&
           event.text.starts_with("Recovered from the damaged file a.palpate: ");
  });
  ASSERT_NE(note, events.end());
  EXPECT_NE(note->text.find(std::to_string(lost) + " lost frame"), std::string::npos) << note->text;
  EXPECT_EQ(verifyRecording(folder / "b.palpate").state, VerifyReport::State::kSound);
}

// SQLite stores an integer in 1, 2, 3, 4, 6 or 8 bytes, the smallest that hold it (its file format,
// section 2.1). The deleted row is still on its page.
TEST(PalpateDamage, aBlockThatSqliteNoLongerReachesKeepsItsTimesOfAnySize) {
  for (const std::int64_t stampUs : {0LL,
                                     1LL,
                                     5LL,
                                     300LL,
                                     100'000LL,
                                     100'000'000LL,
                                     1'000'000'000'000LL,
                                     1LL << 59,
                                     -1LL,
                                     -5LL,
                                     -128LL,
                                     -129LL,
                                     -300LL,
                                     -100'000LL,
                                     -100'000'000LL,
                                     -1'000'000'000'000LL,
                                     -(1LL << 59)}) {
    const TemporaryFolder folder;
    const fs::path path = folder / "a.palpate";
    {
      PalpateWriterOptions options;
      options.synced = false;
      PalpateWriter writer(path, sdh2().layout, {}, options);
      TactileFrame frame(sdh2().layout);
      frame.hostUs = stampUs;
      writer.addFrame(frame);
      writer.finish();
    }
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
    EXPECT_EQ(
        sqlite3_exec(db, "PRAGMA secure_delete=OFF;DELETE FROM block", nullptr, nullptr, nullptr),
        SQLITE_OK);
    sqlite3_close(db);
    const PalpateRecovery recovery = recoverPalpateProfile(path);
    EXPECT_EQ(recovery.blocksFromPages, 1u) << stampUs;
    ASSERT_TRUE(recovery.profile && recovery.frames == 1) << stampUs;
    EXPECT_EQ(recovery.profile->frameTimeUs(0), stampUs);
  }
}

TEST(PalpateDamage, filteredBlocksAndTheirMicrosecondsAreFoundOnThePagesToo) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.palpate";
  {
    PalpateWriterOptions options;
    options.synced = false;
    PalpateWriter writer(path, sdh2().layout, {}, options);
    TactileFrame frame(sdh2().layout);
    frame.hostUs = 5'000;
    frame.deviceUs = 1'234'567;
    frame.values[3] = 2.5F;
    frame.filtered = frame.values;
    frame.filtered[4] = 0.5F;
    writer.addFrame(frame);
    writer.finish();
  }
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
  EXPECT_EQ(
      sqlite3_exec(db, "PRAGMA secure_delete=OFF;DELETE FROM block", nullptr, nullptr, nullptr),
      SQLITE_OK);
  sqlite3_close(db);
  const PalpateRecovery recovery = recoverPalpateProfile(path);
  EXPECT_EQ(recovery.blocksFromPages, 1u);
  ASSERT_TRUE(recovery.profile && recovery.frames == 1);
  const TactileFrame frame = recovery.profile->frame(0);
  EXPECT_EQ(frame.deviceUs, 1'234'567);
  EXPECT_EQ(frame.values[3], 2.5F);
  ASSERT_EQ(frame.filtered.size(), frame.values.size());
  EXPECT_EQ(frame.filtered[4], 0.5F);
}

// What an attacker writes with SQL into a sound recording. %: a block whose checksum is made right.
struct Hostile {
  std::string name;
  std::string sql;
};

class HostileRecording : public ::testing::TestWithParam<Hostile> {};

// crc32 of a block, so that SQL can make lies with right checksums.
void blockCrcFunction(sqlite3_context* context, int, sqlite3_value** values) {
  Block block;
  block.stream = static_cast<Stream>(sqlite3_value_int64(values[0]));
  block.first = sqlite3_value_int64(values[1]);
  block.n = sqlite3_value_int64(values[2]);
  block.t0Us = sqlite3_value_int64(values[3]);
  block.t1Us = sqlite3_value_int64(values[4]);
  block.coding = static_cast<BlockCoding>(sqlite3_value_int64(values[5]));
  const auto* data = static_cast<const std::byte*>(sqlite3_value_blob(values[6]));
  block.data.assign(data, data + sqlite3_value_bytes(values[6]));
  sqlite3_result_int64(context, blockCrc(block));
}

TEST_P(HostileRecording, isRefusedOrReadWithoutHarm) {
  const TemporaryFolder folder;
  const fs::path path = folder / "hostile.palpate";
  writeSamples(path, 50);
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
  sqlite3_create_function(
      db, "block_crc", 7, SQLITE_UTF8, nullptr, blockCrcFunction, nullptr, nullptr);
  sqlite3_db_config(db, SQLITE_DBCONFIG_WRITABLE_SCHEMA, 1, nullptr);
  char* message = nullptr;
  const std::string sql =
      GetParam().sql +
      ";UPDATE block SET crc32=block_crc(stream,first,n,t0_us,t1_us,coding,data) WHERE id=2";
  sqlite3_exec(db, sql.c_str(), nullptr, nullptr, &message);
  if (message) {
    EXPECT_NE(std::string(message).find("block"), std::string::npos) << message;
  }
  sqlite3_free(message);
  sqlite3_close(db);
  const pid_t child = fork();
  if (child == 0) {
    bool refused = false;
    try {
      dumped(openRecording(path));
    } catch (const FormatError& error) {
      refused = std::string(error.what()).find('\n') == std::string::npos;
    }
    const VerifyReport report = verifyRecording(path);
    const bool noticed = report.state != VerifyReport::State::kSound;
    _exit(refused && noticed && !::testing::Test::HasFailure() ? 0 : 1);
  }
  int status = 0;
  rusage usage{};
  ASSERT_EQ(wait4(child, &status, 0, &usage), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "status " << status;
  if (!kSanitized) {
    EXPECT_LT(usage.ru_maxrss, 256 * 1024);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Corpus,
    HostileRecording,
    ::testing::Values(
        Hostile{"manyItems", "UPDATE block SET n=1000000000000 WHERE id=2"},
        Hostile{"negativeItems", "UPDATE block SET n=-1 WHERE id=2"},
        Hostile{"largestFirst", "UPDATE block SET first=9223372036854775807 WHERE id=2"},
        Hostile{"largestTime",
                "UPDATE block SET t0_us=-9223372036854775808,"
                " t1_us=9223372036854775807 WHERE id=2"},
        Hostile{"unknownStream", "UPDATE block SET stream=77 WHERE id=2"},
        Hostile{"unknownCoding", "UPDATE block SET coding=99 WHERE id=2"},
        Hostile{"wrongCoding",
                "UPDATE block SET coding=1-coding WHERE id IN"
                " (SELECT id FROM block WHERE stream=0); UPDATE block SET"
                " crc32=block_crc(stream,first,n,t0_us,t1_us,coding,data)"},
        Hostile{"hugeBlob", "UPDATE block SET data=zeroblob(100000000) WHERE id=2"},
        Hostile{"zeros", "UPDATE block SET data=zeroblob(4000) WHERE id=2"},
        Hostile{"notANumber",
                "UPDATE block SET coding=2, data=CAST(X'00000000' || X'0000000000000000' ||"
                " X'0000C07F' AS BLOB), n=1, t1_us=t0_us WHERE id=2"},
        Hostile{"hugeMatrix", "UPDATE matrix SET rows=65535, columns=65535 WHERE idx=0"},
        Hostile{"manyMatrices",
                "WITH RECURSIVE n(i) AS (SELECT 6 UNION ALL SELECT i+1 FROM n WHERE i<100000)"
                " INSERT INTO matrix SELECT i,14,6,3.4,static_mask,dynamic_mask,'',0 FROM n, matrix"
                " WHERE idx=0"},
        Hostile{"noMatrix", "DELETE FROM matrix"},
        Hostile{"infinitePitch", "UPDATE matrix SET pitch_mm=9e999 WHERE idx=0"},
        Hostile{"manyKeys",
                "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i+1 FROM n WHERE i<100000)"
                " INSERT INTO meta SELECT 'k'||i,'v',0 FROM n"},
        Hostile{"blockIsAView",
                "ALTER TABLE block RENAME TO b; CREATE VIEW block AS SELECT * FROM b"},
        Hostile{"anyView",
                "CREATE VIEW v AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i+1"
                " FROM n) SELECT i FROM n"},
        Hostile{"trigger", "CREATE TRIGGER t AFTER INSERT ON meta BEGIN DELETE FROM block; END"},
        Hostile{"generatedColumn",
                "DROP TABLE event; CREATE TABLE event(id INTEGER PRIMARY KEY, t_us AS"
                " (zeroblob(1000000000)))"},
        Hostile{"indexOnExpression", "CREATE INDEX i ON block(length(zeroblob(id)))"},
        Hostile{"missingTable", "DROP TABLE counter"},
        Hostile{"otherVersion", "PRAGMA user_version=4"},
        Hostile{"otherProgram", "PRAGMA application_id=7"},
        Hostile{"manyFrames",
                "UPDATE meta SET value='9223372036854775807' WHERE key='frames';"
                " DELETE FROM block WHERE id=3"}),
    [](const auto& of) { return of.param.name; });

// C-A1: a recording is read as far as verify counts it as readable.
TEST(PalpateDamage, whatIsReadableIsGivenAndTheRestTold) {
  const TemporaryFolder folder;
  const fs::path path = folder / "r.palpate";
  writeSamples(path, 60);
  const Recording sound = readableRecording(path);
  EXPECT_EQ(sound.damage.text, "");
  EXPECT_EQ(sound.events.size(), 2u);
  EXPECT_TRUE(dumped(sound.profile) == dumped(openRecording(path)));
  const BlockBytes block = blockBytes(path).at(2);
  std::string bytes = readFile(path);
  bytes[block.end - 1] = static_cast<char>(bytes[block.end - 1] ^ 1);
  writeFile(path, bytes);
  const Recording damaged = readableRecording(path);
  EXPECT_EQ(framesOf(damaged.profile).size(), 60 - block.n);
  ASSERT_EQ(damaged.events.size(), 3u);
  EXPECT_EQ(std::count_if(damaged.events.begin(),
                          damaged.events.end(),
                          [](const Event& event) { return event.kind == "gap"; }),
            1)
      << "the lost span, beside the two events of the file";
  ASSERT_EQ(damaged.damage.notInFile.size(), 1u);
  EXPECT_EQ(damaged.damage.notInFile[0].kind, "gap");
  EXPECT_EQ(sound.damage.notInFile.size(), 0u);
  EXPECT_NE(damaged.damage.text.find(std::to_string(block.n) + " lost frame"), std::string::npos)
      << damaged.damage.text;
  writeFile(path, bytes.substr(0, 3000));
  EXPECT_THROW(readableRecording(path), FormatError);
}

// SQLite refuses the whole file; its first pages tell how long it was.
TEST(PalpateDamage, aFileThatWasCutOffTellsHowMuchIsLost) {
  const TemporaryFolder folder;
  const fs::path path = folder / "r.palpate";
  const Profile whole = synthesize({.durationS = 60.0, .grasps = 4, .noiseCounts = 3.0});
  saveRecording(whole, {}, path);
  const std::string bytes = readFile(path);
  for (const double share : {0.3, 0.6, 0.9}) {
    writeFile(path,
              bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size()))));
    const Recording readable = readableRecording(path);
    const std::size_t frames = readable.profile.numFrames();
    ASSERT_GT(frames, 0u) << share;
    ASSERT_LT(frames, whole.numFrames()) << share;
    const std::vector<RecordingLoss> losses = lossesOf(readable.events);
    const auto ofFrames = std::find_if(
        losses.begin(), losses.end(), [](const auto& loss) { return loss.stream == "tactile"; });
    ASSERT_NE(ofFrames, losses.end()) << share;
    EXPECT_EQ(ofFrames->lost, whole.numFrames() - frames) << share;
    EXPECT_NE(
        readable.damage.text.find(std::to_string(whole.numFrames() - frames) + " lost frames"),
        std::string::npos)
        << readable.damage.text;
    EXPECT_EQ(readable.meta.at("frames"), std::to_string(whole.numFrames())) << share;
  }
}

// Notes that are no file, or may not be read, are no reason to refuse the recording beside them.
TEST(PalpateDamage, aDsaIsReadableWhateverLiesInThePlaceOfItsNotes) {
  const TemporaryFolder folder;
  writeSamples(folder / "r.palpate", 60);
  const fs::path path = folder / "r.dsa";
  saveRecording(openRecording(folder / "r.palpate"), {}, path);
  fs::create_directory(folder / "r.dsa.notes.json");
  const Recording readable = readableRecording(path);
  EXPECT_EQ(readable.profile.numFrames(), 60u);
  EXPECT_TRUE(readable.events.empty());
  EXPECT_NE(readable.damage.text.find("r.dsa.notes.json"), std::string::npos)
      << readable.damage.text;
}

// R-5: what info reads, recover saves, whatever bytes are wrong.
TEST(PalpateDamage, whatCanBeReadCanBeSaved) {
  const TemporaryFolder folder;
  std::mt19937 random(5);
  std::size_t readable = 0;
  for (const std::size_t frames : {std::size_t{0}, std::size_t{3}, std::size_t{40}}) {
    const fs::path path = folder / "r.palpate";
    fs::remove(path);
    writeSamples(path, frames);
    const std::string sound = readFile(path);
    for (int round = 0; round < 150; ++round) {
      SCOPED_TRACE(std::to_string(frames) + " frames, round " + std::to_string(round));
      std::string bytes = sound;
      for (unsigned flips = 1 + random() % 4; flips > 0; --flips) {
        const std::size_t at = random() % bytes.size();
        bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1 + random() % 255));
      }
      writeFile(path, bytes);
      bool read = true;
      try {
        readableRecording(path);
      } catch (const Error&) {
        read = false;
      }
      bool saved = false;
      try {
        saved = recoverRecording(path, folder / "out.palpate", Overwrite::kReplace).state !=
                RecoverReport::State::kNothing;
      } catch (const Error&) {
      }
      EXPECT_EQ(read, saved);
      readable += read ? 1 : 0;
    }
  }
  EXPECT_GT(readable, 300u);
}

}  // namespace
}  // namespace palpate::palpate_damage_test
