#include "gui/shell/run_window.h"

#include <QGuiApplication>
#include <QScreen>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

#include "gui/connect/connect_feature.h"
#include "gui/desktop/application.h"
#include "gui/desktop/first_paint.h"
#include "gui/desktop/termination.h"
#include "gui/hand3d/gl_probe.h"
#include "gui/hand3d/hand3d_feature.h"
#include "gui/hand3d/hand_panel.h"
#include "gui/open/session_storage.h"
#include "gui/settings/settings_feature.h"
#include "gui/shell/main_window.h"
#include "gui/shell/screen_room.h"
#include "gui/source/abandonable.h"

namespace palpate::gui {
namespace {

// The usual size is larger than a small screen, and part of the window would be out of reach.
void fitOnScreen(MainWindow& window) {
  if (window.isMaximized() || window.isFullScreen()) return;
  const QSize fitting = window.size().boundedTo(roomOnScreen(window.screen()));
  if (fitting == window.size()) return;
  window.resize(fitting);
  window.move(window.screen()->availableGeometry().topLeft());
}

// As the Library and the menus name a file, whatever the current folder is later.
std::filesystem::path wholePath(const std::filesystem::path& file) {
  std::error_code failed;
  const auto folder =
      std::filesystem::canonical(file.has_parent_path() ? file.parent_path() : ".", failed);
  return failed ? file : folder / file.filename();
}

// Ends the program where threads still run half a second after the window is gone, since their
// files don't answer: they must see neither the application nor the statics being destroyed.
struct LastThreads {
  ~LastThreads() {
    using namespace std::chrono_literals;
    if (Abandonable::awaitThreads(500ms)) return;
    std::fflush(nullptr);
    std::_Exit(code);
  }
  int code = 0;
};

}  // namespace

int runWindow(int& argc, char** argv, const WindowOptions& options) {
  const auto application = makeApplication(argc, argv);
  LastThreads last;
  MainWindow window({.dataFolder = options.dataFolder,
                     .settingsPath = settingsPath(),
                     .clock = nullptr,
                     .read = {},
                     .assumedAnglesDeg = options.assumedAnglesDeg,
                     .recipe = options.recipe,
                     .offerUnfinished = true,
                     .playsOnStart = true});
  const FirstPaint firstPaint(window);
  const Termination termination;
  QObject::connect(&termination, &Termination::asked, &window, &MainWindow::endNow);
  fitOnScreen(window);
  window.show();
  HandView& hand = window.feature<Hand3dFeature>().panel().view();
  // OpenGL is probed in another process, since a driver may crash; until the answer arrives the
  // hand is drawn without it.
  if (options.openGl == OpenGlChoice::kAlways && openGlProblem().isEmpty())
    hand.useOpenGl();
  else if (options.openGl == OpenGlChoice::kFast)
    askForOpenGl(QCoreApplication::applicationFilePath().toStdString(),
                 &window,
                 [&hand](const QString& why) {
                   if (why.isEmpty()) hand.useOpenGl();
                 });
  if (options.remote) {
    QAction* remote = window.state().actions.at("remoteControl");
    remote->setData(QString::fromStdString(options.remote->string()));
    remote->setChecked(true);
  }
  // The window is visible before the first file is read.
  if (options.demo) {
    window.state().keepsSession = true;
    window.state().connectTo(emulatedBallConnection());
  } else if (!options.files.empty()) {
    std::vector<std::filesystem::path> files;
    for (const std::filesystem::path& file : options.files) files.push_back(wholePath(file));
    window.state().open(files);
  } else if (reopensSession(window.state().settings)) {
    restoreSession(window.state());
  }
  return last.code = QGuiApplication::exec();
}

}  // namespace palpate::gui
