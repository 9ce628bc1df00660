#include "gui/application.h"

#include <QLocale>
#include <clocale>

namespace palpate::gui {

std::unique_ptr<QApplication> makeApplication(int& argc, char** argv) {
  std::unique_ptr<QApplication> application;
  if (!QApplication::instance()) application = std::make_unique<QApplication>(argc, argv);
  QApplication::setApplicationName("palpate");
  QApplication::setApplicationDisplayName("Palpate");
  QApplication::setApplicationVersion(PALPATE_VERSION);
  QApplication::setDesktopFileName("palpate");
  // QApplication has taken over the user's locale; '.' stays the decimal sign in files and fields.
  std::setlocale(LC_NUMERIC, "C");
  QLocale numbers = QLocale::c();
  numbers.setNumberOptions(QLocale::OmitGroupSeparator);
  QLocale::setDefault(numbers);
  return application;
}

}  // namespace palpate::gui
