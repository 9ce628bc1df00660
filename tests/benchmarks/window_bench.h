// What benchmarks of the window need: an application where a display is, else drawing to memory;
// processor time.
#pragma once

#include <QApplication>
#include <QTemporaryDir>

#include <sys/resource.h>

#include "gui/desktop/application.h"

namespace palpate::testing {

inline void usePlatform() {
  if (qEnvironmentVariableIsEmpty("DISPLAY")) qputenv("QT_QPA_PLATFORM", "offscreen");
}

inline QApplication& windowApplication() {
  usePlatform();
  static const QTemporaryDir runtime;  // where nobody is logged in there is none, and Qt says so
  if (!qEnvironmentVariableIsSet("XDG_RUNTIME_DIR"))
    qputenv("XDG_RUNTIME_DIR", runtime.path().toLocal8Bit());
  static int count = 1;
  static char name[] = "palpate";
  static char* arguments[] = {name, nullptr};
  // Never destroyed: at the end of the process Qt's own statics are gone before ours, and its
  // destructor needs them.
  static QApplication* const application = gui::makeApplication(count, arguments).release();
  return *application;
}

// Of all threads of this process [s].
inline double processSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace palpate::testing
