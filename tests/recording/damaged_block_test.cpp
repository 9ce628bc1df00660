// A damaged block in a long recording costs its own samples and nothing else: times, searches and
// all other blocks stay what they were, and no block is read on the way to another one.
#include <string>

#include <sqlite3.h>

#include "palpate/core/error.h"
#include "palpate/playback/playback.h"
#include "palpate/recording/palpate_reader.h"
#include "palpate/recording/palpate_schema.h"

#include "recording/faulty_vfs.h"
#include "recording/long_samples.h"
#include "testing/testing.h"

namespace palpate::damaged_block_test {
namespace {
namespace fs = std::filesystem;
using namespace testing;

constexpr std::size_t kFrames = 60'000;  // some hundred blocks

struct BlockRow {
  std::int64_t id = 0;
  std::size_t first = 0;
  std::size_t last = 0;
};

std::vector<BlockRow> blocksOf(const fs::path& path, Stream stream) {
  std::vector<BlockRow> blocks;
  sqlite3* db = nullptr;
  EXPECT_EQ(sqlite3_open_v2(path.c_str(), &db, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
  const std::string sql =
      "SELECT id, first, n FROM block WHERE stream=" + std::to_string(static_cast<int>(stream)) +
      " ORDER BY first";
  sqlite3_stmt* rows = nullptr;
  EXPECT_EQ(sqlite3_prepare_v2(db, sql.c_str(), -1, &rows, nullptr), SQLITE_OK);
  while (sqlite3_step(rows) == SQLITE_ROW) {
    const auto first = static_cast<std::size_t>(sqlite3_column_int64(rows, 1));
    const auto n = static_cast<std::size_t>(sqlite3_column_int64(rows, 2));
    blocks.push_back({sqlite3_column_int64(rows, 0), first, first + n - 1});
  }
  sqlite3_finalize(rows);
  sqlite3_close(db);
  return blocks;
}

// Only the data of the block: the table of the blocks stays as it was.
void damage(const fs::path& path, std::int64_t id) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
  const std::string sql =
      "UPDATE block SET data=zeroblob(length(data)) WHERE id=" + std::to_string(id);
  EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(db);
}

enum class Place { kFirst, kMiddle, kLast };
const BlockRow& blockAt(const std::vector<BlockRow>& blocks, Place place) {
  if (place == Place::kFirst) return blocks.front();
  return place == Place::kLast ? blocks.back() : blocks[blocks.size() / 2];
}

class DamagedBlock : public ::testing::TestWithParam<Place> {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    writeLong(*folder_ / "sound.palpate", kFrames, true);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  // A copy of the recording with a damaged block of a stream, and which one it is.
  std::pair<fs::path, BlockRow> damaged(Stream stream) {
    const fs::path path = *folder_ / "damaged.palpate";
    fs::copy_file(*folder_ / "sound.palpate", path, fs::copy_options::overwrite_existing);
    const auto blocks = blocksOf(path, stream);
    EXPECT_GT(blocks.size(), 5u);
    const BlockRow hit = blockAt(blocks, GetParam());
    damage(path, hit.id);
    return {path, hit};
  }
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

TEST_P(DamagedBlock, OfFramesCostsItsFramesOnly) {
  const auto [path, hit] = damaged(Stream::kTactile);
  const Profile profile = readPalpate(path).profile;
  ASSERT_EQ(profile.numFrames(), kFrames);
  UnreadableSamples unreadable;
  TactileFrame frame;
  std::int64_t beforeUs = longStampUs(0) - 1;
  for (std::size_t i = 0; i < kFrames; ++i) {
    const bool lost = hit.first <= i && i <= hit.last;
    ASSERT_EQ(profile.readFrame(i, frame, &unreadable), !lost) << i;
    ASSERT_GT(frame.hostUs, beforeUs) << i;
    beforeUs = frame.hostUs;
    ASSERT_EQ(profile.frameAt(frame.hostUs), i);
    if (lost) continue;
    ASSERT_EQ(frame.hostUs, longStampUs(i));
    ASSERT_EQ(frame.values[0], longValue(i)) << i;
    ASSERT_EQ(profile.anglesAtFrame(i)->values[0], static_cast<double>(i % 90)) << i;
  }
  EXPECT_EQ(unreadable.runs, (std::vector<UnreadableSamples::Run>{{hit.first, hit.last}}));
  // The first and the last time of the block stand in the table of the blocks.
  EXPECT_EQ(profile.frameTimeUs(hit.first), longStampUs(hit.first));
  EXPECT_EQ(profile.frameTimeUs(hit.last), longStampUs(hit.last));
  try {
    profile.readFrame(hit.first, frame);
    ADD_FAILURE() << "a damaged frame was shown";
  } catch (const FormatError& error) {
    EXPECT_NE(std::string(error.what()).find("block " + std::to_string(hit.id) + " is damaged"),
              std::string::npos)
        << error.what();
  }
}

TEST_P(DamagedBlock, OfAnglesCostsItsAnglesOnly) {
  const auto [path, hit] = damaged(Stream::kAngles);
  const Profile profile = readPalpate(path).profile;
  ASSERT_EQ(profile.numAngles(), kFrames);
  for (std::size_t i = 0; i < kFrames; ++i) {
    ASSERT_EQ(profile.angleSampleAt(profile.angleTimeUs(i)), i);
    if (hit.first <= i && i <= hit.last) continue;
    ASSERT_EQ(profile.angles(i).values[0], static_cast<double>(i % 90)) << i;
  }
  EXPECT_THROW((void)profile.angles(hit.last), FormatError);
  EXPECT_EQ(profile.frame(hit.first).values[0], longValue(hit.first));
}

INSTANTIATE_TEST_SUITE_P(At,
                         DamagedBlock,
                         ::testing::Values(Place::kFirst, Place::kMiddle, Place::kLast),
                         [](const auto& of) {
                           return of.param == Place::kFirst    ? "first"
                                  : of.param == Place::kMiddle ? "middle"
                                                               : "last";
                         });

TEST(DamagedBlockReads, AStreamWithoutASoundBlockIsLeftOut) {
  const TemporaryFolder folder;
  const fs::path path = folder / "r.palpate";
  constexpr std::size_t kFew = 500;
  writeLong(path, kFew, true);
  for (const BlockRow& block : blocksOf(path, Stream::kAngles)) damage(path, block.id);
  const Profile profile = readPalpate(path).profile;
  EXPECT_EQ(profile.numAngles(), 0u);
  ASSERT_EQ(profile.numFrames(), kFew);
  EXPECT_EQ(profile.frame(kFew - 1).values[0], longValue(kFew - 1));
  EXPECT_EQ(profile.anglesAtFrame(0), std::nullopt);
  EXPECT_EQ(profile.info().warnings,
            std::vector<std::string>{"all joint angles are damaged and left out"});
}

// Each block fills about a page of the file.
TEST(DamagedBlockReads, ASeekReadsTheBlockThatItShowsAndNoOther) {
  const TemporaryFolder folder;
  const fs::path path = folder / "r.palpate";
  writeLong(path, kFrames, true);
  const auto blocks = blocksOf(path, Stream::kTactile);
  ASSERT_GT(blocks.size(), 200u);
  FaultyVfs files(true);
  int reads = 0;
  files.setReadHook([&](std::int64_t) { ++reads; });
  Playback playback(readPalpate(path).profile, {});
  ASSERT_GT(reads, 0) << "the reading isn't seen";
  TactileFrame frame;
  // Never the same block twice; the way of the search would be new each time.
  for (std::size_t k = 1; k < 40; ++k) {
    const BlockRow& block = blocks[k * 89 % blocks.size()];
    const std::size_t wanted = (block.first + block.last) / 2;
    const bool byTime = k % 2 == 0;
    constexpr int kPagesAbove = 3;  // of the tree that leads to the block
    reads = 0;
    if (byTime)
      playback.seekTime(longStampUs(wanted) + 1);
    else
      playback.seekFrame(wanted);
    ASSERT_EQ(playback.frame(), wanted);
    playback.profile().readFrame(playback.frame(), frame);
    EXPECT_EQ(frame.values[0], longValue(wanted));
    EXPECT_LE(reads, 1 + kPagesAbove) << "frame " << wanted;
  }
}

TEST(DamagedBlockReads, ADamagedBlockIsReadOnce) {
  const TemporaryFolder folder;
  const fs::path path = folder / "r.palpate";
  writeLong(path, kFrames, true);
  const auto blocks = blocksOf(path, Stream::kTactile);
  const BlockRow& hit = blocks[blocks.size() / 2];
  damage(path, hit.id);
  FaultyVfs files(true);
  const Profile profile = readPalpate(path).profile;
  TactileFrame frame;
  EXPECT_THROW(profile.readFrame(hit.first, frame), FormatError);
  files.setReadHook([](std::int64_t) { ADD_FAILURE() << "read again"; });
  for (std::size_t i = hit.first; i <= hit.last; ++i)
    EXPECT_THROW(profile.readFrame(i, frame), FormatError);
}

}  // namespace
}  // namespace palpate::damaged_block_test
