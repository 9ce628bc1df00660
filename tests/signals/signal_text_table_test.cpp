// The signals of a frame as a table: a row per matrix, all together last; numbers worked out by
// hand.
#include "palpate/signals/signal_text_table.h"

#include <string>
#include <vector>

#include <palpate/model/hand_description.h>

#include "testing/testing.h"

namespace palpate::signal_text_table_test {
namespace {

using Row = std::vector<std::string>;

TEST(SignalTextTable, ARowPerMatrixAndAllLast) {
  const HandDescription hand = sdh2();
  TactileFrame frame(hand.layout);
  frame.matrix(1)(7, 2) = 100.0F;
  frame.matrix(1)(7, 3) = 300.0F;
  frame.matrix(4)(0, 0) = 50.0F;
  const TextTable table = signalTextTable(frame, hand);
  ASSERT_EQ(table.numRows, hand.matrices.size() + 1);
  ASSERT_EQ(table.header.size(), 8u);
  const Row one = table.row(1);
  EXPECT_EQ(one[0], hand.matrixName(1));
  EXPECT_EQ(one[1], "2");
  EXPECT_EQ(one[2], "200");  // the mean of 100 and 300
  EXPECT_EQ(one[4], "300");
  EXPECT_EQ(one[5], "100");
  EXPECT_EQ(one[6], "400");
  EXPECT_DOUBLE_EQ(std::stod(one[7]), 2 * 3.4 * 3.4);  // two taxels of 3.4 mm
  const Row all = table.row(hand.matrices.size());
  EXPECT_EQ(all[0], "all");
  EXPECT_EQ(all[1], "3");
  EXPECT_EQ(all[2], "150");
  EXPECT_EQ(all[6], "450");
  EXPECT_EQ(table.row(0)[1], "0") << "nothing touches this matrix";
}

}  // namespace
}  // namespace palpate::signal_text_table_test
