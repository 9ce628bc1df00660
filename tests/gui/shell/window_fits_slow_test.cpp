// The window fits small screens: with a recording and with a live hand, with each dock, each page,
// at each size, in both themes and in each size of text, nothing is cut off and nothing lies over
// something else.
#include <QPushButton>
#include <QScrollBar>

#include "gui/compare/compare_feature.h"
#include "gui/compare/compare_panel.h"
#include "gui/inspect/inspect_feature.h"
#include "gui/inspect/inspect_panel.h"
#include "gui/shell/window_fits_fixture.h"
#include "gui/widgets/facts_view.h"
#include "gui/widgets/offer_strip.h"

namespace palpate::gui::window_fits_slow_test {
namespace {

INSTANTIATE_TEST_SUITE_P(Sizes,
                         TextSizeFitsTest,
                         ::testing::Values(12, 15, kMaxInterfaceTextPt),
                         ::testing::PrintToStringParamName());

TEST_F(WindowFitsTest, ARecordingWithEveryDock) {
  open({"rich.dsa"});
  window().settle();
  expectEveryDockFits("recording");
}

TEST_F(WindowFitsTest, ALiveHandWithEveryDock) {
  connectEmulated();
  expectEveryDockFits("live");
}

TEST_F(WindowFitsTest, ARecordingWithEveryPage) {
  open({"rich.dsa"});
  window().settle();
  expectEveryPageFits("recording");
}

TEST_F(WindowFitsTest, ALiveHandWithEveryPage) {
  connectEmulated();
  expectEveryPageFits("live");
}

// Docks may scroll, but no word is cut, and the window keeps its size.
TEST_P(TextSizeFitsTest, ARecordingWithEveryDock) {
  open({"rich.dsa"});
  window().settle();
  window().setAnimated(false);
  for (const QSize size : sizes()) {
    window().resize(size);
    for (const QString& name : window().docks().names()) {
      window().docks().reset();
      window().docks().show(name);
      expectNoFaults(QString("text of %1 pt at %2x%3, %4")
                         .arg(GetParam())
                         .arg(size.width())
                         .arg(size.height())
                         .arg(name));
      EXPECT_EQ(window().size(), size) << name.toStdString();
    }
  }
}

// Another size of text and back: nothing is cut, and the window has its size.
TEST_P(TextSizeFitsTest, BackToTheUsualSize) {
  connectEmulated();
  window().setAnimated(false);
  window().resize(kSizes[0]);
  window().docks().reset();
  processAll();
  applyTextPt(0);
  expectNoFaults(QString("after text of %1 pt").arg(GetParam()));
  window().resize(kSizes[0]);
  expectNoFaults(QString("after text of %1 pt, at its size again").arg(GetParam()));
  EXPECT_EQ(window().size(), kSizes[0]);
}

TEST_P(TextSizeFitsTest, ALiveHandWithEveryPage) {
  connectEmulated();
  for (const QSize size : sizes())
    expectEveryPageFits(QString("live, text of %1 pt").arg(GetParam()), size);
}

// Beside a live hand the dock is narrow: its controls go on in more lines.
TEST_P(TextSizeFitsTest, ThePagePressureIsNoWiderThanItsDock) {
  connectEmulated();
  window().setAnimated(false);
  auto* panel = find<CalibratePanel>("CalibratePanel");
  for (const QSize size : sizes()) {
    window().resize(size);
    window().docks().reset();
    window().docks().show("Calibrate");
    panel->showPage("Pressure");
    processAll();
    for (const char* name : {"pressureOpen",
                             "pressureSave",
                             "pressureApply",
                             "pressureStudy",
                             "pressureMatrix",
                             "pressureAbove",
                             "pressureThreshold"}) {
      const auto* control = find<QWidget>(name);
      const QRect seen = control->visibleRegion().boundingRect();
      EXPECT_EQ(seen.width(), control->width()) << name << " at " << size.width();
    }
  }
}

TEST_F(WindowFitsTest, AMeasurementOfALiveHand) {
  connectEmulated();
  window().setAnimated(false);
  auto* panel = find<CalibratePanel>("CalibratePanel");
  for (const QSize size : {QSize(1280, 800), QSize(1024, 700)})
    for (const ThemeChoice theme : {ThemeChoice::kDark, ThemeChoice::kLight}) {
      window().state().appearance.setTheme(theme);
      window().resize(size);
      window().docks().reset();
      window().docks().show("Calibrate");
      for (const char* page : {"Tare", "Noise"}) {
        panel->showPage(page);
        const QString part = QString(page).toLower();
        const QString at = QString("%1 at %2x%3").arg(page).arg(size.width()).arg(size.height());
        expectNoFaults(at);
        find<QPushButton>((part + "Measure").toUtf8())->click();
        processAll();
        expectNoFaults(at + ", measuring or refused");
        panel->cancel();
        expectNoFaults(at + ", ended");
      }
    }
}

// Screens of 768 and 800 pixels leave this much below the title of the window and a bar of the
// desktop.
TEST_F(WindowFitsTest, TheComparisonWithEveryDock) {
  window().setAnimated(false);
  open({"rich.dsa", "rich_of_another_object_2026-11-22_run_0123.dsa"});
  auto& compare = window().feature<CompareFeature>().panel();
  for (const QSize size : {QSize(1280, 732), QSize(1366, 700), QSize(1440, 868)}) {
    window().resize(size);
    window().docks().reset();
    processAll();
    actions().at("compare")->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return compare.complete(); }, 20'000));
    const QString at = QString("comparison at %1x%2").arg(size.width()).arg(size.height());
    expectNoFaults(at);
    EXPECT_EQ(window().size(), size);
    for (const QString& name : window().docks().names()) {
      window().docks().show(name);
      expectNoFaults(at + ", " + name);
      EXPECT_EQ(window().size(), size) << name.toStdString();
      find<QDockWidget>(name.toUtf8())->close();
      processAll();
    }
    for (const char* name : {"Timeline", "Spectrum", "Inspect"}) {
      window().docks().show(name);
      expectNoFaults(at + ", several docks, " + name);
      EXPECT_EQ(window().size(), size) << name;
    }
    actions().at("compare")->trigger();
    processAll();
    EXPECT_EQ(window().size(), size);
  }
}

TEST_P(TextSizeFitsTest, ALongNameInALineAboveTheViewsLeavesTheWindowItsSize) {
  open({"rich.dsa"});
  window().setAnimated(false);
  const QString name(80, 'm');
  OfferStrip* offer = nullptr;
  for (OfferStrip* each : window().findChildren<OfferStrip*>()) offer = each;
  ASSERT_NE(offer, nullptr);
  for (const bool live : {false, true}) {
    if (live) connectEmulated();
    for (const QSize size : sizes()) {
      window().resize(size);
      window().docks().reset();
      if (live) window().docks().show("Recognise");
      processAll();
      ASSERT_EQ(window().size(), size);
      offer->offer("Recorded " + name + ".palpate: 1234 frames", "Open", [] {});
      offer->offerAlso("Rename…", "", [] {});
      offer->offerAlso("Discard…", "", [] {});
      window().state().messages.fail(name + ": can't be read");
      processAll();
      EXPECT_EQ(window().size(), size) << (live ? "live" : "recording");
      offer->dismiss();
    }
  }
}

TEST_P(TextSizeFitsTest, InspectIsNotScrolledSideways) {
  open({"rich.dsa"});
  window().setAnimated(false);
  for (const QSize size : sizes())
    for (const int width : {0, 440, 480, 520}) {
      if (GetParam() == kMaxInterfaceTextPt && width > 0 && width < 500) continue;
      window().resize(size);
      window().docks().reset();
      window().docks().show("Inspect");
      processAll();
      auto* dock = find<QDockWidget>("Inspect");
      if (width > 0) window().resizeDocks({dock}, {width}, Qt::Horizontal);
      processAll();
      EXPECT_EQ(window().feature<InspectFeature>().panel().horizontalScrollBar()->maximum(), 0)
          << GetParam() << " pt at " << size.width() << ", dock " << dock->width();
    }
}

// A number with its unit is never elided.
TEST_P(TextSizeFitsTest, InspectShowsItsNumbersInFull) {
  open({"rich.dsa"});
  window().setAnimated(false);
  DisplayUnits units;
  units.angle = AngleUnit::kRadian;
  window().state().appearance.setUnits(units);
  for (const QSize size : {QSize(1024, 700), kSizes[0], kSizes[1]}) {
    window().resize(size);
    window().docks().reset();
    processAll();
    const auto* angles = find<FactsView>("angleFacts");
    ASSERT_FALSE(angles->facts().empty());
    for (std::size_t i = 0; i < angles->facts().size(); ++i) {
      const Fact shown = angles->shown(i);
      EXPECT_TRUE(shown.value.endsWith(" rad")) << shown.value.toStdString();
      EXPECT_EQ(shown.value, angles->facts()[i].value);
      EXPECT_LE(angles->fontMetrics().horizontalAdvance(shown.name + shown.value), angles->width());
    }
  }
}

TEST_P(TextSizeFitsTest, InspectOfALiveHandIsNotScrolledSideways) {
  // The dock Hand leaves too little beside it with the largest text.
  if (GetParam() == kMaxInterfaceTextPt) return;
  connectEmulated();
  window().setAnimated(false);
  window().resize(1366, 768);
  window().docks().reset();
  processAll();
  EXPECT_EQ(window().feature<InspectFeature>().panel().horizontalScrollBar()->maximum(), 0);
}

}  // namespace
}  // namespace palpate::gui::window_fits_slow_test
