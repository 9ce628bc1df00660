#include "gui/desktop/first_paint.h"

#include <QEvent>
#include <QLoggingCategory>
#include <QTimer>
#include <QWidget>
#include <ctime>
#include <fstream>
#include <string>

#include <unistd.h>

namespace palpate::gui {
namespace {

Q_LOGGING_CATEGORY(startup, "palpate.startup", QtInfoMsg)

// Seconds since the start of this process, from the start time that the kernel stores (proc(5),
// field 22, in ticks since boot); it includes the time of the dynamic linker.
double secondsSinceStart() {
  std::ifstream stat("/proc/self/stat");
  std::string word;
  while (stat >> word && !word.ends_with(')')) continue;  // pid and (name)
  constexpr int kFieldsBetween = 20;                      // state .. starttime
  for (int i = 0; i < kFieldsBetween; ++i) stat >> word;
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);
  const auto ticksPerS = static_cast<double>(::sysconf(_SC_CLK_TCK));
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec) -
         std::stod(word) / ticksPerS;
}

}  // namespace

FirstPaint::FirstPaint(QWidget& window) { window.installEventFilter(this); }

bool FirstPaint::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::Paint) return false;
  watched->removeEventFilter(this);
  // The child widgets paint in the same round of events, and the result is flushed to the screen
  // before the next event is handled.
  QTimer::singleShot(0, this, [] {
    qCDebug(
        startup, "first paint %.0f ms after the start of the process", 1e3 * secondsSinceStart());
  });
  return false;
}

}  // namespace palpate::gui
