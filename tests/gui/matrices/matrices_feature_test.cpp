// The heat maps over the bench: what is chosen and marked belongs to the matrices that are shown.
#include "gui/matrices/matrices_feature.h"

#include "gui/matrices/matrices_panel.h"
#include "gui/window_state/window_state_fixture.h"

namespace palpate::gui::matrices_feature_test {
namespace {

class MatricesFeatureTest : public WindowStateTest {
 protected:
  MatricesFeatureTest() : feature_(*windowState_, &actionsOf_) {}
  MatricesView& view() { return feature_.panel().view(); }
  TaxelSelection chosen() const {
    TaxelSelection taxels(windowState_->displayed.hand()->layout
                              ? *windowState_->displayed.hand()->layout
                              : SensorLayout());
    taxels.add(1, 7, 2, 8, 3);
    return taxels;
  }
  MatricesFeature feature_;
};

TEST_F(MatricesFeatureTest, WhatIsChosenIsTheSameInViewAndModel) {
  windowState_->displayed.show(recording("a"));
  windowState_->selection.setTaxels(chosen());
  EXPECT_EQ(view().selection(), chosen());
  view().clearSelection();
  EXPECT_TRUE(windowState_->selection.taxels().empty());
}

TEST_F(MatricesFeatureTest, WithoutAChoiceTheModelKnowsTheMatricesThatAreShown) {
  connectEmulated();
  EXPECT_TRUE(windowState_->selection.taxels().sameSensor(
      TaxelSelection(*windowState_->displayed.hand()->layout)))
      << "scanning all taxels of it is possible";
}

TEST_F(MatricesFeatureTest, NothingUnseenIsChosen) {
  windowState_->displayed.show(recording("a"));
  windowState_->selection.setTaxels(chosen());
  connectEmulated();
  EXPECT_EQ(view().selection(), windowState_->selection.taxels());
}

TEST_F(MatricesFeatureTest, MatricesThatFeelNoLimitStayMarkedWhenOtherTaxelsAreScanned) {
  connectEmulated();
  const std::vector<QString> why{"", "its threshold is above the limit"};
  windowState_->derivedResults.setUnmeasurable(why);
  EXPECT_EQ(view().unmeasurable(), why);
  emit windowState_->displayed.handChanged();
  EXPECT_EQ(view().unmeasurable(), why);
}

TEST_F(MatricesFeatureTest, ALivePictureWithoutAFrameSaysWhyFromTheStart) {
  QStringList notices;
  QObject::connect(
      &windowState_->displayed, &DisplayedSource::shown, [&] { notices.append(view().notice()); });
  connectEmulated();
  ASSERT_EQ(notices.size(), 1);
  EXPECT_TRUE(notices[0].startsWith("waiting for the first frame")) << notices[0].toStdString();
  EXPECT_EQ(view().notice(), "") << "it has come";
}

// docs/manual/window.md: "largest so far" never shrinks while connected.
TEST_F(MatricesFeatureTest, TheLargestSoFarOutlivesALookAtARecording) {
  connectEmulated();
  windowState_->currentFrame.hold(true);  // what comes besides is not shown
  TactileFrame pressed(windowState_->displayed.hand()->layout);
  pressed.matrix(1)(7, 2) = 3100.0F;
  feature_.panel().show(pressed);
  EXPECT_EQ(view().look().range.maximum, 3250.0);
  windowState_->displayed.show(recording("a"));
  windowState_->displayed.showLive();
  EXPECT_EQ(view().look().range.maximum, 3250.0);
  disconnect();
  connectEmulated();
  EXPECT_LT(view().look().range.maximum, 3250.0) << "another one was connected";
}

}  // namespace
}  // namespace palpate::gui::matrices_feature_test
