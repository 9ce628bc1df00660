// The heat maps over the bench: what is chosen and marked belongs to the matrices that are shown.
#include "gui/matrices/matrices_feature.h"

#include <QComboBox>
#include <QDoubleSpinBox>

#include <palpate/model/profile_builder.h>

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

TEST_F(MatricesFeatureTest, ReadingsHaveChoicesOfTheirOwn) {
  auto* view3 = feature_.panel().findChild<QComboBox*>("taxelsBox");
  auto* arrows = feature_.panel().findChild<QDoubleSpinBox*>("arrowScale");
  windowState_->displayed.show(recording("a"));
  EXPECT_TRUE(view3->isHidden());
  EXPECT_TRUE(arrows->isHidden());
  EXPECT_FALSE(windowState_->displayed.givesReadings());
  MatrixLayout matrix = MatrixLayout::full(1, 2, 2.0);
  matrix.touch = {.components = 3, .isSigned = true, .threshold = 1.0F};
  ProfileBuilder builder(std::make_shared<SensorLayout>(std::vector{matrix}));
  const std::vector<float> readings = {30, 40, 120, 0, 0, -100};
  builder.addReadings(1'000'000, readings);
  windowState_->displayed.show(makeOpenedRecording("b", builder.finish({})));
  EXPECT_TRUE(windowState_->displayed.givesReadings());
  EXPECT_FALSE(view3->isHidden());
  EXPECT_FALSE(arrows->isHidden());
  feature_.panel().show(windowState_->displayed.recorded()->profile.frame(0));
  EXPECT_TRUE(view().look().isSigned);
  EXPECT_EQ(view().look().range, (ValueRange{-120.0, 120.0}));
  const auto* map = feature_.panel().findChild<QComboBox*>("mapBox");
  EXPECT_FALSE(map->isEnabled());
  EXPECT_TRUE(map->toolTip().contains("diverging")) << map->toolTip().toStdString();
  windowState_->actions.group("maps")->actions().at(1)->trigger();
  EXPECT_TRUE(windowState_->messages.flashed().contains("diverging"))
      << windowState_->messages.flashed().toStdString();
  arrows->setValue(4.0);
  EXPECT_EQ(view().look().arrows, 4.0);
  emit view3->activated(1);
  EXPECT_FALSE(view().look().isSigned);
  EXPECT_TRUE(map->isEnabled());
  EXPECT_EQ(map->toolTip(), "Colour map");
  EXPECT_EQ(view().look().range, (ValueRange{0.0, 130.0})) << "30, 40, 120";
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
