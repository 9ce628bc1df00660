#include "gui/shell/window_menus.h"

#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QLayout>
#include <QMainWindow>
#include <QMenuBar>
#include <QPushButton>
#include <QStyle>
#include <QTimer>
#include <QToolBar>
#include <QToolButton>
#include <algorithm>
#include <functional>
#include <utility>

#include "gui/shell/hand_chip.h"
#include "gui/widgets/eliding_box.h"
#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"
#include "gui/window_state/action_registry.h"

namespace palpate::gui {
namespace {

constexpr int kWidestRecordings = 420;  // [px] of the list of open recordings
constexpr int kRecordingsLetters = 16;  // that it keeps in a narrow bar, its arrow included
constexpr int kIconAndPadding = 46;     // [px]

void addChoices(QMenu* menu, const QString& title, const QActionGroup* group) {
  QMenu* choices = menu->addMenu(title);
  choices->addActions(group->actions());
}

// Calls a function when the sizes within a widget may have changed.
class SizeWatch : public QObject {
 public:
  SizeWatch(QWidget& widget, std::function<void()> changed)
      : QObject(&widget), changed_(std::move(changed)) {
    widget.installEventFilter(this);
  }
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::Resize || event->type() == QEvent::LayoutRequest) changed_();
    return QObject::eventFilter(watched, event);
  }

 private:
  std::function<void()> changed_;
};

}  // namespace

WindowMenus::WindowMenus(QMainWindow& window) : window_(window) {
  menus_.edit = new QMenu("&Edit", &window);
  menus_.connections = new QMenu(&window);
  menus_.only = new QMenu("&One matrix alone", &window);
  menus_.scanned = new QMenu("Scanned &taxels", &window);
  menus_.recent = new QMenu("Open &recent", &window);
  menus_.layout = new QMenu("&Layout", &window);
  menus_.speed = new QComboBox(&window);
  menus_.recordings = new ElidingBox(&window);
}

void WindowMenus::fill(const ActionRegistry& book, const QList<QAction*>& dockToggles) {
  buildMenuBar(book, dockToggles);
  // Menus that come and go keep Qt's menu bar in its mode for keys: letters that are typed next
  // would choose entries, those that move the hand among them.
  QMenuBar* menus = window_.menuBar();
  QObject::connect(menus, &QMenuBar::triggered, menus, [menus] {
    QTimer::singleShot(0, menus, [menus] { menus->clearFocus(); });
  });
  buildToolBar(book);
  addOthers(book);
  QAction* record = book.at("record");
  const auto follow = [this, record] {
    showRecording(record->property(kRecordingProperty).toBool());
    record_->setProperty(kPlannedProperty, record->property(kPlannedProperty));
    styleRecord();
  };
  QObject::connect(record, &QAction::changed, record_, follow);
  follow();
}

// Adds the actions that no other line names to the end of the menu of their section.
void WindowMenus::addOthers(const ActionRegistry& book) {
  for (QAction* action : book.all())
    if (action->associatedObjects().size() == 1 && !isHiddenInMenus(*action))
      if (QMenu* menu = sections_.value(sectionOf(*action))) menu->addAction(action);
}

Menus WindowMenus::shared() const { return menus_; }

void WindowMenus::buildMenuBar(const ActionRegistry& book, const QList<QAction*>& dockToggles) {
  const auto at = [&book](const char* id) { return book.at(id); };
  const auto menu = [this](const QString& title) {
    QMenu* made = window_.menuBar()->addMenu(title);
    sections_[QString(title).remove('&')] = made;
    return made;
  };
  // What belongs to a connected hand, or to recordings, is hidden without them.
  const auto of = [&at](QList<QAction*>& kind, std::initializer_list<const char*> ids) {
    QList<QAction*> actions;
    for (const char* id : ids) actions.append(at(id));
    kind.append(actions);
    return actions;
  };
  QMenu* file = menu("&File");
  file->addAction(at("open"));
  file->addMenu(menus_.recent);
  menus_.recent->setToolTipsVisible(true);
  file->addActions({at("openDemo"), at("importTable"), at("recover")});
  file->addSeparator();
  file->addActions(
      of(ofRecordings_, {"nextRecording", "previousRecording", "closeRecording", "saveEvents"}));
  file->addActions(of(ofRecordings_, {"saveAs"}));
  QMenu* labels = file->addMenu("La&bels and grasps");
  labels->addActions({at("importLabels"), at("exportLabels"), at("exportGrasps")});
  ofRecordings_.append(labels->menuAction());
  file->addSeparator();
  file->addActions({at("exportPicture"), at("exportAgain")});
  file->addSeparator();
  file->addActions({at("settings"), at("quit")});

  window_.menuBar()->addMenu(menus_.edit);
  sections_["Edit"] = menus_.edit;
  menus_.edit->addActions(of(ofRecordings_, {"undo", "redo"}));
  menus_.edit->addActions({at("copyPicture"), at("copyTable")});
  menus_.edit->addSeparator();
  menus_.edit->addActions(
      of(ofRecordings_, {"addLabel", "addNote", "addGrasp", "renameEvent", "removeEvent"}));
  menus_.edit->addSeparator();
  menus_.edit->addActions(of(ofRecordings_, {"nextEvent", "previousEvent", "toEvents"}));
  menus_.edit->addSeparator();
  QMenu* selected = menus_.edit->addMenu("&Selection");
  selected->addActions({at("selectFrom"), at("selectTo"), at("selectAll"), at("dropSelection")});
  selected->addActions({at("zoomSelection"), at("crop"), at("baselineOfSelection")});
  menus_.edit->addAction(at("nameTaxels"));

  QMenu* view = menu("&View");
  view->addActions({at("interpolated"), at("values"), at("filtered")});
  addChoices(view, "&Colour map", book.group("maps"));
  addChoices(view, "Colour r&ange", book.group("ranges"));
  view->addSeparator();
  view->addActions({at("matricesShown"), at("handShown")});
  QMenu* space = view->addMenu("Hand in 3-&D");
  addChoices(space, "&Taxels", book.group("taxelShapes"));
  addChoices(space, "Enclosin&g sphere", book.group("spheres"));
  space->addAction(at("sphereOfCentroids"));
  space->addSeparator();
  space->addActions({at("normals"), at("contacts"), at("slipArrows"), at("wire"), at("axes")});
  space->addSeparator();
  space->addActions({at("fitHand"), at("resetHand"), at("nearer"), at("further")});
  QMenu* turn = space->addMenu("T&urn and move");
  turn->addActions(book.all("orbits"));
  turn->addActions(book.all("pans"));
  space->addMenu(menus_.only);
  menus_.only->addActions(book.all("onlys"));
  QMenu* time = view->addMenu("&Timeline");
  addChoices(time, "&Signal", book.group("signalsPlotted"));
  QMenu* plots = time->addMenu("&Plotted matrices");
  plots->addActions(book.all("plots"));
  time->addAction(at("chooseCurves"));
  time->addActions({at("zoomIn"), at("zoomOut"), at("fit"), at("verticalAxes")});
  view->addSeparator();
  view->addMenu(menus_.layout);
  QMenu* docks = view->addMenu("D&ocks");
  QList<QAction*> analyses;
  for (QAction* toggle : dockToggles)
    (sectionOf(*toggle) == "View" ? docks->addAction(toggle) : analyses.append(toggle));
  view->addSeparator();
  addChoices(view, "Th&eme", book.group("themes"));
  view->addAction(at("fullScreen"));

  QMenu* analysis = menu("Ana&lysis");
  analysis->addActions({at("statistics"), at("differences"), at("newFormula")});
  analysis->addSeparator();
  analysis->addActions(analyses);
  analysis->addAction(at("slipReference"));
  analysis->addSeparator();
  analysis->addActions({at("whatIsIt"), at("compare"), at("batch")});

  QMenu* hand = menu("H&and");
  hand->addActions({at("connectHand"), at("tryEmulated")});
  hand->addActions(of(ofHand_, {"disconnectHand"}));
  hand->addSeparator();
  const auto part = [this, hand](const QString& title) {
    QMenu* made = hand->addMenu(title);
    made->setToolTipsVisible(true);
    ofHand_.append(made->menuAction());
    return made;
  };
  part("Mo&ve the hand")
      ->addActions({at("graspHand"),
                    at("reactiveGrasp"),
                    at("slipAwareGrasp"),
                    at("openHand"),
                    at("relaxHand")});
  hand->addActions(of(ofHand_, {"stopHand", "acknowledgeHand"}));
  hand->addSeparator();
  hand->addActions(of(ofHand_, {"live", "hold"}));
  QMenu* chart = part("L&ive chart");
  chart->addActions({at("freezeLive"), at("liveLanes"), at("liveNewest"), at("liveOldest")});
  chart->addActions({at("liveEarlier"), at("liveLater"), at("cursorBack"), at("cursorForward")});
  hand->addSeparator();
  hand->addActions(of(ofHand_, {"takeBaseline", "undoBaseline"}));
  hand->addMenu(menus_.scanned);
  ofHand_.append(menus_.scanned->menuAction());
  menus_.scanned->setToolTipsVisible(true);
  menus_.scanned->addActions({at("scanOnly"),
                              at("scanOnlyInTheirMatrices"),
                              at("scanWithout"),
                              at("scanAlso"),
                              at("scanAll")});
  menus_.scanned->addSeparator();
  menus_.scanned->addAction(at("chooseNone"));
  part("Other &programs")
      ->addActions(
          {at("streamSignals"), at("streamTactile"), at("streamFoxglove"), at("remoteControl")});
  hand->addActions(of(ofHand_, {"muteAlarms"}));

  QMenu* record = menu("&Record");
  ofHand_.append(record->menuAction());
  record->addActions(of(ofHand_, {"record"}));
  record->addActions({at("recordingSettings"), at("recordingPlan")});
  QMenu* marks = record->addMenu("Mar&ks");
  marks->addAction(at("mark"));
  marks->addActions(book.all("labels"));
  record->addSeparator();
  record->addActions({at("openRecorded"), at("renameRecorded"), at("discardRecorded")});

  QMenu* playback = menu("&Playback");
  ofRecordings_.append(playback->menuAction());
  playback->addAction(at("play"));
  playback->addSeparator();
  playback->addActions({at("stepBack"),
                        at("stepForward"),
                        at("tenBack"),
                        at("tenForward"),
                        at("toStart"),
                        at("toEnd"),
                        at("goToFrame")});
  playback->addSeparator();
  addChoices(playback, "Sp&eed", book.group("speeds"));
  playback->addActions({at("faster"), at("slower"), at("loop"), at("skipGaps")});

  QMenu* help = menu("&Help");
  help->addActions({at("manual"), at("whatsThis"), at("keys"), at("about")});
}

void WindowMenus::buildToolBar(const ActionRegistry& book) {
  const auto at = [&book](const char* id) { return book.at(id); };
  QToolBar* bar = bar_ = window_.addToolBar("Toolbar");
  bar->setObjectName("Toolbar");
  bar->setMovable(false);
  bar->setContextMenuPolicy(Qt::PreventContextMenu);
  bar->setIconSize({16, 16});
  addStop(*bar, at("stopHand"));
  chip_ = new HandChip(*at("acknowledgeHand"), bar);
  chipShown_ = bar->addWidget(chip_);
  chipShown_->setVisible(false);
  bar->addActions({at("open"), at("exportPicture")});
  bar->addSeparator();
  menus_.connections->setToolTipsVisible(true);
  auto* connectButton = named(new QToolButton(bar), "connectButton");
  connectButton->setDefaultAction(at("connectHand"));
  connectButton->setMenu(menus_.connections);
  connectButton->setPopupMode(QToolButton::InstantPopup);
  connectButton->setFocusPolicy(Qt::NoFocus);  // has a shortcut instead
  bar->addWidget(connectButton);
  link_ = makeLabel(bar, "LinkPill");
  linkAction_ = bar->addWidget(link_);
  bar->addAction(at("record"));
  record_ = qobject_cast<QToolButton*>(bar->widgetForAction(at("record")));
  record_->setObjectName("recordButton");
  bar->addAction(at("live"));
  withText_.append(connectButton);
  for (QAction* action : {at("open"), at("exportPicture"), at("live")})
    withText_.append(qobject_cast<QToolButton*>(bar->widgetForAction(action)));
  playback_ = bar->addWidget(makePlayback(*bar, book));
  setPlaybackShown(false);
  showLink({}, false);
  setCompact(false);
  auto* spacer = new QWidget(bar);
  spacer->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  bar->addWidget(spacer);
  menus_.recordings->setObjectName("recordingsBox");
  menus_.recordings->setToolTip("Open recordings (Ctrl+Tab)");
  menus_.recordings->setPlaceholderText("Open recordings");
  menus_.recordings->setAccessibleName("Open recordings");
  menus_.recordings->setFocusPolicy(Qt::NoFocus);  // has a shortcut instead
  menus_.recordings->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  menus_.recordingsShown = bar->addWidget(menus_.recordings);
  bar->addAction(menus_.layout->menuAction());
  auto* layouts = qobject_cast<QToolButton*>(bar->widgetForAction(menus_.layout->menuAction()));
  layouts->setObjectName("layoutButton");
  layouts->setPopupMode(QToolButton::InstantPopup);
  bar->addAction(at("keys"));
  new SizeWatch(*bar, [this] { fitBar(); });
}

// Stop is at the beginning of the tool bar, where nothing covers it, whatever the window shows, as
// long as a hand is connected that can be moved.
void WindowMenus::addStop(QToolBar& bar, QAction* stop) {
  auto* button = makeButton(&bar, "toolBarStop", "Stop");
  button->setProperty("danger", true);
  button->setFocusPolicy(Qt::NoFocus);  // has a key instead
  QObject::connect(button, &QPushButton::clicked, stop, &QAction::trigger);
  QAction* shown = bar.addWidget(button);
  const auto follow = [shown, button, stop] {
    shown->setVisible(stop->isEnabled());
    button->setToolTip(stop->toolTip());
  };
  QObject::connect(stop, &QAction::changed, button, follow);
  follow();
}

// Groups the playback controls in one widget, which is hidden while a live source is shown.
QWidget* WindowMenus::makePlayback(QToolBar& bar, const ActionRegistry& book) {
  const auto at = [&book](const char* id) { return book.at(id); };
  auto* group = new QWidget(&bar);
  auto* row = new QHBoxLayout(group);
  row->setContentsMargins(8, 0, 0, 0);
  row->setSpacing(5);
  const auto add = [&](QAction* action) {
    auto* button = new QToolButton(group);
    button->setDefaultAction(action);
    button->setIconSize(bar.iconSize());
    button->setFocusPolicy(Qt::NoFocus);  // has a shortcut instead
    row->addWidget(button);
    return button;
  };
  add(at("toStart"));
  add(at("stepBack"));
  play_ = add(at("play"));
  fitToText(*play_, [this] { setPlayWidth(); });
  add(at("stepForward"));
  menus_.speed->setObjectName("speedBox");
  menus_.speed->setToolTip("Speed (Up, Down)");
  menus_.speed->setAccessibleName("Speed");
  menus_.speed->setFocusPolicy(Qt::NoFocus);  // has a shortcut instead
  for (const QAction* each : book.group("speeds")->actions()) menus_.speed->addItem(each->text());
  row->addWidget(menus_.speed);
  withText_.append({play_, add(at("loop")), add(at("skipGaps"))});
  return group;
}

void WindowMenus::setPlaybackShown(bool on) { playback_->setVisible(on); }

void WindowMenus::setCompact(bool on) {
  compact_ = on;
  styleRecord();
  for (QToolButton* button : withText_)
    button->setToolButtonStyle(on ? Qt::ToolButtonIconOnly : Qt::ToolButtonTextBesideIcon);
  setPlayWidth();
}

void WindowMenus::setPlayWidth() {
  // "Play" and "Pause" get the same width, so that nothing moves when the playback starts.
  const int textWidth = play_->fontMetrics().horizontalAdvance(" Pause");
  play_->setMinimumWidth(compact_ ? 0 : textWidth + kIconAndPadding);
}

void WindowMenus::showLink(const QString& text, bool good) {
  if (link_->text() != text) {
    link_->setText(text);
    fitted_.clear();
    fitBar();
  }
  if (link_->property("good").toBool() == good && link_->property("good").isValid()) return;
  link_->setProperty("good", good);
  link_->style()->unpolish(link_);
  link_->style()->polish(link_);
}

void WindowMenus::showHand(const HandCommands& hand) {
  const auto& condition = hand.condition();
  if (condition) chip_->setCondition(*condition, hand.task());
  if (chipShown_->isVisible() != condition.has_value())
    chipShown_->setVisible(condition.has_value());
}

// While recording, the duration and size are always shown, and else what the plan says.
void WindowMenus::styleRecord() {
  const bool text = !compact_ || record_->property("recording").toBool() ||
                    record_->property(kPlannedProperty).toBool();
  record_->setToolButtonStyle(text ? Qt::ToolButtonTextBesideIcon : Qt::ToolButtonIconOnly);
}

void WindowMenus::fitBar() {
  // The planned text of Record gives way first, then the words of all buttons, then the names of
  // recordings, then what is connected (the status bar has it, too), and at last the word of the
  // chip.
  const bool planned = record_->property(kPlannedProperty).toBool();
  std::vector<int> now{bar_->width(), planned};
  for (QAction* action : bar_->actions())
    if (const QWidget* shown = bar_->widgetForAction(action); shown && action->isVisible())
      now.push_back(shown->sizeHint().width());
  if (std::exchange(fitted_, now) == now) return;
  const auto taken = [this] {
    bar_->layout()->invalidate();
    return bar_->sizeHint().width();
  };
  record_->setMaximumWidth(planned ? kIconAndPadding +
                                         record_->fontMetrics().horizontalAdvance(
                                             " " + plainText(*record_->defaultAction()) + ": …")
                                   : QWIDGETSIZE_MAX);
  linkAction_->setVisible(!link_->text().isEmpty());
  chip_->setNarrow(false);
  QComboBox& list = *menus_.recordings;
  list.setMaximumWidth(kWidestRecordings);
  setCompact(false);
  if (taken() > bar_->width()) setCompact(true);
  if (const int over = taken() - bar_->width(); over > 0 && menus_.recordingsShown->isVisible()) {
    const int narrowest = kRecordingsLetters * list.fontMetrics().averageCharWidth();
    const int usual = std::min(list.sizeHint().width(), kWidestRecordings);
    list.setMaximumWidth(std::max(std::min(narrowest, usual), usual - over));
  }
  if (taken() > bar_->width()) linkAction_->setVisible(false);
  if (taken() > bar_->width()) chip_->setNarrow(chipShown_->isVisible());
  if (planned)
    record_->setMaximumWidth(record_->maximumWidth() + std::max(0, bar_->width() - taken()));
}

void WindowMenus::showRecording(bool on) {
  if (record_->property("recording").toBool() == on) return;
  record_->setProperty("recording", on);
  styleRecord();
  record_->style()->unpolish(record_);
  record_->style()->polish(record_);
}

}  // namespace palpate::gui
