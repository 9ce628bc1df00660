// Exports of XSENSOR: blocks of a frame, each with the sensors and groups of their sensels.
#include "imports/xsensor_source.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>

#include "palpate/model/hand_file.h"

#include "imports/import_samples.h"

namespace palpate::xsensor_source_test {
namespace {

using testing::errorOf;
using testing::handOf;
using testing::importText;
using testing::TemporaryFolder;
using testing::writeFile;

// A frame of two sensors of 2 x 3; `first` is the first number of the left one.
std::string block(int number, const std::string& time, const std::string& first) {
  return "FRAME," + std::to_string(number) + ",,,,\r\n,,,,,\r\nDate, 2022 Aug 6,,,,\r\nTime, " +
         time +
         ",,,,\r\n"
         "SENSOR,HX-LF S1,,,,\r\nRows,2,,,,\r\nColumns,3,,,,\r\nPeak Pressure (kPa),5,,,,\r\n"
         "SENSELS,,,,,\r\n,,,,,\r\n" +
         first +
         ",1,2,,,\r\n,,,,,\r\n3,4,5.5,,,\r\n"
         "SENSOR,HX-RF S1,,,,\r\nRows,2,,,,\r\nColumns,3,,,,\r\nSENSELS,,,,,\r\n"
         "10,11,12,,,\r\n13,14,15,,,\r\n"
         "GROUP,1,,,,\r\nName,Left Heel,,,,\r\nCells,4,,,,\r\nSENSELS,,,,,\r\n0,0,0,0,0,0\r\n";
}
const std::string kHead =
    "\xEF\xBB\xBF"
    "File:,\"C:\\a, b.XSN\",,,,\r\nUnits:,kPa,,,,\r\n,,,,,\r\n";

HandDescription insoles() {
  return handOf({MatrixLayout::full(2, 3, 8.6), MatrixLayout::full(2, 3, 8.6)});
}

TEST(XsensorSource, EachBlockIsAFrameOfBothInsoles) {
  const TemporaryFolder folder;
  const auto made = importText(
      folder, kHead + block(7, "08:21:17.982", "0") + block(8, "08:21:17.995", "9"), insoles());
  ASSERT_EQ(made.report.frames, 2u) << made.report.refused.first;
  EXPECT_EQ(made.report.refused.total(), 0u);
  // 2022-08-06 08:21:17.982 UTC.
  EXPECT_EQ(made.profile.frameTimeUs(0), 1'659'774'077'982'000);
  EXPECT_EQ(made.profile.frameTimeUs(1), 1'659'774'077'995'000);
  EXPECT_EQ(made.profile.frame(0).values,
            (std::vector<float>{0, 1, 2, 3, 4, 5.5F, 10, 11, 12, 13, 14, 15}));
  EXPECT_EQ(made.profile.frame(1).values[0], 9.0F);
}

TEST(XsensorSource, AFrameWithoutAllItsNumbersIsRefusedWithItsLine) {
  const TemporaryFolder folder;
  for (const auto& [part, with, why] : std::vector<std::array<std::string, 3>>{
           {"3,4,5.5,,,\r\n", "", "has 1 row instead of 2"},
           {"3,4,5.5,,,\r\nSENSOR,HX-RF S1,,,,\r\nRows,2,,,,\r\n",  // of two faults the first
            "SENSOR,HX-RF S1,,,,\r\n",
            "\"HX-LF S1\" has 1 row instead of 2"},
           {"3,4,5.5,,,\r\n", "3,4,5.5,6,,\r\n", "has 4 numbers instead of 3"},
           {"HX-RF S1", "HX-RF S2", "without \"right HX-RF S1\""},
           {"Rows,2,,,,\r\n", "", "without the rows and columns of \"HX-LF S1\""}}) {
    std::string damaged = block(8, "08:21:17.995", "9");
    damaged.replace(damaged.find(part), part.size(), with);
    const auto made =
        importText(folder,
                   kHead + block(7, "08:21:17.982", "0") + damaged + block(9, "08:21:18.008", "8"),
                   insoles());
    EXPECT_EQ(made.report.frames, 2u) << why;
    EXPECT_EQ(made.report.refused.total(), 1u) << why;
    EXPECT_NE(made.report.refused.first.find(why), std::string::npos) << made.report.refused.first;
    EXPECT_NE(made.report.refused.first.find("line 28 "), std::string::npos)
        << made.report.refused.first;
  }
}

TEST(XsensorSource, KnowsItsFilesAndTheirPlaces) {
  const TemporaryFolder folder;
  writeFile(folder / "a.csv", kHead + block(7, "08:21:17.982", "x"));
  writeFile(folder / "b.csv", "FRAME,1\n1,2,3\n");
  EXPECT_TRUE(XsensorSource::isExport(folder / "a.csv"));
  EXPECT_FALSE(XsensorSource::isExport(folder / "b.csv"));
  // "x" ends the rows at once.
  EXPECT_NE(errorOf([&] { openTable(folder / "a.csv"); }).find("has 0 rows instead of 2"),
            std::string::npos);
  writeFile(folder / "c.csv", kHead + block(7, "08:21:17.982", "0"));
  const auto table = openTable(folder / "c.csv");
  ASSERT_EQ(table->columns().size(), 4u);
  EXPECT_EQ(table->columns()[2].name, "left HX-LF S1");
  EXPECT_EQ(table->columns()[2].unit, "kPa");
  EXPECT_EQ(table->columns()[2].shape, (std::vector<std::size_t>{2, 3}));
  const std::vector<std::size_t> right = {0, 3};
  table->start(right, 1);
  TableRow row;
  ASSERT_TRUE(table->next(row));
  EXPECT_EQ(row.values, (std::vector<double>{7, 10, 11, 12, 13, 14, 15}));
  EXPECT_EQ(row.time.text, "2022-08-06 08:21:17.982");
  EXPECT_EQ(table->textOf(5), "14");
  EXPECT_EQ(table->placeOf(5), "\"right HX-RF S1\", row 1, column 1: \"14\"");
  EXPECT_FALSE(table->next(row));
}

// The maker's own figures of each frame, read independently from the text.
TEST(XsensorSource, AveragesAndPeaksAreThoseOfTheMaker) {
  const auto arrays = testing::arraysFolder();
  if (!arrays) GTEST_SKIP() << "no files of other makers: set PALPATE_ARRAYS";
  const std::filesystem::path xsensor = *arrays / "xsensor_insole";
  std::vector<double> averages;
  std::vector<double> peaks;
  std::ifstream text(xsensor / "xsensor_data.csv");
  bool isLeft = false;
  for (std::string line; std::getline(text, line);) {
    const auto number = [&] { return std::atof(line.c_str() + line.find(',') + 1); };
    if (line.starts_with("SENSOR,")) isLeft = line.find("-LF") != std::string::npos;
    if (line.starts_with("GROUP,")) isLeft = false;
    if (isLeft && line.starts_with("Average Pressure")) averages.push_back(number());
    if (isLeft && line.starts_with("Peak Pressure")) peaks.push_back(number());
  }
  const TemporaryFolder folder;
  importRecording(
      xsensor / "xsensor_data.csv", readHandFolder(xsensor / "hand"), {}, folder / "o.palpate");
  const Profile profile = openRecording(folder / "o.palpate");
  ASSERT_EQ(profile.numFrames(), 101u);
  ASSERT_EQ(averages.size(), 101u);
  for (std::size_t i = 0; i < averages.size(); ++i) {
    double sum = 0.0;
    double peak = 0.0;
    int active = 0;
    for (const float value : profile.frame(i).values) {
      sum += static_cast<double>(value);
      peak = std::max(peak, static_cast<double>(value));
      active += value > 0.0F ? 1 : 0;
    }
    // The maker writes two decimals.
    EXPECT_NEAR(active > 0 ? sum / active : 0.0, averages[i], 0.006) << i;
    EXPECT_NEAR(peak, peaks[i], 0.006) << i;
  }
}

}  // namespace
}  // namespace palpate::xsensor_source_test
