// The main window, into which the features plug. It owns the window state that they share, places
// their docks, views and banners, and asks before it closes.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QList>
#include <QMainWindow>
#include <memory>
#include <stdexcept>
#include <vector>

#include "gui/shell/dock_arrangement.h"
#include "gui/shell/layout_menu.h"
#include "gui/shell/window_menus.h"
#include "gui/window_state/action_registry.h"
#include "gui/window_state/feature.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {

// The actions of the main window itself.
struct ShellActions {
  explicit ShellActions(ActionRegistry& book);

  QAction* quit = nullptr;
  QAction* nextTheme = nullptr;
  QAction* fullScreen = nullptr;
  QAction* dismiss = nullptr;
  QActionGroup* themes = nullptr;
};

class CentralWidget;
class MessageBanner;
class StatusReport;

class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  explicit MainWindow(const WindowEnvironment& environment);
  ~MainWindow() override;

  WindowState& state() noexcept { return *windowState_; }
  DockArrangement& docks() noexcept { return *docks_; }
  // The feature of class `Part`. Throws std::logic_error when there is none.
  template <class Part>
  Part& feature() {
    for (const auto& each : features_)
      if (auto* part = dynamic_cast<Part*>(each.get())) return *part;
    throw std::logic_error("MainWindow: no such feature");
  }

  // Stops a moving hand at once, then closes unasked.
  void endNow();
  // Closes without asking: unsaved events are saved, a recording is finished. The window stays open
  // when events can't be saved.
  void closeUnasked();
  // Waits until all reading, computing and writing has ended; for tests and pictures.
  void settle();

 protected:
  void closeEvent(QCloseEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  void connectPlace();
  void connectActions();
  void connectMessages();
  void addFeatures();
  void showTitle();
  void showTheme();
  void showBorder();
  void setFullScreen(bool on);
  void remember();

  std::unique_ptr<WindowState> windowState_;
  ShellActions actions_;
  std::unique_ptr<WindowMenus> menus_;
  CentralWidget* centre_;
  std::unique_ptr<DockArrangement> docks_;
  std::unique_ptr<LayoutMenu> layoutMenu_;
  MessageBanner* banner_;
  std::unique_ptr<StatusReport> status_;
  std::vector<std::unique_ptr<Feature>> features_;
  // Closes the window as soon as nothing is connected any more; unset: the window stays open.
  QMetaObject::Connection closing_;
  // It is closed without asking.
  bool unasked_ = false;
};

}  // namespace palpate::gui
