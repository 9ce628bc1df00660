#include "palpate/emulator/truth.h"

#include "palpate/core/error.h"

#include "testing/testing.h"

namespace palpate::testing::truth_test {
namespace {

TEST(Truth, OneRowPerMatrixAndFrame) {
  const TemporaryFolder folder;
  TruthWriter writer(folder / "truth.csv");
  std::vector<MatrixTruth> truth(2);
  truth[1] = {true, 2.5, 1.0, -2.0, 140.25, 0.5, -0.25, 3.0};
  writer.add(1'417'084'265'123'456, truth);
  writer.finish();
  EXPECT_EQ(readFile(folder / "truth.csv"),
            "time_ms,matrix,contact,force_n,x_mm,y_mm,z_mm,slip_x_taxels,slip_y_taxels,turn_deg\n"
            "1417084265123,0,0,,,,,,,\n"
            "1417084265123,1,1,2.5,1,-2,140.25,0.5,-0.25,3\n");
}

TEST(Truth, HandsWithThreeComponentsHaveTheShear) {
  const TemporaryFolder folder;
  TruthWriter writer(folder / "truth.csv", Overwrite::kRefuse, true);
  std::vector<MatrixTruth> truth(2);
  truth[1] = {true, 2.5, 1.0, -2.0, 140.25, 0.5, -0.25, 3.0, 0.75, -0.5};
  writer.add(1'417'084'265'123'456, truth);
  writer.finish();
  EXPECT_EQ(readFile(folder / "truth.csv"),
            "time_ms,matrix,contact,force_n,x_mm,y_mm,z_mm,slip_x_taxels,slip_y_taxels,turn_deg,"
            "shear_x_n,shear_y_n\n"
            "1417084265123,0,0,,,,,,,,,\n"
            "1417084265123,1,1,2.5,1,-2,140.25,0.5,-0.25,3,0.75,-0.5\n");
}

TEST(Truth, AFileIsNotReplacedUnasked) {
  const TemporaryFolder folder;
  writeFile(folder / "truth.csv", "mine");
  EXPECT_THROW(TruthWriter(folder / "truth.csv"), FileError);
  EXPECT_EQ(readFile(folder / "truth.csv"), "mine");
  EXPECT_NO_THROW(TruthWriter(folder / "truth.csv", Overwrite::kReplace));
  EXPECT_THROW(TruthWriter(folder / "no/such/folder.csv"), FileError);
}

TEST(Truth, AFullDiskIsSaid) {
  TruthWriter* writer = nullptr;
  EXPECT_THROW(
      {
        TruthWriter full("/dev/full", Overwrite::kReplace);
        writer = &full;
      },
      FileError);
  EXPECT_EQ(writer, nullptr);
}

}  // namespace
}  // namespace palpate::testing::truth_test
