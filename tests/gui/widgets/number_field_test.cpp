#include "gui/widgets/number_field.h"

#include <QApplication>
#include <QSignalSpy>
#include <QSlider>
#include <QTest>
#include <QTimer>
#include <utility>

#include <gtest/gtest.h>

#include "gui/testing/make_active.h"
#include "gui/widgets/value_slider.h"

namespace palpate::gui::number_field_test {
namespace {

class NumberFieldTest : public ::testing::Test {
 protected:
  NumberFieldTest() {
    seconds_.setAccessibleName("Velocity");
    seconds_.setRange(1.0, 100.0);
    seconds_.setDecimals(1);
    seconds_.refused().setSaidUnit(" deg/s");
    seconds_.setValue(10.0);
    frame_.setAccessibleName("Frame");
    frame_.setRange(0, 19);
    frame_.setValue(7);
    parent_.show();
    makeActive(parent_);
  }
  void type(QAbstractSpinBox& field, const QString& text) {
    field.setFocus();
    field.selectAll();
    QTest::keyClick(&field, Qt::Key_Delete);
    QTest::keyClicks(&field, text);
    QTest::keyClick(&field, Qt::Key_Return);
  }
  static bool marked(const QWidget& field) { return field.property("refused").toBool(); }

  QWidget parent_;
  SecondsField seconds_{&parent_};
  FrameField frame_{&parent_};
  QSignalSpy secondsSaid_{&seconds_.refused(), &RefusedNumber::changed};
  QSignalSpy frameSaid_{&frame_.refused(), &RefusedNumber::changed};
};

TEST_F(NumberFieldTest, WhatIsOutOfRangeIsRefusedAndTheValueStays) {
  const QSignalSpy changes(&seconds_, &QDoubleSpinBox::valueChanged);
  for (const char* typed : {"103", "0.9", "-5", "1e9"}) {
    type(seconds_, typed);
    EXPECT_EQ(seconds_.value(), 10.0) << typed;
    EXPECT_EQ(seconds_.text(), "10.0") << typed;
    EXPECT_TRUE(marked(seconds_)) << typed;
    ASSERT_FALSE(secondsSaid_.isEmpty()) << typed;
    EXPECT_EQ(secondsSaid_.back()[0].toString(),
              QString("Velocity: %1 is out of 1 .. 100 deg/s; 10.0 stays").arg(typed));
    EXPECT_EQ(seconds_.toolTip(), secondsSaid_.back()[0].toString());
  }
  EXPECT_TRUE(changes.isEmpty());
}

TEST_F(NumberFieldTest, SoIsWhatIsNoNumber) {
  for (const auto& [typed, why] : {std::pair{"abc", "abc is not a number"},
                                   std::pair{"3 4", "3 4 is not a number"},
                                   std::pair{"5 deg/s", "5 deg/s is not a number"},
                                   std::pair{"", "no number"}}) {
    type(seconds_, typed);
    EXPECT_EQ(seconds_.value(), 10.0) << typed;
    ASSERT_FALSE(secondsSaid_.isEmpty()) << typed;
    EXPECT_EQ(secondsSaid_.back()[0].toString(), QString("Velocity: ") + why + "; 10.0 stays");
  }
}

TEST_F(NumberFieldTest, AWholeNumberHasTheSameRule) {
  for (const auto& [typed, why] : {std::pair{"99", "99 is out of 0 .. 19"},
                                   std::pair{"-1", "-1 is out of 0 .. 19"},
                                   std::pair{"7.5", "7.5 is not a whole number"},
                                   std::pair{"x", "x is not a number"}}) {
    type(frame_, typed);
    EXPECT_EQ(frame_.value(), 7) << typed;
    EXPECT_TRUE(marked(frame_)) << typed;
    ASSERT_FALSE(frameSaid_.isEmpty()) << typed;
    EXPECT_EQ(frameSaid_.back()[0].toString(), QString("Frame: ") + why + "; 7 stays");
  }
}

TEST_F(NumberFieldTest, TheEndsOfTheRangeAreInIt) {
  for (const char* typed : {"1", "100", "2,5"}) {
    type(seconds_, typed);
    EXPECT_EQ(seconds_.value(), QString(typed).replace(',', '.').toDouble());
    EXPECT_FALSE(marked(seconds_)) << typed;
  }
  EXPECT_TRUE(secondsSaid_.isEmpty());
}

TEST_F(NumberFieldTest, TheMarkGoesWithTheNextInputOrValue) {
  seconds_.setToolTip("of the joints");
  type(seconds_, "103");
  ASSERT_TRUE(marked(seconds_));
  QTest::keyClicks(&seconds_, "2");
  EXPECT_FALSE(marked(seconds_));
  EXPECT_EQ(seconds_.toolTip(), "of the joints");
  EXPECT_EQ(secondsSaid_.back()[0].toString(), "");
  type(seconds_, "104");
  ASSERT_TRUE(marked(seconds_));
  seconds_.setValue(50.0);
  EXPECT_FALSE(marked(seconds_));
}

TEST_F(NumberFieldTest, TheMarkGoesAfterAWhile) {
  type(seconds_, "103");
  auto* timer = seconds_.refused().findChild<QTimer*>();
  ASSERT_TRUE(timer && timer->isActive());
  EXPECT_EQ(timer->interval(), 10'000);
  timer->setInterval(0);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !marked(seconds_); }));
  EXPECT_EQ(secondsSaid_.back()[0].toString(), "");
}

TEST_F(NumberFieldTest, EscapeDiscardsTheInputWithoutAWord) {
  seconds_.setFocus();
  seconds_.selectAll();
  QTest::keyClicks(&seconds_, "103");
  QTest::keyClick(&seconds_, Qt::Key_Escape);
  EXPECT_EQ(seconds_.text(), "10.0");
  EXPECT_FALSE(marked(seconds_));
  EXPECT_TRUE(secondsSaid_.isEmpty());
}

// For the field no change, and for the slider none either: no value was chosen.
TEST_F(NumberFieldTest, ASliderChoosesNothingThatIsRefused) {
  const SliderRange range{
      .least = 0.0, .most = 4095.0, .sliderMost = 1000.0, .step = 1.0, .decimals = 0};
  ValueSlider slider("Threshold", range, &parent_);
  slider.show();
  slider.showValue(150.0);
  QSignalSpy chosen(&slider, &ValueSlider::chosen);
  type(*slider.field(), "5000");
  EXPECT_EQ(slider.value(), 150.0);
  EXPECT_EQ(slider.slider()->value(), 150);
  slider.field()->clearFocus();
  // As a joint that moves a little, and shows its angle.
  slider.showValue(151.0);
  EXPECT_TRUE(marked(*slider.field()));
  slider.showDiffering();
  type(*slider.field(), "5000");
  EXPECT_EQ(slider.field()->text(), "") << "they differ still";
  EXPECT_TRUE(chosen.isEmpty());
  type(*slider.field(), "0");
  ASSERT_EQ(chosen.size(), 1);
  EXPECT_EQ(chosen[0][0].toDouble(), 0.0);
}

}  // namespace
}  // namespace palpate::gui::number_field_test
