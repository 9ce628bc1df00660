// Fuzzes the file with the settings of the window, and the layout of its docks: whatever it holds,
// it is read without harm, and what is read is within its range. A window with docks takes each
// layout that passes the check.
#include <QApplication>
#include <QDockWidget>
#include <QHeaderView>
#include <QMainWindow>
#include <QSettings>
#include <QSplitter>
#include <QTableWidget>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include "gui/appearance/settings_file.h"
#include "gui/appearance/window_settings.h"
#include "gui/shell/dock_layout.h"
#include "gui/source/connection.h"
#include "gui/source/recording_settings.h"
#include "gui/source/session.h"

namespace {

using namespace palpate::gui;
namespace fs = std::filesystem;

void require(bool condition) {
  if (!condition) std::abort();
}

struct Desktop {
  Desktop() {
    ::setenv("QT_QPA_PLATFORM", "offscreen", 1);
    static int argc = 1;
    static char name[] = "settings_fuzzer";
    static char* argv[] = {name, nullptr};
    new QApplication(argc, argv);
  }
};

// A new one each time: a layout that was taken must not harm the next.
void restore(const QByteArray& layout) {
  QMainWindow window;
  window.resize(800, 600);
  window.setCentralWidget(new QWidget);
  for (const char* name : {"Hand", "Timeline", "Inspect"}) {
    auto* dock = new QDockWidget(name, &window);
    dock->setObjectName(name);
    dock->setWidget(new QWidget);
    window.addDockWidget(Qt::RightDockWidgetArea, dock);
  }
  window.restoreState(layout);
  window.show();
  QCoreApplication::processEvents();
}

void readSettings(const std::string& text) {
  static const fs::path folder = [] {
    const fs::path made =
        fs::temp_directory_path() / ("settings_fuzzer_" + std::to_string(::getpid()));
    fs::create_directories(made);
    return made;
  }();
  static std::uint64_t number = 0;
  // QSettings keeps what it read of a path.
  const fs::path file = folder / (std::to_string(++number) + ".ini");
  std::ofstream(file, std::ios::binary) << text;
  {
    const SettingsPlace place = readableSettings(QString::fromStdString(file.string()));
    QSettings settings(place.path, QSettings::IniFormat);
    for (const QString& key : settings.allKeys()) settings.value(key).toString();
    const ViewSettings view = loadViewSettings(settings);
    require(view.manualMax > view.manualMin && std::isfinite(view.speed));
    loadRecordingSettings(settings);
    loadConnection(settings);
    require(loadSession(settings).files.size() <= Session::kMaxFiles);
    const QByteArray layout = settings.value("window/layouts_recording/Watch").toByteArray();
    if (isDockLayout(layout)) restore(layout);
    QTableWidget table(2, 3);
    restoreColumns(*table.horizontalHeader(), settings, "library/columns");
    QSplitter parts;
    parts.addWidget(new QWidget);
    parts.addWidget(new QWidget);
    restoreParts(parts, settings, "window/views");
    QWidget window;
    restorePlace(window, settings, "window/geometry");
    require(window.width() <= 10'000 && window.height() <= 10'000);
  }
  fs::remove(file);
  fs::remove(file.string() + ".damaged");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Desktop desktop;
  const QByteArray layout(reinterpret_cast<const char*>(data), static_cast<qsizetype>(size));
  if (isDockLayout(layout)) restore(layout);
  readSettings({reinterpret_cast<const char*>(data), size});
  return 0;
}
