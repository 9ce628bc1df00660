#include "gui/shell/dock_arrangement.h"

#include <QAction>
#include <QChildEvent>
#include <QFontInfo>
#include <QGuiApplication>
#include <QLayout>
#include <QRegularExpression>
#include <QTabBar>
#include <algorithm>

#include "gui/shell/central_widget.h"
#include "gui/shell/dock_layout.h"
#include "gui/widgets/dock.h"
#include "gui/widgets/fitting_pages.h"
#include "gui/window_state/action_registry.h"

namespace palpate::gui {
namespace {

using Kind = DisplayedSource::Kind;

// Least width of the right side [px]: a table fits without eliding.
constexpr int kNarrowestRight = 396;
constexpr double kRightShare = 0.3;  // of the window's width
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
QByteArray storedLayout(const QSettings& settings, const QString& key) {
  const QByteArray layout = settings.value(key).toByteArray();
  return isDockLayout(layout) ? layout : QByteArray();
}

// The kinds of source that have layouts, with their names in the settings and their first presets.
struct PlaceOfLayouts {
  Kind kind;
  const char* name;
  Preset preset;
};
constexpr PlaceOfLayouts kRecordingLayouts{Kind::kRecording, "recording", Preset::kWatch};
constexpr PlaceOfLayouts kLiveLayouts{Kind::kLive, "live", Preset::kGrasp};
constexpr PlaceOfLayouts kPlaces[] = {kRecordingLayouts, kLiveLayouts};

// What a name of a preset may contain, so that it is a key of the settings.
const QRegularExpression kPresetName("^[\\w .+()-]{1,30}$",
                                     QRegularExpression::UseUnicodePropertiesOption);
constexpr qsizetype kMaxOwnPresets = 10;

QString presetKey(const PlaceOfLayouts& place) { return QString("window/preset_") + place.name; }
QString layoutsGroup(const PlaceOfLayouts& place) {
  return QString("window/layouts_") + place.name;
}

QStringList presetNames() {
  QStringList names;
  for (const Preset preset : kAllPresets) names.append(nameOf(preset));
  return names;
}

QString shownKey(const Dock& dock) { return dock.objectName().toLower() + "/shown"; }

}  // namespace

DockArrangement::DockArrangement(QMainWindow& window,
                                 const CentralWidget& centre,
                                 QSettings& settings)
    : window_(window), centre_(centre), settings_(settings) {
  for (const PlaceOfLayouts& place : kPlaces) {
    settings.beginGroup(layoutsGroup(place));
    for (const QString& name : settings.childKeys())
      if (const QByteArray layout = storedLayout(settings, name);
          kPresetName.match(name).hasMatch() && !layout.isEmpty())
        layouts_[place.kind][name] = layout;
    settings.endGroup();
    const QString used = settings.value(presetKey(place)).toString();
    preset_[place.kind] =
        presetNames().contains(used) || ownPresets().contains(used) ? used : nameOf(place.preset);
  }
  preset_[Kind::kNothing];
  window.setCorner(Qt::BottomRightCorner, Qt::BottomDockWidgetArea);
  fitCorner();
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

void DockArrangement::fitPage(Dock& dock) {
  if (isAcross(window_.dockWidgetArea(&dock)) || opening_.contains(&dock)) return;
  // What the page before was widened by is given back, unless somebody has chosen another width.
  const auto last = pageWidths_.find(&dock);
  const int now = dock.width();
  const int usual = last != pageWidths_.end() && last->second.to == now ? last->second.from : now;
  // Once the layouts around the page know what it needs.
  const auto fit = [this, &dock, usual] {
    if (dock.isFloating() || dock.visibleRegion().isEmpty()) return;
    window_.resizeDocks({&dock}, {std::max(dock.contentWidth(), usual)}, Qt::Horizontal);
    QTimer::singleShot(0, &dock, [this, &dock, usual] {
      pageWidths_[&dock] = {usual, dock.width()};
    });
  };
  QTimer::singleShot(0, &dock, [&dock, fit] { QTimer::singleShot(0, &dock, fit); });
}

void DockArrangement::add(const DockSpec& offer) {
  for (const auto* pages : offer.dock->findChildren<FittingPages*>(kDockPages))
    connect(
        pages, &FittingPages::currentChanged, this, [this, dock = offer.dock] { fitPage(*dock); });
  QAction* toggle = offer.dock->toggleViewAction();
  setSection(*toggle, offer.menu);
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
  if (placed_) store();
  placed_ = true;
  place_ = place;
  restore();
}

void DockArrangement::store() {
  if (place_ != Kind::kNothing) layouts_[place_][preset()] = window_.saveState();
}

void DockArrangement::restore() {
  const QSize before = window_.size();
  std::vector<bool> shown;
  for (const DockSpec& offer : offers_) shown.push_back(!offer.dock->isHidden());
  const bool there = place_ != Kind::kNothing;
  if (!there) {
    for (const DockSpec& offer : offers_) offer.dock->hide();
  } else if (const QByteArray& layout = layouts_[place_][preset()];
             layout.isEmpty() || !window_.restoreState(layout)) {
    reset();
  }
  for (std::size_t i = 0; i < offers_.size(); ++i) {
    const DockSpec& offer = offers_[i];
    offer.dock->toggleViewAction()->setEnabled(there || offer.everywhere);
    if (offer.everywhere) offer.dock->setVisible(shown[i]);
  }
  fitCorner();
  keepWindowSize(before, leftWhileLive() ? leftWhileLive()->dock : nullptr);
  emit presetsChanged();
}

// The chart is as wide as the window; in a low one the column at its left has the whole height, so
// that its buttons are seen.
void DockArrangement::fitCorner() {
  constexpr int kLowLines = 52;  // of text
  const bool isLow = window_.height() < kLowLines * window_.fontMetrics().lineSpacing();
  const Qt::DockWidgetArea area = isLow ? Qt::LeftDockWidgetArea : Qt::BottomDockWidgetArea;
  if (window_.corner(Qt::BottomLeftCorner) != area) window_.setCorner(Qt::BottomLeftCorner, area);
}

void DockArrangement::use(const QString& preset) {
  if (place_ == Kind::kNothing) return;
  store();
  preset_[place_] = preset;
  restore();
  remember();
}

Preset DockArrangement::standard() const {
  for (const Preset each : kAllPresets)
    if (nameOf(each) == preset()) return each;
  return (place_ == Kind::kLive ? kLiveLayouts : kRecordingLayouts).preset;
}

QStringList DockArrangement::ownPresets() const {
  QStringList own;
  for (const auto& [kind, layouts] : layouts_)
    for (const auto& [name, layout] : layouts)
      if (!presetNames().contains(name) && !own.contains(name)) own.append(name);
  own.sort();
  return own;
}

QString DockArrangement::keepAs(const QString& name) {
  if (!kPresetName.match(name).hasMatch() || name.trimmed() != name)
    return "A name has 1 to 30 letters, digits, blanks and .+-()";
  if (presetNames().contains(name, Qt::CaseInsensitive))
    return name + " is one of Palpate's own: choose another name";
  if (!ownPresets().contains(name) && ownPresets().size() >= kMaxOwnPresets)
    return "There are " + QString::number(kMaxOwnPresets) + " saved layouts: remove one first";
  preset_[place_] = name;
  remember();
  emit presetsChanged();
  return {};
}

void DockArrangement::removeOwn() {
  const QString name = preset();
  if (!ownPresets().contains(name)) return;
  for (auto& [kind, layouts] : layouts_) layouts.erase(name);
  for (const PlaceOfLayouts& place : kPlaces)
    if (preset_[place.kind] == name) preset_[place.kind] = nameOf(place.preset);
  restore();
  remember();
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
  placeSides();
  const Preset like = standard();
  for (const DockSpec& offer : offers_) {
    offer.dock->setFloating(false);
    offer.dock->setVisible(std::find(offer.shownIn.begin(), offer.shownIn.end(), like) !=
                           offer.shownIn.end());
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
  if (place_ == Kind::kNothing) return;
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
  store();
  for (const PlaceOfLayouts& place : kPlaces) {
    settings_.setValue(presetKey(place), preset_[place.kind]);
    settings_.remove(layoutsGroup(place));
    for (const auto& [name, layout] : layouts_[place.kind])
      settings_.setValue(layoutsGroup(place) + "/" + name, layout);
  }
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
  const QSize windowBefore = window_.size();
  const QByteArray before = offer.dock->isHidden() ? window_.saveState() : QByteArray();
  offer.dock->show();
  offer.dock->raise();
  offer.dock->toggleViewAction()->setChecked(true);
  keepWindowSize(windowBefore, offer.dock);
  makeRoomFor(offer, before);
}

void DockArrangement::widen(Dock& dock, int widthPx) {
  const int spare = centre_.width() - centre_.comfortableWidth();
  const int wanted =
      std::max(dock.contentWidth(), std::min(widthPx, dock.width() + std::max(0, spare)));
  if (dock.width() < wanted) window_.resizeDocks({&dock}, {wanted}, Qt::Horizontal);
}

void DockArrangement::makeRoomFor(const DockSpec& offer, const QByteArray& before) {
  Dock* dock = offer.dock;
  Dock* below = bottom() ? bottom()->dock : nullptr;
  if (dock->isFloating()) return;
  const bool asTabs = offer.above && below && window_.height() < kLowWindow;
  if (asTabs) {
    // There is no room for both.
    window_.tabifyDockWidget(below, dock);
    dock->raise();
  }
  opening_.insert(dock);
  // Runs after the dock has got its place.
  QTimer::singleShot(0, this, [this, offer, dock, below, before, asTabs] {
    if (dock->isFloating() || dock->isHidden()) {
      opening_.erase(dock);
      return;
    }
    if (!isAcross(window_.dockWidgetArea(dock)))
      widen(*dock,
            std::max({offer.preferredWidthPx,
                      dock->contentWidth(),
                      // A table beside the start page, which needs little.
                      place_ == Kind::kNothing ? window_.width() / 2 : 0}));
    const int wanted = static_cast<int>(window_.height() * offer.shareOfHeight);
    if (!asTabs && dock->height() < wanted && below)
      window_.resizeDocks(
          {dock, below}, {wanted, static_cast<int>(window_.height() * kBottomBelow)}, Qt::Vertical);
    // The sizes hold after the layout has been applied.
    QTimer::singleShot(0, this, [this, dock, before] {
      opening_.erase(dock);
      if (dock->isFloating() || dock->isHidden()) return;
      if (!before.isEmpty()) opened_.try_emplace(dock, Change{before, seenDocks()});
      fitShown(*dock);  // another page may have been chosen meanwhile
    });
  });
}

std::vector<const Dock*> DockArrangement::seenDocks() const {
  std::vector<const Dock*> seen;
  for (const DockSpec& offer : offers_)
    if (!offer.dock->isHidden()) seen.push_back(offer.dock);
  return seen;
}

void DockArrangement::giveRoomBack(const Dock& dock) {
  giveSizeBack();
  const auto at = opened_.find(&dock);
  if (at == opened_.end()) return;
  const Change change = std::move(at->second);
  opened_.erase(at);
  if (seenDocks() != change.seen) return;
  QTimer::singleShot(0, this, [this, closed = &dock, before = change.before] {
    if (closed->isHidden()) window_.restoreState(before);
  });
}

void DockArrangement::fitToNewText() {
  window_.restoreState(text_.before);
  fitCorner();
}

bool DockArrangement::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && watched == &window_) fitCorner();
  if (event->type() == QEvent::ChildAdded && watched == &window_) {
    QObject* child = static_cast<QChildEvent*>(event)->child();
    if (child->isWidgetType()) child->installEventFilter(this);
  } else if (event->type() == QEvent::FontChange && watched == &window_) {
    // While it changes step by step, the layout before the first step counts.
    if (!textChange_.isActive())
      if (std::vector<const Dock*> now = seenDocks(); text_.before.isEmpty() || now != text_.seen)
        text_ = {window_.saveState(), std::move(now)};
    textChange_.start();
  } else if (event->type() == QEvent::Resize && QGuiApplication::mouseButtons() != Qt::NoButton) {
    opened_.clear();
    text_ = {};
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
    if (const auto* dock = qobject_cast<Dock*>(watched)) giveRoomBack(*dock);
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace palpate::gui
