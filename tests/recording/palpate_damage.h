// Damage to native recordings, for the short and the long form of its tests (R4, R5).
#pragma once

#include <csignal>
#include <random>
#include <set>

#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/recording/palpate_recovery.h"
#include "palpate/recording/recording.h"

#include "recording/palpate_samples.h"
#include "testing/testing.h"

namespace palpate::testing {

// Where a block's row lies in the file, and which frames it holds.
struct BlockBytes {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t first = 0;
  std::size_t n = 0;
};

// Bytes of an integer in a row (sqlite.org/fileformat2.html, serial types).
inline std::size_t integerBytes(std::int64_t v) {
  if (v == 0 || v == 1) return 0;
  for (const int bits : {8, 16, 24, 32, 48})
    if (v >= -(std::int64_t{1} << (bits - 1)) && v < std::int64_t{1} << (bits - 1))
      return static_cast<std::size_t>(bits) / 8;
  return 8;
}

// The tactile blocks of an undamaged file: found with SQL, then by their bytes.
inline std::vector<BlockBytes> blockBytes(const std::filesystem::path& path) {
  std::vector<BlockBytes> blocks;
  const std::string file = readFile(path);
  sqlite3* db = nullptr;
  EXPECT_EQ(sqlite3_open_v2(path.c_str(), &db, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
  sqlite3_stmt* rows = nullptr;
  EXPECT_EQ(sqlite3_prepare_v2(db,
                               "SELECT stream, first, n, t0_us, t1_us, coding, crc32, data "
                               "FROM block WHERE stream=0",
                               -1,
                               &rows,
                               nullptr),
            SQLITE_OK);
  while (sqlite3_step(rows) == SQLITE_ROW) {
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(rows, 7));
    const std::string data(static_cast<const char*>(sqlite3_column_blob(rows, 7)), size);
    BlockBytes block;
    const std::size_t at = file.find(data);
    EXPECT_EQ(file.find(data, at + 1), std::string::npos);
    const std::size_t blobType = 2 * size + 12;
    std::size_t before = 1 + 1 + 7 + (blobType < 128 ? 1 : blobType < 16384 ? 2 : 3);
    for (int column = 0; column < 7; ++column)
      before += integerBytes(sqlite3_column_int64(rows, column));
    block.begin = at - before;
    block.end = at + size;
    block.first = static_cast<std::size_t>(sqlite3_column_int64(rows, 1));
    block.n = static_cast<std::size_t>(sqlite3_column_int64(rows, 2));
    blocks.push_back(block);
  }
  sqlite3_finalize(rows);
  sqlite3_close(db);
  return blocks;
}

// Numbers of the frames in a profile; each must have the values that were written under its number.
inline std::set<std::size_t> framesOf(const Profile& profile) {
  std::set<std::size_t> found;
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    profile.readFrame(i, frame);
    const auto number = static_cast<std::size_t>((frame.hostUs - kSampleStartUs) / kSampleStepUs);
    const TactileFrame expected = sampleFrame(number);
    EXPECT_EQ(frame.hostUs, expected.hostUs);
    EXPECT_EQ(frame.deviceUs, expected.deviceUs);
    EXPECT_TRUE(frame.values == expected.values) << "frame " << number << " is wrong";
    EXPECT_TRUE(found.insert(number).second) << "frame " << number << " is there twice";
  }
  return found;
}

// R5. Cuts the file or changes bytes anywhere; every frame of every block that was not hit comes
// back, none is wrong, and opening gives right frames or an error.
class DamageRun {
 public:
  explicit DamageRun(std::size_t numFrames) : numFrames_(numFrames) {
    writeSamples(folder_ / "sound.palpate", numFrames);
    sound_ = readFile(folder_ / "sound.palpate");
    blocks_ = blockBytes(folder_ / "sound.palpate");
  }

  void round(unsigned seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::string bytes = sound_;
    if (seed % 3 == 0) bytes.resize(random() % bytes.size());
    std::set<std::size_t> hit;
    const int flips = seed % 3 == 0 && seed % 2 == 0 ? 0 : 1 + static_cast<int>(random() % 100);
    // The first pages hold what SQLite needs most.
    const std::size_t range =
        seed % 5 == 0 ? std::min<std::size_t>(bytes.size(), 8192) : bytes.size();
    for (int i = 0; i < flips && range > 0; ++i) {
      const std::size_t at = random() % range;
      if (!hit.insert(at).second) continue;
      bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1 + random() % 255));
    }
    const std::filesystem::path path = folder_ / "damaged.palpate";
    writeFile(path, bytes);
    std::set<std::size_t> expected;
    for (const BlockBytes& block : blocks_) {
      const auto next = hit.lower_bound(block.begin);
      if (block.end > bytes.size() || (next != hit.end() && *next < block.end)) continue;
      for (std::size_t i = block.first; i < block.first + block.n; ++i) expected.insert(i);
    }
    check(path, expected);
  }

  std::size_t framesExpected() const { return framesExpected_; }
  std::size_t framesSaved() const { return framesSaved_; }
  std::size_t rounds() const { return rounds_; }

 private:
  void check(const std::filesystem::path& path, const std::set<std::size_t>& expected) {
    std::set<std::size_t> found;
    const PalpateRecovery recovery = recoverPalpateProfile(path);
    if (recovery.profile) found = framesOf(*recovery.profile);
    EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()))
        << "saved " << found.size() << " of " << expected.size() << " intact frames";
    EXPECT_TRUE(found.size() == numFrames_ || !recovery.whole());
    const VerifyReport report = verifyRecording(path);
    EXPECT_TRUE(found.size() == numFrames_ || report.state != VerifyReport::State::kSound);
    EXPECT_EQ(report.message.find('\n'), std::string::npos) << report.message;
    try {
      framesOf(openRecording(path));
    } catch (const FormatError&) {
    } catch (const FileError&) {
    }
    framesExpected_ += expected.size();
    framesSaved_ += found.size();
    ++rounds_;
  }

  TemporaryFolder folder_;
  std::size_t numFrames_;
  std::string sound_;
  std::vector<BlockBytes> blocks_;
  std::size_t framesExpected_ = 0;
  std::size_t framesSaved_ = 0;
  std::size_t rounds_ = 0;
};

// R4. Recovery in a process of its own, killed after `spin` turns of a loop; then again,
// undisturbed.
class KilledRecovery {
 public:
  KilledRecovery() {
    writeSamples(folder_ / "in.palpate", 2000);
    input_ = readFile(folder_ / "in.palpate");
    for (std::size_t at = 20'000; at < input_.size(); at += 60'000) input_[at] ^= 0x55;
    writeFile(folder_ / "in.palpate", input_);
    EXPECT_EQ(recoverRecording(folder_ / "in.palpate", folder_ / "whole.palpate").state,
              RecoverReport::State::kPart);
    undisturbed_ = readFile(folder_ / "whole.palpate");
  }

  void round(unsigned spin) {
    SCOPED_TRACE("spin " + std::to_string(spin));
    const TemporaryFolder out;
    const pid_t child = fork();
    if (child == 0) {
      recoverRecording(folder_ / "in.palpate", out / "out.palpate");
      _exit(0);
    }
    volatile unsigned wait = spin;  // some part of the work; no clock decides anything
    while (wait > 0) wait = wait - 1;
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    killed_ += WIFSIGNALED(status) ? 1 : 0;
    EXPECT_TRUE(readFile(folder_ / "in.palpate") == input_) << "the input was touched";
    if (std::filesystem::exists(out / "out.palpate")) {
      EXPECT_TRUE(readFile(out / "out.palpate") == undisturbed_) << "half an output";
    }
    recoverRecording(folder_ / "in.palpate", out / "out.palpate", Overwrite::kReplace);
    EXPECT_TRUE(readFile(out / "out.palpate") == undisturbed_);
  }
  int killed() const { return killed_; }

 private:
  TemporaryFolder folder_;
  std::string input_;
  std::string undisturbed_;
  int killed_ = 0;
};

}  // namespace palpate::testing
