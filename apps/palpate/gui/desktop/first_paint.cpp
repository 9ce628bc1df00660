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

// Since the start of this process, by the kernel's own stamp (proc(5), field 22, in ticks since
// boot); the linker's work counts, too.
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
  // The children paint in the same round, and the round is flushed to the screen before the next
  // event is taken.
  QTimer::singleShot(0, this, [] {
    qCDebug(
        startup, "first paint %.0f ms after the start of the process", 1e3 * secondsSinceStart());
  });
  return false;
}

}  // namespace palpate::gui
