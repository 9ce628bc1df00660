// A window of given sizes, with a recording or a live hand, whose layout is looked through for
// faults.
#pragma once

#include <QDockWidget>

#include "gui/appearance/text_size.h"
#include "gui/calibrate/calibrate_feature.h"
#include "gui/calibrate/calibrate_panel.h"
#include "gui/hand/hand_dock.h"
#include "gui/hand/hand_feature.h"
#include "gui/recognise/recognise_feature.h"
#include "gui/recognise/recognise_panel.h"
#include "gui/source/live_controller.h"
#include "gui/testing/layout_faults.h"
#include "gui/testing/window_fixture.h"

namespace palpate::gui {

inline constexpr QSize kSizes[] = {{1280, 800}, {1366, 768}, {1440, 900}};

class WindowFitsTest : public WindowTest {
 protected:
  WindowFitsTest() {
    std::filesystem::create_directory_symlink(testing::dataFolder() / "scenes", folder_ / "scenes");
  }

  void processAll() {
    // Docks reach their places at once.
    window().setAnimated(false);
    for (int i = 0; i < 4; ++i) QCoreApplication::processEvents();
  }
  // Within the time that its layout takes on a loaded machine.
  bool hasSizeAgain(QSize size) {
    return QTest::qWaitFor([&] { return window().size() == size; }, 5'000);
  }
  // Shows a recording and the dock Log, for which the window of this size has to grow.
  QDockWidget* growForLog(QSize size) {
    window().resize(size);
    window().setAnimated(false);
    open({"rich.dsa"});
    processAll();
    auto* log = find<QDockWidget>("Log");
    log->widget()->setMinimumHeight(900);
    window().docks().show("Log");
    processAll();
    EXPECT_GT(window().height(), size.height());
    return log;
  }
  void connectEmulated() {
    Connection connection;
    connection.kind = Connection::Kind::kEmulated;
    connection.scene = "ball";
    window().state().connectTo(connection);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return window().state().displayed.isLive() && !window().state().live.stale(); },
        20'000));
  }
  void expectNoFaults(const QString& where) {
    window().settle();
    processAll();
    // A live value that has just changed takes its width.
    for (int nested = 0; nested < 4; ++nested)
      QCoreApplication::sendPostedEvents(nullptr, QEvent::LayoutRequest);
    QStringList faults = layoutFaults(window());
    // With large text the names of many tabs don't fit beside each other: they can be scrolled.
    if (textScale() > 1.0)
      faults.removeIf([](const QString& fault) { return fault.startsWith("QTabBar"); });
    EXPECT_TRUE(faults.isEmpty()) << where.toStdString() << ":\n  "
                                  << faults.join("\n  ").toStdString();
  }
  void press(const QKeySequence& key) {
    WindowTest::press(static_cast<Qt::Key>(key[0].key()), key[0].keyboardModifiers());
  }
  // Every dock in turn, by its key, in the layout of the first start.
  void expectEveryDockFits(const char* source) {
    for (const QSize size : kSizes)
      for (const ThemeChoice theme : {ThemeChoice::kDark, ThemeChoice::kLight}) {
        window().state().appearance.setTheme(theme);
        window().resize(size);
        const QString at = QString("%1 at %2x%3, %4")
                               .arg(source)
                               .arg(size.width())
                               .arg(size.height())
                               .arg(nameOf(theme));
        window().setAnimated(false);
        window().docks().reset();
        expectNoFaults(at);
        EXPECT_EQ(window().size(), size) << at.toStdString();
        // The theme changes colours, not sizes: what is usually shown is enough for the second.
        if (theme == ThemeChoice::kLight) continue;
        for (QAction* toggle : window().docks().toggles()) {
          window().docks().reset();
          QCoreApplication::processEvents();
          auto* dock = find<QDockWidget>(toggle->text().toUtf8());
          if (dock->isVisible()) dock->close();
          toggle->trigger();
          expectNoFaults(at + ", " + toggle->text());
          if (dock->objectName() == "Library" || dock->objectName() == "Log") dock->close();
        }
      }
  }
  template <class Panel>
  void expectPagesFit(Panel& panel, const QString& dock, const QString& source, QSize size) {
    for (const QString& page : panel.pageNames()) {
      window().docks().reset();
      window().docks().show(dock);
      panel.showPage(page);
      expectNoFaults(QString("%1, %2, page %3").arg(source, dock, page));
      EXPECT_EQ(window().size(), size) << page.toStdString();
    }
  }
  // Each page of each dock that has pages.
  void expectEveryPageFits(const QString& source, QSize size = kSizes[0]) {
    window().setAnimated(false);
    window().resize(size);
    expectPagesFit(window().feature<HandFeature>().panel(), "Hand", source, size);
    expectPagesFit(window().feature<CalibrateFeature>().panel(), "Calibrate", source, size);
    expectPagesFit(window().feature<RecogniseFeature>().panel(), "Recognise", source, size);
  }
};

// The size of text [pt] is that of the whole program.
class TextSizeFitsTest : public WindowFitsTest, public ::testing::WithParamInterface<int> {
 protected:
  TextSizeFitsTest() { applyTextPt(GetParam()); }
  ~TextSizeFitsTest() override { applyTextPt(0); }
  // The largest text needs a window of the usual size.
  static std::vector<QSize> sizes() {
    if (GetParam() == kMaxInterfaceTextPt) return {{1440, 900}};
    return {std::begin(kSizes), std::end(kSizes)};
  }
};

}  // namespace palpate::gui
