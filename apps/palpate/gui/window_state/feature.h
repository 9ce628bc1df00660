// A part of the window that plugs in: it makes its widgets, connects them to the bench, and says
// what it adds to the window. Features are listed in shell/features.cpp and know each other not.
#pragma once

#include <QKeySequence>
#include <QObject>
#include <QWidget>
#include <functional>
#include <vector>

#include "gui/picture/exported_view.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {

class Dock;

// A dock, and where it stands until somebody moves it.
struct DockSpec {
  Dock* dock = nullptr;
  QKeySequence key;  // shows and hides it
  Qt::DockWidgetArea area = Qt::RightDockWidgetArea;
  Qt::DockWidgetArea liveArea = Qt::RightDockWidgetArea;  // while what is connected is shown
  int tab = -1;        // place among the tabs on the right side; -1: it is none of them
  bool above = false;  // over the dock at the bottom
  bool shown = false;  // until somebody closes it
  bool shownLive = false;
  // It stays as it is, whatever else is shown; remembered under its name.
  bool everywhere = false;
  int preferredWidthPx = 0;          // so wide when somebody asks for it; 0: as it is
  double shareOfHeight = 0.0;        // of the window, likewise
  std::function<void()> asked = {};  // somebody has asked for it by its key; may be empty
};

// What stands in the middle of the window.
struct CentralViewSpec {
  enum class Where {
    kStart,    // when nothing is looked at
    kBeside,   // one next to the other
    kInstead,  // of these, while two recordings are compared
    kBelow     // of all, while a recording is looked at
  };
  Where where = Where::kBeside;
  QWidget* widget = nullptr;
};

// A line over the centre, seen while it has something to say.
struct BannerSpec {
  enum class Order { kAlarm, kMessage, kOffer, kOpening, kExport, kWork };
  Order order = Order::kWork;
  QWidget* widget = nullptr;
};

class Feature : public QObject {
  Q_OBJECT
 public:
  Feature(WindowState& windowState, QWidget* window) : windowState_(windowState), window_(window) {}

  virtual std::vector<DockSpec> docks() { return {}; }
  virtual std::vector<CentralViewSpec> centre() { return {}; }
  virtual std::vector<ExportedView> views() { return {}; }  // to be taken away
  virtual std::vector<BannerSpec> strips() { return {}; }
  virtual void start() {}     // all features are there
  virtual void remember() {}  // the window closes: into the settings
  virtual void settle() {}    // tests and pictures wait

 signals:
  void dockRequested(palpate::gui::Dock* dock);  // one of its own shall be seen

 protected:
  WindowState& state() const noexcept { return windowState_; }
  QWidget* window() const noexcept { return window_; }
  // A widget of its own is in the colours of the window, always.
  template <class Widget>
  void followTheme(Widget* widget) {
    connect(&windowState_.appearance, &ViewAppearance::themeChanged, widget, [this, widget] {
      widget->setTheme(windowState_.appearance.theme());
    });
  }
  // What an action does when it is chosen.
  template <class Do>
  void on(QAction* action, Do what) {
    connect(action, &QAction::triggered, this, what);
  }

 private:
  WindowState& windowState_;
  QWidget* window_;
};

}  // namespace palpate::gui
