// Recordings of taxels that aren't square, in every format that is read back.
#include <fstream>

#include <sqlite3.h>

#include "palpate/core/error.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/crop.h"
#include "palpate/recording/recording.h"

#include "testing/testing.h"

namespace palpate::pitch_test {
namespace {

using namespace testing;

constexpr TaxelPitch kNovel(5.28, 10.28);

Profile recorded(const TaxelPitch& first = kNovel) {
  ProfileBuilder builder(std::make_shared<const SensorLayout>(
      std::vector{MatrixLayout::full(2, 3, first), MatrixLayout::full(1, 2, 4.0)}));
  for (int i = 0; i < 40; ++i)
    builder.addFrame(1'000'000 + 10'000 * i, std::vector<float>(8, static_cast<float>(i)));
  return builder.finish({});
}

TEST(Pitch, BothNumbersComeBackInEveryFormat) {
  const TemporaryFolder folder;
  for (const char* name : {"a.palpate", "a.h5", "a.mcap", "a.dsa"}) {
    const auto path = folder / name;
    saveRecording(recorded(), {}, path);
    const Profile read = openRecording(path);
    EXPECT_EQ(read.layout(), recorded().layout()) << name;
    EXPECT_EQ(read.layout().matrix(0).pitchMm, kNovel) << name;
    EXPECT_EQ(read.frame(39).values, recorded().frame(39).values) << name;
    EXPECT_EQ(verifyRecording(path).state, VerifyReport::State::kSound) << name;
    const auto cut = folder / ("cut_" + std::string(name));
    saveRecording(cropped(read, 3, 9), {}, cut);
    EXPECT_EQ(openRecording(cut).layout().matrix(0).pitchMm, kNovel) << name;
  }
}

// The last byte of the user_version, which is at byte 60 of an SQLite file.
char versionOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(63);
  return static_cast<char>(file.get());
}

TEST(Pitch, OnlyTaxelsThatArentSquareNeedANewVersion) {
  const TemporaryFolder folder;
  saveRecording(recorded(), {}, folder / "two.palpate");
  saveRecording(recorded(5.28), {}, folder / "one.palpate");
  EXPECT_EQ(versionOf(folder / "two.palpate"), 3);
  EXPECT_EQ(versionOf(folder / "one.palpate"), 1);
}

TEST(Pitch, ADamagedOneIsNoticed) {
  const TemporaryFolder folder;
  const auto path = folder / "a.palpate";
  saveRecording(recorded(), {}, path);
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
  EXPECT_EQ(
      sqlite3_exec(db, "UPDATE matrix SET pitch_y_mm=5.28 WHERE idx=0", nullptr, nullptr, nullptr),
      SQLITE_OK);
  sqlite3_close(db);
  EXPECT_THROW(openRecording(path), FormatError);
}

}  // namespace
}  // namespace palpate::pitch_test
