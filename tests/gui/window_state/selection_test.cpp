// What is chosen: clamped, told once, and all of a new recording.
#include "gui/window_state/selection.h"

#include <QSignalSpy>

#include "palpate/device/sdh2.h"
#include <palpate/model/hand_description.h>

#include "testing/testing.h"

namespace palpate::gui::selection_test {
namespace {

TEST(SelectionTest, ASpanIsPutInOrderAndIntoTheRecording) {
  Selection selection;
  selection.begin(10.0);
  QSignalSpy changed(&selection, &Selection::spanChanged);
  selection.setSpan(TimeSpan{12.0, -1.0});
  EXPECT_EQ(selection.span(), (TimeSpan{0.0, 10.0}));
  selection.setSpan(TimeSpan{0.0, 10.0});
  EXPECT_EQ(changed.count(), 1) << "the same again";
  selection.begin(5.0);
  EXPECT_EQ(selection.span(), std::nullopt);
  EXPECT_EQ(selection.visibleSpan(), (TimeSpan{0.0, 5.0}));
  EXPECT_EQ(changed.count(), 2);
}

TEST(SelectionTest, WithoutARecordingThereIsNoSpan) {
  Selection selection;
  selection.setSpan(TimeSpan{0.0, 1.0});
  EXPECT_EQ(selection.span(), std::nullopt);
}

TEST(SelectionTest, TaxelsAreToldWhenTheyChange) {
  Selection selection;
  QSignalSpy changed(&selection, &Selection::taxelsChanged);
  TaxelSelection taxels(*sdh2().layout);
  taxels.add(0, 0, 0, 1, 1);
  selection.setTaxels(taxels);
  selection.setTaxels(taxels);
  EXPECT_EQ(changed.count(), 1);
  selection.clearTaxels();
  EXPECT_TRUE(selection.taxels().empty());
  EXPECT_TRUE(selection.taxels().sameSensor(taxels)) << "of the same matrices";
  EXPECT_EQ(changed.count(), 2);
}

}  // namespace
}  // namespace palpate::gui::selection_test
