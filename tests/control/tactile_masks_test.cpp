#include "palpate/control/tactile_masks.h"

#include <stdexcept>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

#include "testing/testing.h"

namespace palpate::tactile_masks_test {
namespace {

// Two pads; in the first one, row 0 column 0 has no taxel and row 0 column 1 isn't scanned.
SensorLayout sensor() {
  MatrixLayout pad = MatrixLayout::full(2, 3, 3.4);
  pad.staticMask = {0, 1, 1, 1, 1, 1};
  pad.dynamicMask = {0, 0, 1, 1, 1, 1};
  return SensorLayout({pad, MatrixLayout::full(1, 2, 3.4)});
}

Mask maskOf(const DeviceCommand& command, int matrix) {
  const auto& set = std::get<SetDynamicMask>(command);
  EXPECT_EQ(set.matrix, matrix);
  return set.mask;
}

TEST(TactileMasks, ScanOnlyWhatIsChosenOfTheWholeHand) {
  TaxelSelection chosen(sensor());
  chosen.add(0, 0, 0, 0, 1);
  const auto commands = maskCommands(sensor(), chosen, MaskChoice::kOnly);
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_EQ(maskOf(commands[0], 0), (Mask{0, 1, 0, 0, 0, 0}));
  EXPECT_EQ(maskOf(commands[1], 1), (Mask{0, 0}));
}

TEST(TactileMasks, ScanOnlyWhatIsChosenWhereSomethingIs) {
  TaxelSelection chosen(sensor());
  chosen.add(0, 0, 0, 0, 1);
  const auto commands = maskCommands(sensor(), chosen, MaskChoice::kOnlyInTheirMatrices);
  ASSERT_EQ(commands.size(), 1u) << "the second pad stays as it is";
  EXPECT_EQ(maskOf(commands[0], 0), (Mask{0, 1, 0, 0, 0, 0}));
}

TEST(TactileMasks, LeaveOutAndTakeIn) {
  TaxelSelection chosen(sensor());
  chosen.add(0, 1, 0, 1, 2);
  auto commands = maskCommands(sensor(), chosen, MaskChoice::kWithout);
  ASSERT_EQ(commands.size(), 1u);
  EXPECT_EQ(maskOf(commands[0], 0), (Mask{0, 0, 1, 0, 0, 0}));
  chosen.clear();
  chosen.add(0, 0, 0, 0, 1);
  commands = maskCommands(sensor(), chosen, MaskChoice::kAlso);
  ASSERT_EQ(commands.size(), 1u);
  EXPECT_EQ(maskOf(commands[0], 0), (Mask{0, 1, 1, 1, 1, 1}));
}

TEST(TactileMasks, AllIsAllAndNothingToDoIsNothing) {
  const TaxelSelection none(sensor());
  const auto commands = maskCommands(sensor(), none, MaskChoice::kAll);
  ASSERT_EQ(commands.size(), 1u);
  EXPECT_EQ(maskOf(commands[0], 0), (Mask{0, 1, 1, 1, 1, 1}));
  EXPECT_TRUE(maskCommands(sensor(), none, MaskChoice::kWithout).empty());
  EXPECT_TRUE(maskCommands(sensor(), none, MaskChoice::kOnlyInTheirMatrices).empty());
}

TEST(TactileMasks, NeverLeavesNothing) {
  TaxelSelection everything(sensor());
  everything.addAll(0);
  everything.addAll(1);
  EXPECT_THROW((void)maskCommands(sensor(), everything, MaskChoice::kWithout),
               std::invalid_argument);
  EXPECT_THROW((void)maskCommands(sensor(), TaxelSelection(sensor()), MaskChoice::kOnly),
               std::invalid_argument);
  EXPECT_THROW((void)maskCommands(*sdh2().layout, everything, MaskChoice::kAll),
               std::invalid_argument);
}

}  // namespace
}  // namespace palpate::tactile_masks_test
