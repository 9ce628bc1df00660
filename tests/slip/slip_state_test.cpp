#include "palpate/slip/slip_state.h"

#include <gtest/gtest.h>

namespace palpate::slip_state_test {
namespace {

// The names in the column `state` are part of the documented interface (docs/manual/columns.md).
TEST(SlipState, HasTheWordsOfTheTable) {
  EXPECT_EQ(nameOf(SlipState::kStill), "still");
  EXPECT_EQ(nameOf(SlipState::kLoading), "loading");
  EXPECT_EQ(nameOf(SlipState::kLoadShift), "load_shift");
  EXPECT_EQ(nameOf(SlipState::kAmbiguous), "ambiguous");
  EXPECT_EQ(nameOf(SlipState::kSlip), "slip");
  EXPECT_EQ(nameOf(SlipState::kInvalid), "invalid");
}

TEST(SlipIndicator, HasFourFaces) {
  EXPECT_EQ(nameOf(SlipIndicator::kOff), "off");
  EXPECT_EQ(nameOf(SlipIndicator::kNotComputable), "not computable");
  EXPECT_EQ(nameOf(SlipIndicator::kReady), "ready");
  EXPECT_EQ(nameOf(SlipIndicator::kSlipping), "slipping");
}

}  // namespace
}  // namespace palpate::slip_state_test
