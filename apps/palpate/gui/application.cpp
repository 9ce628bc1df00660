#include "gui/application.h"

#include <QIcon>
#include <QLocale>
#include <clocale>

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

}  // namespace

std::unique_ptr<QApplication> makeApplication(int& argc, char** argv) {
  std::unique_ptr<QApplication> application;
  if (!QApplication::instance()) application = std::make_unique<QApplication>(argc, argv);
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
