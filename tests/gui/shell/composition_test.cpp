// How much of the window the data have: the views of the sensor, and the painted cells of the heat
// maps, with the chart and the column of a connected hand, and without them.
#include <QPushButton>

#include <palpate/control/grasp_request.h>

#include "gui/hand/hand_dock.h"
#include "gui/hand/hand_feature.h"
#include "gui/hand3d/hand3d_feature.h"
#include "gui/hand3d/hand_panel.h"
#include "gui/matrices/matrices_feature.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/matrices/matrices_view.h"
#include "gui/shell/window_fits_fixture.h"

namespace palpate::gui::composition_test {
namespace {

class CompositionTest : public WindowFitsTest {
 protected:
  // A new layout at this size, as after Reset layout.
  void setSize(const QSize& size) {
    window().setFixedSize(size);
    window().docks().reset();
    window().settle();
    processAll();
  }
  double shareOf(double area) { return area / (window().width() * window().height()); }
  static double areaOf(const QWidget& view) {
    return view.isVisible() ? view.width() * view.height() : 0;
  }
  double views() {
    return shareOf(areaOf(window().feature<MatricesFeature>().panel()) +
                   areaOf(window().feature<Hand3dFeature>().panel()));
  }
  double cells() {
    const MatricesView& view = window().feature<MatricesFeature>().panel().view();
    const auto& layout = *movableHand().layout;
    double area = 0.0;
    for (std::size_t m = 0; m < view.geometryOfMatrices().numMatrices(); ++m)
      for (int y = 0; y < layout.matrix(m).rows; ++y)
        for (int x = 0; x < layout.matrix(m).columns; ++x)
          if (layout.matrix(m).exists(y, x))
            area += view.geometryOfMatrices().taxelSide(m) * view.geometryOfMatrices().taxelSide(m);
    return shareOf(area);
  }
};

constexpr QSize kWindows[] = {{1280, 800}, {1440, 900}, {1920, 1080}};

TEST_F(CompositionTest, OfALiveHandTheDataHaveTheLargestPart) {
  connectEmulated();
  for (const QSize& size : kWindows) {
    setSize(size);
    const auto* column = find<QDockWidget>("Hand");
    const auto* chart = find<QDockWidget>("Timeline");
    ASSERT_TRUE(column->isVisible() && chart->isVisible());
    EXPECT_GE(views(), 0.40) << size.width();
    EXPECT_GE(cells(), 0.08) << size.width();
    EXPECT_LE(column->width(), size.width() / 4) << size.width();
    EXPECT_NEAR(chart->height(), size.height() / 4.0, size.height() * 0.05) << size.width();
    for (const char* closed : {"Inspect", "Link", "Filter"})
      EXPECT_FALSE(find<QDockWidget>(closed)->isVisible()) << closed;
    window().docks().hideAll();
    processAll();
    EXPECT_GE(views(), 0.55) << size.width();
    EXPECT_GE(cells(), 0.15) << size.width();
    window().docks().bringBack();
  }
}

// On a screen of a projector the column has the whole height, and its buttons are seen.
TEST_F(CompositionTest, InALowWindowTheButtonsThatMoveTheHandAreSeen) {
  connectEmulated();
  trigger("presetGrasp");
  setSize({1024, 700});
  const auto* chart = find<QDockWidget>("Timeline");
  const auto* column = find<QDockWidget>("Hand");
  ASSERT_TRUE(chart->isVisible());
  EXPECT_GE(column->geometry().bottom(), chart->geometry().bottom());
  EXPECT_GT(chart->x(), column->geometry().right());
  for (const char* name :
       {"graspHand", "reactiveGrasp", "slipAwareGrasp", "openHand", "relaxHand"}) {
    const auto* button = find<QPushButton>(name);
    EXPECT_EQ(button->visibleRegion().boundingRect(), button->rect()) << name;
  }
  setSize({1440, 900});
  EXPECT_LE(chart->x(), column->x()) << "there the chart has the whole width";
}

TEST_F(CompositionTest, APageOfTheHandThatNeedsMoreRoomGivesItBack) {
  connectEmulated();
  trigger("presetGrasp");
  setSize({1440, 900});
  const auto* column = find<QDockWidget>("Hand");
  const int usual = column->width();
  HandDock& hand = window().feature<HandFeature>().panel();
  hand.showPage("Joints");
  EXPECT_TRUE(QTest::qWaitFor([&] { return column->width() > usual; }, 5'000));
  processAll();
  hand.showPage("Grasp");
  EXPECT_TRUE(QTest::qWaitFor([&] { return column->width() == usual; }, 5'000)) << column->width();
}

TEST_F(CompositionTest, OfARecordingTheDataHaveTheLargestPart) {
  open({"rich.dsa"});
  for (const QSize& size : kWindows) {
    setSize(size);
    EXPECT_TRUE(find<QDockWidget>("Timeline")->isVisible());
    EXPECT_GE(views(), 0.40) << size.width();
    EXPECT_GE(cells(), 0.075) << size.width();
  }
}

TEST_F(CompositionTest, InEachPresetTheDataHaveTheLargestPart) {
  open({"rich.dsa"});
  const auto check = [this](const char* of) {
    for (const Preset preset : kAllPresets)
      for (const QSize& size : kWindows) {
        trigger(("preset" + nameOf(preset)).toStdString().c_str());
        setSize(size);
        EXPECT_GE(views(), 0.40) << of << qPrintable(nameOf(preset)) << size.width();
      }
  };
  check("a recording: ");
  connectEmulated();
  check("live: ");
}

}  // namespace
}  // namespace palpate::gui::composition_test
