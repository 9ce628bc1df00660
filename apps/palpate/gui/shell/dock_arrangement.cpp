#include "gui/shell/dock_arrangement.h"

#include <QAction>
#include <QChildEvent>
#include <QFontInfo>
#include <QLayout>
#include <QTabBar>
#include <algorithm>
#include <cstdlib>

#include "gui/shell/central_widget.h"
#include "gui/shell/dock_layout.h"
#include "gui/widgets/dock.h"
#include "gui/widgets/fitting_pages.h"
#include "gui/window_state/action_registry.h"

namespace palpate::gui {
namespace {

using Kind = DisplayedSource::Kind;

// Least width of the right side [px]: a table fits without eliding.
constexpr int kNarrowestRight = 455;
constexpr double kRightShare = 0.345;  // of the window's width
constexpr int kNarrowestRightLive = 330;
constexpr double kRightShareLive = 0.24;
// Largest width of the left side: in sizes of the text, and a share of the window's width.
constexpr int kLeftLiveEm = 24;
constexpr double kLeftLiveShare = 0.25;
constexpr double kBottomShare = 0.25;  // of the window's height
// Lines of text that the bottom dock has room for, whatever its share; below a recording there are
// rows of events, too, unless the window is low.
constexpr int kBottomLines = 11, kFewBottomLines = 9;
// Share of the height for the bottom dock below a dock that the user asked for.
constexpr double kBottomBelow = 0.17;
// Below this height of the window [px] there is no room for both docks.
constexpr int kLowWindow = 760;

// Whether docks of a side extend over the width of the window.
bool isAcross(Qt::DockWidgetArea side) {
  return side == Qt::BottomDockWidgetArea || side == Qt::TopDockWidgetArea;
}

// Empty: there is none that Qt can restore safely.
QByteArray storedLayout(const QSettings& settings, const char* key) {
  const QByteArray layout = settings.value(key).toByteArray();
  return isDockLayout(layout) ? layout : QByteArray();
}

QString shownKey(const Dock& dock) { return dock.objectName().toLower() + "/shown"; }

}  // namespace

DockArrangement::DockArrangement(QMainWindow& window,
                                 const CentralWidget& centre,
                                 QSettings& settings)
    : window_(window), centre_(centre), settings_(settings) {
  layouts_[Kind::kRecording] = storedLayout(settings, "window/layout");
  layouts_[Kind::kLive] = storedLayout(settings, "window/live_layout");
  window.setCorner(Qt::BottomRightCorner, Qt::BottomDockWidgetArea);
  window.setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);
  window.installEventFilter(this);
  constexpr int kTextChangeMs = 700;
  textChange_.setSingleShot(true);
  textChange_.setInterval(kTextChangeMs);
  connect(&textChange_, &QTimer::timeout, this, &DockArrangement::fitToNewText);
  window.setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
  connect(&window, &QMainWindow::tabifiedDockWidgetActivated, this, [this](QDockWidget* activated) {
    if (auto* dock = qobject_cast<Dock*>(activated)) fitShown(*dock);
  });
}

void DockArrangement::fitShown(Dock& dock) {
  if (isAcross(window_.dockWidgetArea(&dock))) return;
  QTimer::singleShot(0, &dock, [this, &dock] {
    if (!dock.isFloating() && !dock.visibleRegion().isEmpty()) widen(dock, 0);
  });
}

void DockArrangement::add(const DockSpec& offer) {
  for (const auto* pages : offer.dock->findChildren<FittingPages*>(kDockPages))
    connect(
        pages, &FittingPages::currentChanged, this, [this, dock = offer.dock] { fitShown(*dock); });
  QAction* toggle = offer.dock->toggleViewAction();
  setSection(*toggle, "View");
  toggle->setShortcut(offer.key);
  window_.addAction(toggle);
  // The key of a dock behind another tab brings it to the front, where Qt's own handler would close
  // it.
  toggle->disconnect(offer.dock);
  connect(toggle, &QAction::triggered, this, [this, offer] { this->toggle(offer); });
  offer.dock->installEventFilter(this);
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
  const QSize before = window_.size();
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
  keepWindowSize(before, leftWhileLive() ? leftWhileLive()->dock : nullptr);
}

void DockArrangement::keepWindowSize(QSize most, Dock* inFront) {
  const auto fits = [&] {
    window_.layout()->invalidate();
    const QSize least = window_.layout()->minimumSize();
    return least.width() <= most.width() && least.height() <= most.height();
  };
  for (const Qt::DockWidgetArea side :
       {Qt::LeftDockWidgetArea, Qt::RightDockWidgetArea, Qt::BottomDockWidgetArea}) {
    if (fits()) break;
    std::vector<Dock*> docks;
    for (const DockSpec& offer : offers_)
      if (!offer.dock->isHidden() && !offer.dock->isFloating() &&
          window_.dockWidgetArea(offer.dock) == side)
        docks.push_back(offer.dock);
    // Docks that are tabs already share one place, and tabifying them again only changes their
    // order.
    for (std::size_t i = 1; i < docks.size(); ++i)
      if (!window_.tabifiedDockWidgets(docks.front()).contains(docks[i]))
        window_.tabifyDockWidget(docks.front(), docks[i]);
  }
  if (inFront && !inFront->isHidden()) inFront->raise();
  // It may have grown before its docks became tabs, or grow until they have their sizes.
  const auto shrink = [this, most] {
    const QSize now = window_.size();
    const bool larger = now.width() > most.width() || now.height() > most.height();
    if (!larger || window_.isMaximized() || window_.isFullScreen()) return;
    window_.resize(now.boundedTo(most));
    // Its content needs more: the window is to have its size again once it needs less.
    if (window_.size() != now || (grown_ && grown_->to == now)) return;
    // It may have grown for another dock before.
    grown_ = Growth{grown_ && grown_->to == most ? grown_->from : most, now};
  };
  if (!window_.isVisible()) return;
  shrink();
  QTimer::singleShot(0, this, shrink);
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
  // Docks that are shown everywhere keep their width also while they are hidden.
  for (const DockSpec& offer : offers_) {
    if (!offer.everywhere || offer.dock->isHidden() || offer.dock->isFloating()) continue;
    const int usual = std::max(offer.preferredWidthPx, offer.dock->sizeHint().width());
    window_.resizeDocks({offer.dock}, {usual}, Qt::Horizontal);
  }
  if (place_ == Kind::kNothing) return layouts_.clear();
  const bool live = place_ == Kind::kLive;
  // A window grows at once when a dock doesn't fit.
  const QSize before = window_.size();
  placeDocks();
  const double share = live ? kRightShareLive : kRightShare;
  const int narrowest = live ? kNarrowestRightLive : kNarrowestRight;
  if (front())
    window_.resizeDocks(
        {front()->dock},
        {std::max(
            {narrowest, front()->dock->contentWidth(), static_cast<int>(window_.width() * share)})},
        Qt::Horizontal);
  if (live && leftWhileLive())
    window_.resizeDocks({leftWhileLive()->dock},
                        {std::min(kLeftLiveEm * QFontInfo(window_.font()).pixelSize(),
                                  static_cast<int>(window_.width() * kLeftLiveShare))},
                        Qt::Horizontal);
  if (bottom())
    window_.resizeDocks(
        {bottom()->dock},
        {std::max(static_cast<int>(window_.height() * kBottomShare),
                  (live || window_.height() < kLowWindow ? kFewBottomLines : kBottomLines) *
                      bottom()->dock->fontMetrics().lineSpacing())},
        Qt::Vertical);
  keepWindowSize(before, nullptr);
}

void DockArrangement::hideAll() {
  hidden_ = window_.saveState();
  for (const DockSpec& offer : offers_) offer.dock->hide();
}

void DockArrangement::bringBack() {
  window_.restoreState(hidden_);
  giveSizeBack();
}

void DockArrangement::giveSizeBack() {
  // Once the window's layout knows what the content needs now.
  QTimer::singleShot(0, this, [this] {
    // Not after somebody has chosen another size.
    if (!grown_ || window_.size() != grown_->to) return grown_.reset();
    window_.resize(grown_->from);
    if (window_.size() == grown_->from) return grown_.reset();
    grown_->to = window_.size();
  });
}

void DockArrangement::remember() {
  for (const DockSpec& offer : offers_)
    if (offer.everywhere) settings_.setValue(shownKey(*offer.dock), !offer.dock->isHidden());
  if (place_ != Kind::kNothing) layouts_[place_] = window_.saveState();
  settings_.setValue("window/layout", layouts_[Kind::kRecording]);
  settings_.setValue("window/live_layout", layouts_[Kind::kLive]);
}

QStringList DockArrangement::names() const {
  QStringList names;
  for (const DockSpec& offer : offers_) names.append(offer.dock->objectName());
  return names;
}

void DockArrangement::show(const QString& name) {
  for (const DockSpec& offer : offers_) {
    if (offer.dock->objectName() != name) continue;
    bringToFront(offer);
  }
}

QList<QAction*> DockArrangement::toggles() const {
  QList<QAction*> toggles;
  for (const DockSpec& offer : offers_) toggles.append(offer.dock->toggleViewAction());
  return toggles;
}

void DockArrangement::toggle(const DockSpec& offer) {
  Dock* dock = offer.dock;
  const bool inFront = dock->isVisible() && !dock->visibleRegion().isEmpty();
  if (inFront) {
    dock->close();
    return;
  }
  bringToFront(offer);
  if (offer.asked) offer.asked();
}

void DockArrangement::bringToFront(const DockSpec& offer) {
  // Measured before the dock takes its place.
  const QSize windowBefore = window_.size();
  Room before;
  if (const Dock* beside = neighbour(*offer.dock)) before.widthBefore = beside->width();
  if (offer.dock->isHidden()) before.opposite = opposite(*offer.dock);
  if (offer.shareOfHeight > 0.0 && bottom()) before.bottomBefore = bottom()->dock->height();
  offer.dock->show();
  offer.dock->raise();
  offer.dock->toggleViewAction()->setChecked(true);
  keepWindowSize(windowBefore, offer.dock);
  makeRoomFor(offer, before);
}

std::vector<DockArrangement::Opposite> DockArrangement::opposite(const Dock& dock) const {
  std::vector<Opposite> found;
  const Qt::DockWidgetArea side = window_.dockWidgetArea(const_cast<Dock*>(&dock));
  if (isAcross(side)) return found;
  for (const DockSpec& offer : offers_) {
    const Qt::DockWidgetArea its = window_.dockWidgetArea(offer.dock);
    if (offer.dock->isFloating() || offer.dock->visibleRegion().isEmpty() || its == side ||
        isAcross(its))
      continue;
    found.push_back({offer.dock, offer.dock->width(), 0});
  }
  return found;
}

Dock* DockArrangement::neighbour(const Dock& dock) const {
  Dock* found = nullptr;
  for (const DockSpec& offer : offers_) {
    if (offer.dock == &dock || offer.dock->isHidden() || offer.dock->isFloating() ||
        window_.dockWidgetArea(offer.dock) != window_.dockWidgetArea(const_cast<Dock*>(&dock)))
      continue;
    // A tab behind another has the size that it had when it was seen.
    if (!offer.dock->visibleRegion().isEmpty()) return offer.dock;
    if (!found) found = offer.dock;
  }
  return found;
}

void DockArrangement::widen(Dock& dock, int widthPx) {
  const int spare = centre_.width() - centre_.comfortableWidth();
  const int wanted =
      std::max(dock.contentWidth(), std::min(widthPx, dock.width() + std::max(0, spare)));
  if (dock.width() < wanted) window_.resizeDocks({&dock}, {wanted}, Qt::Horizontal);
}

// Enlarges a dock that the user asked for, so that its content can be read.
void DockArrangement::makeRoomFor(const DockSpec& offer, const Room& before) {
  Dock* dock = offer.dock;
  Dock* below = bottom() ? bottom()->dock : nullptr;
  if (dock->isFloating()) return;
  if (offer.above && below && window_.height() < kLowWindow) {
    // Without room for both, they become tabs.
    window_.tabifyDockWidget(below, dock);
    dock->raise();
    QTimer::singleShot(0, this, [this, dock, room = before]() mutable {
      if (dock->isFloating() || dock->isHidden()) return;
      room.bottom = heightOfBottom(*dock);
      rooms_.try_emplace(dock, room);
    });
    return;
  }
  // Runs after the dock has got its place.
  QTimer::singleShot(0, this, [this, offer, dock, below, before] {
    if (dock->isFloating() || dock->isHidden()) return;
    if (!isAcross(window_.dockWidgetArea(dock)))
      widen(*dock, std::max(offer.preferredWidthPx, dock->contentWidth()));
    const int wanted = static_cast<int>(window_.height() * offer.shareOfHeight);
    if (wanted > 0 && dock->height() < wanted && below) {
      window_.resizeDocks(
          {dock, below}, {wanted, static_cast<int>(window_.height() * kBottomBelow)}, Qt::Vertical);
    }
    // The sizes hold after the layout has been applied.
    QTimer::singleShot(0, this, [this, dock, below, room = before]() mutable {
      if (dock->isFloating() || dock->isHidden()) return;
      room.width = dock->width();
      for (Opposite& other : room.opposite) other.after = other.dock->width();
      if (room.bottomBefore > 0) room.bottom = heightOfBottom(*dock);
      rooms_.try_emplace(dock, room);
    });
  });
}

void DockArrangement::noteTextChange() {
  // While it changes step by step, the widths before the first step count.
  if (!textChange_.isActive())
    for (const DockSpec& offer : offers_) {
      Dock* dock = offer.dock;
      if (dock->isFloating() || dock->visibleRegion().isEmpty() ||
          isAcross(window_.dockWidgetArea(dock)))
        continue;
      TextWidth& width = textWidths_[dock];
      if (width.after != dock->width()) width.before = dock->width();
    }
  textChange_.start();
}

void DockArrangement::fitToNewText() {
  for (auto& [dock, width] : textWidths_) {
    if (dock->isFloating() || dock->visibleRegion().isEmpty()) continue;
    if (dock->width() > width.before) window_.resizeDocks({dock}, {width.before}, Qt::Horizontal);
    width.after = dock->width();
  }
}

bool DockArrangement::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::ChildAdded && watched == &window_) {
    QObject* child = static_cast<QChildEvent*>(event)->child();
    if (child->isWidgetType()) child->installEventFilter(this);
  } else if (event->type() == QEvent::FontChange && watched == &window_) {
    noteTextChange();
  } else if (event->type() == QEvent::LayoutRequest && watched == &window_ && grown_) {
    // The content may need less since the last attempt.
    giveSizeBack();
  } else if (event->type() == QEvent::Polish) {
    // Names of many tabs are scrolled: cut to a letter each they could not be told apart.
    if (auto* bar = qobject_cast<QTabBar*>(watched)) {
      bar->setElideMode(Qt::ElideNone);
      bar->setUsesScrollButtons(true);
    }
  } else if (event->type() == QEvent::Paint) {
    // Qt leaves tab bars without tabs over other widgets: they would draw a line across them, and
    // take their clicks.
    if (auto* bar = qobject_cast<QTabBar*>(watched)) {
      // The style draws the line below the tabs white in the dark theme.
      bar->setDrawBase(false);
      const bool empty = bar->count() == 0;
      bar->setAttribute(Qt::WA_TransparentForMouseEvents, empty);
      return empty;
    }
  } else if (event->type() == QEvent::Close) {
    const auto at = rooms_.find(qobject_cast<Dock*>(watched));
    if (at != rooms_.end()) {
      at->second.lastWidth = at->first->width();
      at->second.lastBottom = heightOfBottom(*at->first);
      // Who has chosen another width meanwhile keeps it.
      std::erase_if(at->second.opposite,
                    [](const Opposite& other) { return other.dock->width() != other.after; });
      giveRoomBack(*at->first);
    }
  }
  return QObject::eventFilter(watched, event);
}

// A tab that isn't in front keeps the height that it had when it was.
int DockArrangement::heightOfBottom(const Dock& dock) const {
  if (!bottom()) return 0;
  Dock* below = bottom()->dock;
  return window_.tabifiedDockWidgets(below).contains(const_cast<Dock*>(&dock)) ? dock.height()
                                                                               : below->height();
}

void DockArrangement::giveRoomBack(const Dock& dock) {
  giveSizeBack();
  const auto at = rooms_.find(&dock);
  if (at == rooms_.end()) return;
  const Room room = at->second;
  rooms_.erase(at);
  Dock* below = bottom() ? bottom()->dock : nullptr;
  QTimer::singleShot(0, this, [this, closed = &dock, room, below] {
    if (!closed->isHidden()) return;
    if (Dock* beside = neighbour(*closed); beside && room.widthBefore > 0 &&
                                           room.lastWidth == room.width &&
                                           room.width > room.widthBefore)
      window_.resizeDocks({beside}, {room.widthBefore}, Qt::Horizontal);
    for (const Opposite& other : room.opposite)
      if (!other.dock->visibleRegion().isEmpty() && other.after < other.before)
        window_.resizeDocks({other.dock}, {other.before}, Qt::Horizontal);
    // A little less or more is no change by the user: rows of events come and go.
    constexpr int kAlike = 40;  // [px]
    if (below && room.bottomBefore > 0 && !below->isHidden() &&
        std::abs(room.lastBottom - room.bottom) <= kAlike)
      window_.resizeDocks({below}, {room.bottomBefore}, Qt::Vertical);
  });
}

}  // namespace palpate::gui
