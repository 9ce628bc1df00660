#include "gui/desktop/application.h"

#include <QIcon>
#include <QLocale>
#include <clocale>
#include <exception>

#include "gui/desktop/file_dialog_look.h"
#include "gui/desktop/key_policy.h"

// Resources of a static library must be initialised explicitly, by a function outside of any
// namespace.
static void initIcons() { Q_INIT_RESOURCE(icons); }

namespace palpate::gui {
namespace {

// The icon of the window, for a desktop that doesn't know the desktop entry of an installed
// program.
QIcon programIcon() {
  initIcons();
  QIcon icon;
  for (int size : {16, 24, 32, 48, 64, 128, 256})
    icon.addFile(QString(":/icons/palpate_%1.png").arg(size), QSize(size, size));
  return icon;
}

// Most texts that are reported.
constexpr int kMaxTold = 20;

}  // namespace

bool GuardedApplication::notify(QObject* receiver, QEvent* event) {
  try {
    return QApplication::notify(receiver, event);
  } catch (const std::exception& failure) {
    note(failure.what());
  } catch (...) {
    note("unknown error");
  }
  return false;
}

// Runs in the thread that handled the event; the report is queued to the thread of the window.
void GuardedApplication::note(const char* what) noexcept {
  ++numFailures_;
  try {
    QMetaObject::invokeMethod(
        this, [this, text = QString::fromUtf8(what)] { showFailure(text); }, Qt::QueuedConnection);
  } catch (...) {
    // There is no memory for a longer message.
    qCritical("An error occurred in the window; it continues");
  }
}

void GuardedApplication::showFailure(const QString& what) {
  if (reportedFailures_.contains(what) || reportedFailures_.size() >= kMaxTold) return;
  reportedFailures_.insert(what);
  qCritical("An error occurred in the window; it continues: %s", qUtf8Printable(what));
  emit failed("An error occurred in the window: " + what +
              ". Save your work; if it happens again, restart Palpate");
}

void GuardedApplication::forgetFailures() {
  numFailures_ = 0;
  reportedFailures_.clear();
}

std::size_t failuresAtEvents() noexcept {
  const auto* application = qobject_cast<GuardedApplication*>(QCoreApplication::instance());
  return application ? application->numFailures() : 0;
}

void forgetFailuresAtEvents() {
  if (auto* application = qobject_cast<GuardedApplication*>(QCoreApplication::instance()))
    application->forgetFailures();
}

std::unique_ptr<QApplication> makeApplication(int& argc, char** argv) {
  std::unique_ptr<QApplication> application;
  if (!QApplication::instance()) {
    // All dialogues look like the window, and can have the button that stops the hand.
    QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
    application = std::make_unique<GuardedApplication>(argc, argv);
    QApplication::setStyle("Fusion");
    KeyPolicy::ofApplication();
    new FileDialogLook(application.get());
  }
  QApplication::setApplicationName("palpate");
  QApplication::setApplicationDisplayName("Palpate");
  QApplication::setApplicationVersion(PALPATE_VERSION);
  QApplication::setDesktopFileName("palpate");
  if (QApplication::windowIcon().isNull()) QApplication::setWindowIcon(programIcon());
  // QApplication has set the user's locale; '.' must stay the decimal sign in files and fields.
  std::setlocale(LC_NUMERIC, "C");
  QLocale numbers = QLocale::c();
  numbers.setNumberOptions(QLocale::OmitGroupSeparator);
  QLocale::setDefault(numbers);
  return application;
}

}  // namespace palpate::gui
