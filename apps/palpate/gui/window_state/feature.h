// Base class of the features, the parts that plug into the window: a feature makes its widgets,
// connects them to the window state, and returns the docks, views and banners that it adds to the
// window. shell/features.cpp lists all features; none knows another one.
#pragma once

#include <QKeySequence>
#include <QObject>
#include <QWidget>
#include <array>
#include <functional>
#include <vector>

#include "gui/picture/exported_view.h"
#include "gui/window_state/window_state.h"

namespace palpate::gui {

class Dock;

// A layout of the docks for a task; the user chooses one.
enum class Preset { kWatch, kGrasp, kRecord, kAnalyse };
inline constexpr std::array kAllPresets{
    Preset::kWatch, Preset::kGrasp, Preset::kRecord, Preset::kAnalyse};
inline QString nameOf(Preset preset) {
  constexpr std::array kNames{"Watch", "Grasp", "Record", "Analyse"};
  return kNames[static_cast<std::size_t>(preset)];
}

// A dock and its default place, which the user can change.
struct DockSpec {
  Dock* dock = nullptr;
  // The key that shows and hides the dock.
  QKeySequence key;
  // The menu that shows and hides the dock.
  const char* menu = "View";
  Qt::DockWidgetArea area = Qt::RightDockWidgetArea;
  // The place while a live source is shown.
  Qt::DockWidgetArea liveArea = Qt::RightDockWidgetArea;
  // Position among the tabs on the right side; -1: the dock isn't one of the tabs.
  int tab = -1;
  // Whether the dock is placed above the dock at the bottom.
  bool above = false;
  // The presets in which the dock is visible by default.
  std::vector<Preset> shownIn = {};
  // Whether the dock keeps its visibility whatever source is shown; the settings store it under the
  // name of the dock.
  bool everywhere = false;
  // Least width when the user asks for the dock by its key [px]; 0: as it is.
  int preferredWidthPx = 0;
  // Least height then, as a share of the height of the window; 0: as it is.
  double shareOfHeight = 0.0;
  // Called when the user asks for the dock by its key; may be empty.
  std::function<void()> asked = {};
};

// A view in the centre of the window.
struct CentralViewSpec {
  enum class Where {
    // Shown when there is no source.
    kStart,
    // Side by side with the other views.
    kBeside,
    // In place of the kBeside views while two recordings are compared.
    kInstead,
    // Below all other views, while a recording is shown.
    kBelow
  };
  Where where = Where::kBeside;
  QWidget* widget = nullptr;
};

// A line above the centre, visible while it has something to show.
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
  // Views that can be exported.
  virtual std::vector<ExportedView> views() { return {}; }
  virtual std::vector<BannerSpec> strips() { return {}; }
  // Called once all features exist.
  virtual void start() {}
  // Called when the window closes: stores what belongs into the settings.
  virtual void remember() {}
  // Waits until all background work has ended; for tests and pictures.
  virtual void settle() {}

 signals:
  // Asks the window to show one of the docks of this feature.
  void dockRequested(palpate::gui::Dock* dock);

 protected:
  WindowState& state() const noexcept { return windowState_; }
  QWidget* window() const noexcept { return window_; }
  // Keeps the values that a widget shows in the units that the user chose.
  template <class Widget>
  void followUnits(Widget* widget) {
    const auto follow = [this, widget] { widget->setUnits(windowState_.appearance.view().units); };
    follow();
    connect(&windowState_.appearance, &ViewAppearance::unitsChanged, widget, follow);
  }
  // Connects an action to what it does.
  template <class Do>
  void on(QAction* action, Do what) {
    connect(action, &QAction::triggered, this, what);
  }

 private:
  WindowState& windowState_;
  QWidget* window_;
};

}  // namespace palpate::gui
