// The taxels of a frame as a table: each that is scanned, in wire order, with exact numbers.
#include "palpate/recording/frame_table.h"

#include <memory>
#include <string>
#include <vector>

#include <palpate/model/matrix_layout.h>

#include "testing/testing.h"

namespace palpate::frame_table_test {
namespace {

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

}  // namespace
}  // namespace palpate::frame_table_test
