#include "palpate/core/file_series.h"

#include "testing/testing.h"

namespace palpate::file_series_test {
namespace {

namespace fs = std::filesystem;

FileSeries series(const fs::path& folder, std::size_t first, std::size_t last) {
  return {.folder = folder, .stem = "ball", .ending = ".png", .first = first, .last = last};
}

TEST(FileSeries, NamesSortLikeTheirNumbers) {
  EXPECT_EQ(series("f", 9, 42).name(42), "ball_00042.png");
  EXPECT_EQ(series("f", 9, 42).path(9), fs::path("f") / "ball_00009.png");
  const FileSeries day = series("f", 0, 2'737'152);
  EXPECT_EQ(day.name(7), "ball_0000007.png");
  EXPECT_LT(day.name(999'999), day.name(1'000'000));
  FileSeries unnamed = series("f", 0, 9);
  unnamed.stem.clear();
  EXPECT_EQ(unnamed.name(3), "00003.png");
}

TEST(FileSeries, BothEndsCount) {
  EXPECT_EQ(series("f", 10, 19).count(), 10u);
  EXPECT_EQ(series("f", 10, 10).count(), 1u);
  EXPECT_EQ(series("f", 10, 9).count(), 0u);
}

TEST(FileSeries, CountsWhatIsThereAndNothingElse) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(numExisting(series(folder / "none", 0, 9)), 0u);
  for (const char* name : {"ball_00003.png",
                           "ball_00009.png",
                           "ball_00010.png",
                           "ball_3.png",
                           "ball_000003.png",
                           "ball_00004.svg",
                           "ball_.png",
                           "ball_-0005.png",
                           "other_00005.png"})
    testing::writeFile(folder / name, "");
  EXPECT_EQ(numExisting(series(folder.path(), 0, 9)), 2u);
  EXPECT_EQ(numExisting(series(folder.path(), 4, 8)), 0u);
}

TEST(FileSeries, TheNextFreeNameCountsFromTwo) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(freePath(folder / "a.b.png"), folder / "a.b.png");
  testing::writeFile(folder / "a.b.png", "");
  EXPECT_EQ(freePath(folder / "a.b.png"), folder / "a.b_2.png");
  testing::writeFile(folder / "a.b_2.png", "");
  EXPECT_EQ(freePath(folder / "a.b.png"), folder / "a.b_3.png");
  fs::create_directory(folder / "pictures");
  EXPECT_EQ(freePath(folder / "pictures"), folder / "pictures_2");
  fs::create_symlink(folder / "nowhere", folder / "link.png");
  EXPECT_EQ(freePath(folder / "link.png"), folder / "link_2.png");
}

}  // namespace
}  // namespace palpate::file_series_test
