#include "gui/shell/workbench.h"

#include <QGuiApplication>

#include "gui/connect/connect_feature.h"
#include "gui/desktop/application.h"
#include "gui/desktop/first_paint.h"
#include "gui/desktop/termination.h"
#include "gui/open/session_keeper.h"
#include "gui/shell/main_window.h"
#include "gui/space/gl_probe.h"
#include "gui/space/hand_panel.h"
#include "gui/space/space_feature.h"

namespace palpate::gui {

int runWorkbench(int& argc, char** argv, const WorkbenchOptions& options) {
  const auto application = makeApplication(argc, argv);
  MainWindow window({.dataFolder = options.dataFolder,
                     .settingsPath = settingsPath(),
                     .clock = nullptr,
                     .read = {},
                     .assumedAnglesDeg = options.assumedAnglesDeg,
                     .recipe = options.recipe,
                     .offerUnfinished = true});
  const FirstPaint firstPaint(window);
  const Termination termination;
  QObject::connect(&termination, &Termination::asked, &window, &MainWindow::endNow);
  window.show();
  HandView& hand = window.feature<SpaceFeature>().panel().view();
  // A driver that crashes does so in another process; until it has answered the hand is painted.
  if (options.openGl == OpenGlChoice::kAlways && whyNoOpenGl().isEmpty())
    hand.useOpenGl();
  else if (options.openGl == OpenGlChoice::kFast)
    askForOpenGl(QCoreApplication::applicationFilePath().toStdString(),
                 &window,
                 [&hand](const QString& why) {
                   if (why.isEmpty()) hand.useOpenGl();
                 });
  if (options.remote) {
    QAction* remote = window.bench().actions.at("remoteControl");
    remote->setData(QString::fromStdString(options.remote->string()));
    remote->setChecked(true);
  }
  // The window is on screen before the first file is read.
  if (options.demo)
    window.bench().connectTo(emulatedBall(true));
  else if (options.files.empty())
    restoreSession(window.bench());
  else
    window.bench().open(options.files);
  return QGuiApplication::exec();
}

}  // namespace palpate::gui
