#include "gui/application.h"

#include <QIcon>
#include <QLocale>
#include <clocale>
#include <exception>

#include "gui/button_keys.h"
#include "gui/wheel_guard.h"

// A static library's resources are there only when asked for, and by a function of no namespace.
static void initIcons() { Q_INIT_RESOURCE(icons); }

namespace palpate::gui {
namespace {

// What the window shows until the desktop entry of an installed program tells the desktop.
QIcon programIcon() {
  initIcons();
  QIcon icon;
  for (int size : {16, 24, 32, 48, 64, 128, 256})
    icon.addFile(QString(":/icons/palpate_%1.png").arg(size), QSize(size, size));
  return icon;
}

// What is thrown while the window answers an event (no memory, a bug) costs that event, not the process: a hand
// may be moving, and its stop must be heard.
class GuardedApplication : public QApplication {
 public:
  using QApplication::QApplication;
  bool notify(QObject* receiver, QEvent* event) override {
    try {
      return QApplication::notify(receiver, event);
    } catch (const std::exception& failure) {
      qCritical("The window failed at an event, and goes on: %s", failure.what());
    } catch (...) {
      qCritical("The window failed at an event, and goes on");
    }
    return false;
  }
};

}  // namespace

std::unique_ptr<QApplication> makeApplication(int& argc, char** argv) {
  std::unique_ptr<QApplication> application;
  if (!QApplication::instance()) {
    application = std::make_unique<GuardedApplication>(argc, argv);
    new WheelGuard(application.get());
    new ButtonKeys(application.get());
  }
  QApplication::setApplicationName("palpate");
  QApplication::setApplicationDisplayName("Palpate");
  QApplication::setApplicationVersion(PALPATE_VERSION);
  QApplication::setDesktopFileName("palpate");
  if (QApplication::windowIcon().isNull()) QApplication::setWindowIcon(programIcon());
  // QApplication has taken over the user's locale; '.' stays the decimal sign in files and fields.
  std::setlocale(LC_NUMERIC, "C");
  QLocale numbers = QLocale::c();
  numbers.setNumberOptions(QLocale::OmitGroupSeparator);
  QLocale::setDefault(numbers);
  return application;
}

}  // namespace palpate::gui
