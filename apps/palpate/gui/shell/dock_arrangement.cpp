#include "gui/shell/dock_arrangement.h"

#include <QAction>
#include <QTimer>
#include <algorithm>

#include "gui/widgets/dock.h"
#include "gui/window_state/action_registry.h"

namespace palpate::gui {
namespace {

using Kind = DisplayedSource::Kind;

// Least width of the right side [px]: a table fits without eliding.
constexpr int kNarrowestRight = 455;
constexpr double kRightShare = 0.345;  // of the window's width
constexpr int kNarrowestRightLive = 330;
constexpr double kRightShareLive = 0.24;
constexpr int kLeftLiveWidth = 380;     // [px]
constexpr double kBottomShare = 0.235;  // of the window's height
// Share of the height for the bottom dock below a dock that the user asked for.
constexpr double kBottomBelow = 0.17;
// Below this height of the window [px] there is no room for both docks.
constexpr int kLowWindow = 760;

QString shownKey(const Dock& dock) { return dock.objectName().toLower() + "/shown"; }

}  // namespace

DockArrangement::DockArrangement(QMainWindow& window, QSettings& settings)
    : window_(window), settings_(settings) {
  layouts_[Kind::kRecording] = settings.value("window/layout").toByteArray();
  layouts_[Kind::kLive] = settings.value("window/live_layout").toByteArray();
  window.setCorner(Qt::BottomRightCorner, Qt::BottomDockWidgetArea);
  window.setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);
  window.setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
}

void DockArrangement::add(const DockSpec& offer) {
  QAction* toggle = offer.dock->toggleViewAction();
  setSection(*toggle, "View");
  toggle->setShortcut(offer.key);
  window_.addAction(toggle);
  connect(toggle, &QAction::triggered, this, [this, offer](bool shown) {
    if (!shown) return;
    if (offer.preferredWidthPx > 0) offer.dock->raise();
    makeRoomFor(offer);
    if (offer.asked) offer.asked();
  });
  offers_.push_back(offer);
}

void DockArrangement::begin() {
  place_ = Kind::kRecording;
  placeDocks();
  setPlace(Kind::kNothing);
  for (const DockSpec& offer : offers_)
    if (offer.everywhere)
      offer.dock->setVisible(settings_.value(shownKey(*offer.dock), false).toBool());
}

const DockSpec* DockArrangement::front() const {
  const auto at = std::find_if(
      offers_.begin(), offers_.end(), [](const DockSpec& offer) { return offer.tab == 0; });
  return at == offers_.end() ? nullptr : &*at;
}

const DockSpec* DockArrangement::bottom() const {
  const auto at = std::find_if(offers_.begin(), offers_.end(), [](const DockSpec& offer) {
    return offer.area == Qt::BottomDockWidgetArea && !offer.above;
  });
  return at == offers_.end() ? nullptr : &*at;
}

const DockSpec* DockArrangement::leftWhileLive() const {
  const auto at = std::find_if(offers_.begin(), offers_.end(), [](const DockSpec& offer) {
    return offer.liveArea == Qt::LeftDockWidgetArea && offer.area != offer.liveArea;
  });
  return at == offers_.end() ? nullptr : &*at;
}

// On the start page docks without content are hidden.
void DockArrangement::setPlace(Kind place) {
  if (placed_ && place == place_) return;
  if (placed_ && place_ != Kind::kNothing) layouts_[place_] = window_.saveState();
  std::vector<bool> shown;
  for (const DockSpec& offer : offers_) shown.push_back(!offer.dock->isHidden());
  placed_ = true;
  place_ = place;
  const bool there = place != Kind::kNothing;
  if (there) {
    if (layouts_[place].isEmpty() || !window_.restoreState(layouts_[place])) reset();
  } else {
    for (const DockSpec& offer : offers_) offer.dock->hide();
  }
  for (std::size_t i = 0; i < offers_.size(); ++i) {
    const DockSpec& offer = offers_[i];
    offer.dock->toggleViewAction()->setEnabled(there || offer.everywhere);
    if (offer.everywhere) offer.dock->setVisible(shown[i]);
  }
}

void DockArrangement::placeDocks() {
  const bool live = place_ == Kind::kLive;
  placeSides();
  for (const DockSpec& offer : offers_) {
    offer.dock->setFloating(false);
    offer.dock->setVisible(!offer.everywhere && (live ? offer.shownLive : offer.shown));
  }
  for (const DockSpec& offer : offers_) {
    if (!offer.above || !bottom()) continue;
    window_.splitDockWidget(bottom()->dock, offer.dock, Qt::Vertical);
    window_.splitDockWidget(offer.dock, bottom()->dock, Qt::Vertical);
    offer.dock->hide();
  }
  if (front()) front()->dock->raise();
}

// With a live source the dock Hand is on the left side; with a recording the user shows it when
// needed.
void DockArrangement::placeSides() {
  const bool live = place_ == Kind::kLive;
  std::vector<const DockSpec*> tabs;
  for (const DockSpec& offer : offers_) {
    const Qt::DockWidgetArea area = live ? offer.liveArea : offer.area;
    if (area == Qt::RightDockWidgetArea && offer.tab >= 0)
      tabs.push_back(&offer);
    else if (!offer.above)
      window_.addDockWidget(area, offer.dock);
  }
  std::stable_sort(tabs.begin(), tabs.end(), [](const DockSpec* a, const DockSpec* b) {
    return a->tab < b->tab;
  });
  for (const DockSpec* tab : tabs) window_.addDockWidget(Qt::RightDockWidgetArea, tab->dock);
  for (std::size_t i = 1; i < tabs.size(); ++i)
    window_.tabifyDockWidget(tabs.front()->dock, tabs[i]->dock);
}

void DockArrangement::reset() {
  if (place_ == Kind::kNothing) return layouts_.clear();
  const bool live = place_ == Kind::kLive;
  placeDocks();
  const double share = live ? kRightShareLive : kRightShare;
  const int narrowest = live ? kNarrowestRightLive : kNarrowestRight;
  if (front())
    window_.resizeDocks({front()->dock},
                        {std::max(narrowest, static_cast<int>(window_.width() * share))},
                        Qt::Horizontal);
  if (live && leftWhileLive())
    window_.resizeDocks({leftWhileLive()->dock}, {kLeftLiveWidth}, Qt::Horizontal);
  if (bottom())
    window_.resizeDocks(
        {bottom()->dock}, {static_cast<int>(window_.height() * kBottomShare)}, Qt::Vertical);
}

void DockArrangement::hideAll() {
  hidden_ = window_.saveState();
  for (const DockSpec& offer : offers_) offer.dock->hide();
}

void DockArrangement::bringBack() { window_.restoreState(hidden_); }

void DockArrangement::remember() {
  for (const DockSpec& offer : offers_)
    if (offer.everywhere) settings_.setValue(shownKey(*offer.dock), !offer.dock->isHidden());
  if (place_ != Kind::kNothing) layouts_[place_] = window_.saveState();
  settings_.setValue("window/layout", layouts_[Kind::kRecording]);
  settings_.setValue("window/live_layout", layouts_[Kind::kLive]);
}

void DockArrangement::setTheme(Theme theme) {
  for (const DockSpec& offer : offers_) offer.dock->setTheme(theme);
}

QStringList DockArrangement::names() const {
  QStringList names;
  for (const DockSpec& offer : offers_) names.append(offer.dock->objectName());
  return names;
}

void DockArrangement::show(const QString& name) {
  for (const DockSpec& offer : offers_) {
    if (offer.dock->objectName() != name) continue;
    offer.dock->show();
    offer.dock->raise();
    makeRoomFor(offer);
  }
}

QList<QAction*> DockArrangement::toggles() const {
  QList<QAction*> toggles;
  for (const DockSpec& offer : offers_) toggles.append(offer.dock->toggleViewAction());
  return toggles;
}

// Enlarges a dock that the user asked for, so that its content can be read.
void DockArrangement::makeRoomFor(const DockSpec& offer) {
  Dock* dock = offer.dock;
  const Dock* below = bottom() ? bottom()->dock : nullptr;
  if (offer.above && below && window_.height() < kLowWindow && !dock->isFloating()) {
    // Without room for both, they become tabs.
    window_.tabifyDockWidget(bottom()->dock, dock);
    dock->raise();
    return;
  }
  if (offer.preferredWidthPx == 0 && offer.shareOfHeight == 0.0) return;
  // Runs after the dock has got its place.
  QTimer::singleShot(0, this, [this, offer, dock] {
    if (dock->isFloating()) return;
    if (offer.preferredWidthPx > 0 && dock->width() < offer.preferredWidthPx)
      window_.resizeDocks({dock}, {offer.preferredWidthPx}, Qt::Horizontal);
    const int wanted = static_cast<int>(window_.height() * offer.shareOfHeight);
    if (wanted > 0 && dock->height() < wanted && bottom())
      window_.resizeDocks({dock, bottom()->dock},
                          {wanted, static_cast<int>(window_.height() * kBottomBelow)},
                          Qt::Vertical);
  });
}

}  // namespace palpate::gui
