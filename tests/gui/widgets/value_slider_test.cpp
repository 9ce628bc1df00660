#include "gui/widgets/value_slider.h"

#include <QDoubleSpinBox>
#include <QEvent>
#include <QSlider>
#include <QTest>

#include "testing/testing.h"

namespace palpate::gui::value_slider_test {
namespace {

// Counts how often a widget is painted.
class PaintCounter : public QObject {
 public:
  explicit PaintCounter(QWidget& widget) { widget.installEventFilter(this); }
  int count = 0;

 protected:
  bool eventFilter(QObject*, QEvent* event) override {
    if (event->type() == QEvent::Paint) ++count;
    return false;
  }
};

// The dock of a hand shows its settings several times a second.
TEST(ValueSlider, AValueThatItShowsAlreadyPaintsNothing) {
  QWidget parent;
  const SliderRange range{.least = 0.0, .most = 4000.0, .sliderMost = 1000.0, .step = 10.0};
  auto* slider = new ValueSlider("threshold", range, &parent);
  parent.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&parent));
  slider->showValue(150.004);
  QCoreApplication::processEvents();
  PaintCounter paints(*slider->field());
  slider->showValue(150.004);
  QCoreApplication::processEvents();
  EXPECT_EQ(paints.count, 0);
  slider->showValue(160.0);
  QCoreApplication::processEvents();
  EXPECT_EQ(paints.count, 1);
  EXPECT_EQ(slider->value(), 160.0);
  EXPECT_EQ(slider->slider()->value(), 16);
  // A value above the slider's end, and one after the dash.
  slider->showValue(2000.0);
  slider->showValue(2000.0);
  EXPECT_EQ(slider->value(), 2000.0);
  slider->showUnknown();
  EXPECT_FALSE(slider->field()->specialValueText().isEmpty());
  slider->showValue(0.0);
  EXPECT_TRUE(slider->field()->specialValueText().isEmpty());
  EXPECT_EQ(slider->value(), 0.0);
}

}  // namespace
}  // namespace palpate::gui::value_slider_test
