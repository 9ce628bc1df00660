#include "palpate/recording/table_export.h"

#include <memory>
#include <string>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"
#include "palpate/model/matrix_layout.h"
#include "palpate/model/profile_builder.h"

#include "testing/testing.h"

namespace palpate::table_export_test {
namespace {

Profile twoFrames() {
  ProfileBuilder builder(sdh2().layout);
  std::vector<float> values(486, 0.0F);
  builder.addFrame(1'400'000'000'000'000, values);
  values[84 + 8 * 6 + 2] = 7.0F;
  values[485] = 2.5F;
  builder.addFrame(1'400'000'000'032'000, values);
  builder.addAngles(1'400'000'000'001'000, std::vector<double>{60.0, -10.5});
  return builder.finish({});
}

TEST(CsvExport, WritesActiveTaxelsAndTheSamplesBeside) {
  const testing::TemporaryFolder folder;
  writeCsv(twoFrames(), folder / "a.csv");
  EXPECT_EQ(testing::readFile(folder / "a.csv"),
            "frame,time_ms,matrix,y,x,value,time_us\n"
            "1,1400000000032,1,8,2,7,1400000000032000\n"
            "1,1400000000032,5,12,5,2.5,1400000000032000\n");
  EXPECT_EQ(testing::readFile(folder / "a.csv.angles.csv").find("sample,time_ms,"), 0u);
  EXPECT_NE(testing::readFile(folder / "a.csv.angles.csv")
                .find("0,1400000000001,60,-10.5,1400000000001000\n"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.csv.temperatures.csv"));
}

// arrays A9
TEST(CsvExport, ASlidingAxisIsInMillimetres) {
  HandDescription hand;
  hand.name = "gripper";
  hand.layout = std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(1, 1, 1.0)});
  hand.axes.resize(2);
  hand.axes[0].isSliding = true;
  ProfileBuilder builder(hand);
  builder.addFrame(0, std::vector<float>{1.0F});
  builder.addAngles(1500, std::vector<double>{41.5, 10.0});
  builder.addTemperatures(2500, std::vector<double>{30.5});
  const testing::TemporaryFolder folder;
  writeCsv(builder.finish({}), folder / "a.csv", Overwrite::kRefuse, {}, true);
  EXPECT_EQ(testing::readFile(folder / "a.csv.angles.csv"),
            "sample,time_ms,axis0_mm,axis1_deg,time_us\n,ms,mm,deg,us\n0,1,41.5,10,1500\n");
  EXPECT_EQ(testing::readFile(folder / "a.csv.temperatures.csv"),
            "sample,time_ms,sensor0_degc,time_us\n,ms,degC,us\n0,2,30.5,2500\n");
}

TEST(CsvExport, ReplacesNothingUnasked) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder / "a.csv.angles.csv", "precious");
  EXPECT_THROW(writeCsv(twoFrames(), folder / "a.csv"), FileError);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.csv"));
  EXPECT_EQ(testing::readFile(folder / "a.csv.angles.csv"), "precious");
}

// The arrays are read back by NumPy in tests/python; here the form of the file.
TEST(NpzExport, IsAZipOfArrays) {
  const testing::TemporaryFolder folder;
  writeNpz(twoFrames(), {}, folder / "a.npz");
  const std::string bytes = testing::readFile(folder / "a.npz");
  EXPECT_EQ(bytes.substr(0, 4), "PK\x03\x04");
  for (const char* name : {"time_ms.npy", "time_us.npy", "m5.npy", "static_mask.npy", "meta.npy"})
    EXPECT_NE(bytes.find(name), std::string::npos) << name;
  EXPECT_NE(bytes.find("'descr': '<f4'"), std::string::npos);  // fractional values
  EXPECT_NE(bytes.find("'shape': (2, 13, 6, )"), std::string::npos);
}

// C-A14: whole milliseconds are rounded down before 1970, too.
TEST(CsvExport, RoundsTimesBefore1970Down) {
  const testing::TemporaryFolder folder;
  ProfileBuilder builder(sdh2().layout);
  std::vector<float> values(486, 0.0F);
  values[0] = 3.0F;
  builder.addFrame(-1'500, values);
  builder.addFrame(-500, values);
  writeCsv(builder.finish({}), folder / "a.csv");
  EXPECT_EQ(testing::readFile(folder / "a.csv"),
            "frame,time_ms,matrix,y,x,value,time_us\n"
            "0,-2,0,0,0,3,-1500\n1,-1,0,0,0,3,-500\n");
}

// C-A14: of the files of one export none appears when one can't be written.
TEST(CsvExport, TheFilesAppearTogetherOrNotAtAll) {
  const testing::TemporaryFolder folder;
  ProfileBuilder builder(sdh2().layout);
  builder.addFrame(0, std::vector<float>(486, 1.0F));
  builder.addAngles(0, std::vector<double>(7, 1.0));
  builder.addTemperatures(0, std::vector<double>(9, 30.0));
  const Profile profile = builder.finish({});
  // The name of one is taken while the files are being written.
  EXPECT_THROW(writeCsv(profile,
                        folder / "a.csv",
                        Overwrite::kRefuse,
                        [&](double) {
                          testing::writeFile(folder / "a.csv", "mine");
                          return true;
                        }),
               FileError);
  EXPECT_EQ(testing::readFile(folder / "a.csv"), "mine");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

using Row = std::vector<std::string>;

TEST(FrameTable, ARowPerTaxelThatIsScannedMatrixAfterMatrix) {
  MatrixLayout small;
  small.rows = 2;
  small.columns = 2;
  small.pitchMm = 3.4;
  small.staticMask = small.dynamicMask = {1, 1, 1, 1};
  MatrixLayout masked = small;
  masked.dynamicMask[1] = 0;
  const auto layout = std::make_shared<const SensorLayout>(std::vector{small, masked});
  TactileFrame frame(layout);
  frame.hostUs = 1'234'567;
  frame.matrix(0)(0, 1) = 7.0F;
  frame.matrix(1)(1, 0) = 0.5F;
  const TextTable table = taxelTable(frame, "42");
  EXPECT_EQ(table.header, (Row{"frame", "time_ms", "matrix", "y", "x", "value"}));
  ASSERT_EQ(table.numRows, 7u) << "8 places, one of them masked";
  EXPECT_EQ(table.row(0), (Row{"42", "1234", "0", "0", "0", "0"}));
  EXPECT_EQ(table.row(1), (Row{"42", "1234", "0", "0", "1", "7"}));
  EXPECT_EQ(table.row(4), (Row{"42", "1234", "1", "0", "0", "0"}));
  EXPECT_EQ(table.row(5), (Row{"42", "1234", "1", "1", "0", "0.5"})) << "(0, 1) is not scanned";
}

// The first taxel was not active as recorded; the heat map draws its filtered value all the same.
TEST(FrameTable, FilteredValuesAreThoseThatAreDrawn) {
  MatrixLayout row;
  row.rows = 1;
  row.columns = 2;
  row.pitchMm = 3.4;
  row.staticMask = row.dynamicMask = {1, 1};
  TactileFrame frame(std::make_shared<const SensorLayout>(std::vector{row}));
  frame.setFiltered({188.5F, 12.0F}, {false, true});
  ASSERT_EQ(frame.matrix(0)(0, 0), 0.0F);
  const TextTable table = taxelTable(frame, "1200");
  EXPECT_EQ(table.row(0), (Row{"1200", "0", "0", "0", "0", "188.5"}));
  EXPECT_EQ(table.row(1), (Row{"1200", "0", "0", "0", "1", "12"}));
}

}  // namespace
}  // namespace palpate::table_export_test
