// The window fits small screens: with a recording and with a live hand, with each dock, at each
// size and in both themes, nothing is cut off and nothing lies over something else.
#include <QDockWidget>
#include <cstdlib>
#include <iostream>

#include "gui/source/live_controller.h"
#include "gui/testing/layout_faults.h"
#include "gui/testing/window_fixture.h"

namespace palpate::gui::window_fits_test {
namespace {
namespace fs = std::filesystem;

constexpr QSize kSizes[] = {{1280, 800}, {1366, 768}, {1440, 900}};

class WindowFitsTest : public WindowTest {
 protected:
  WindowFitsTest() { fs::create_directory_symlink(testing::dataFolder() / "scenes", folder_ / "scenes"); }

  void processAll() {
    for (int i = 0; i < 4; ++i) QCoreApplication::processEvents();
  }
  void expectNoFaults(const QString& where) {
    processAll();
    const QStringList faults = layoutFaults(window());
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
        if (theme == ThemeChoice::kLight && size != kSizes[0]) continue;
        window().state().appearance.setTheme(theme);
        window().resize(size);
        const QString at = QString("%1 at %2x%3, %4")
                               .arg(source)
                               .arg(size.width())
                               .arg(size.height())
                               .arg(nameOf(theme));
        window().docks().reset();
        expectNoFaults(at);
        if (std::getenv("DUMP"))
          for (auto* d : window().findChildren<QWidget*>())
            if (qobject_cast<QDockWidget*>(d) || d->objectName() == "views" || d->inherits("palpate::gui::MatricesPanel") || d->inherits("palpate::gui::HandPanel") || d->inherits("QToolBar") || d->objectName()=="DockTitle" || d->inherits("palpate::gui::CentralWidget") || d->inherits("palpate::gui::PlaybackBar"))
              std::cout << d->metaObject()->className() << " " << d->objectName().toStdString() << " vis " << d->isVisible() << " size " << d->width() << "x" << d->height() << " min " << d->minimumSizeHint().width() << "x" << d->minimumSizeHint().height() << " / " << d->minimumWidth() << std::endl;
        EXPECT_EQ(window().size(), size) << at.toStdString();
        for (QAction* toggle : window().docks().toggles()) {
          window().docks().reset();
          QCoreApplication::processEvents();
          auto* dock = find<QDockWidget>(toggle->text().toUtf8());
          if (dock->isVisible()) dock->close();
          toggle->trigger();
          expectNoFaults(at + ", " + toggle->text());
          if (dock->property("everywhere").toBool()) dock->close();
        }
      }
  }
};

TEST_F(WindowFitsTest, ARecordingWithEveryDock) {
  open({"rich.dsa"});
  window().settle();
  expectEveryDockFits("recording");
}

TEST_F(WindowFitsTest, ALiveHandWithEveryDock) {
  Connection connection;
  connection.kind = Connection::Kind::kEmulated;
  connection.scene = "ball";
  window().state().connectTo(connection);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window().state().displayed.isLive() && !window().state().live.stale(); }, 20'000));
  expectEveryDockFits("live");
}

}  // namespace
}  // namespace palpate::gui::window_fits_test
