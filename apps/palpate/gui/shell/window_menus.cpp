#include "gui/shell/window_menus.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMainWindow>
#include <QMenuBar>
#include <QStyle>
#include <QToolBar>
#include <QToolButton>

#include "gui/bench/actions.h"

namespace palpate::gui {
namespace {

constexpr int kWindowMenusControlHeight = 28;  // [px] of boxes beside buttons
constexpr int kIconAndPadding = 46;            // [px]

void addChoices(QMenu* menu, const QString& title, const QActionGroup* group) {
  QMenu* choices = menu->addMenu(title);
  choices->addActions(group->actions());
}

}  // namespace

WindowMenus::WindowMenus(QMainWindow& window, const Actions& actions)
    : resetLayout_(actions.resetLayout) {
  buildMenuBar(window, actions);
  buildToolBar(window, actions);
  QObject::connect(actions.record, &QAction::changed, record_, [this, action = actions.record] {
    showRecording(action->property(kRecordingProperty).toBool());
  });
}

Menus WindowMenus::shared() const { return menus_; }

void WindowMenus::addDocks(const QList<QAction*>& toggles) {
  view_->insertActions(resetLayout_, toggles);
}

void WindowMenus::buildMenuBar(QMainWindow& window, const Actions& actions) {
  QMenu* file = window.menuBar()->addMenu("&File");
  file->addAction(actions.open);
  menus_.recent = file->addMenu("Open &recent");
  menus_.recent->setToolTipsVisible(true);
  file->addAction(actions.openDemo);
  file->addSeparator();
  file->addActions({actions.nextRecording, actions.previousRecording, actions.closeRecording});
  file->addSeparator();
  file->addAction(actions.saveEvents);
  file->addSeparator();
  file->addActions(
      {actions.exportPicture, actions.exportAgain, actions.copyPicture, actions.copyTable});
  file->addSeparator();
  file->addAction(actions.quit);

  menus_.edit = window.menuBar()->addMenu("&Edit");
  menus_.edit->addActions({actions.undo, actions.redo});
  menus_.edit->addSeparator();
  menus_.edit->addActions({actions.addLabel, actions.addNote, actions.addGrasp});
  menus_.edit->addActions({actions.renameEvent, actions.removeEvent});
  menus_.edit->addSeparator();
  menus_.edit->addActions({actions.nextEvent, actions.previousEvent, actions.toEvents});
  menus_.edit->addSeparator();
  menus_.edit->addActions(
      {actions.selectFrom, actions.selectTo, actions.selectAll, actions.dropSelection});
  menus_.edit->addActions({actions.zoomSelection, actions.crop});
  menus_.edit->addSeparator();
  menus_.edit->addAction(actions.nameTaxels);

  view_ = window.menuBar()->addMenu("&View");
  view_->addActions({actions.interpolated, actions.values, actions.filtered});
  addChoices(view_, "&Colour map", actions.maps);
  view_->addAction(actions.nextMap);
  addChoices(view_, "Colour r&ange", actions.ranges);
  view_->addAction(actions.nextRange);
  view_->addSeparator();
  view_->addActions({actions.matricesShown, actions.handShown});
  QMenu* space = view_->addMenu("Hand in s&pace");
  space->addActions({actions.nextTaxelShape, actions.nextSphere, actions.sphereOfCentroids});
  space->addSeparator();
  space->addActions(
      {actions.normals, actions.contacts, actions.slipArrows, actions.wire, actions.axes});
  space->addSeparator();
  space->addActions({actions.fitHand, actions.resetHand, actions.nearer, actions.further});
  QMenu* turn = space->addMenu("&Turn and move");
  turn->addActions(actions.orbits);
  turn->addActions(actions.pans);
  menus_.only = space->addMenu("&One matrix alone");
  menus_.only->addActions(actions.onlys);
  view_->addSeparator();
  addChoices(view_, "Signal in the &timeline", actions.signalsPlotted);
  view_->addAction(actions.nextSignal);
  QMenu* plots = view_->addMenu("&Plotted matrices");
  plots->addActions(actions.plots);
  view_->addAction(actions.chooseCurves);
  view_->addActions({actions.zoomIn, actions.zoomOut, actions.fit});
  view_->addSeparator();
  view_->addActions({actions.slipReference, actions.compare});
  view_->addAction(actions.resetLayout);
  view_->addSeparator();
  addChoices(view_, "T&heme", actions.themes);
  view_->addAction(actions.nextTheme);
  view_->addAction(actions.fullScreen);

  QMenu* hand = window.menuBar()->addMenu("H&and");
  hand->addActions({actions.connectHand, actions.tryEmulated, actions.disconnectHand});
  hand->addSeparator();
  QMenu* move = hand->addMenu("Mo&ve the hand");
  move->setToolTipsVisible(true);
  move->addActions({actions.graspHand,
                    actions.reactiveGrasp,
                    actions.slipAwareGrasp,
                    actions.openHand,
                    actions.relaxHand});
  hand->addAction(actions.stopHand);
  hand->addSeparator();
  hand->addActions({actions.whatIsIt, actions.showMode});
  hand->addSeparator();
  hand->addActions({actions.live, actions.hold});
  hand->addSeparator();
  hand->addActions({actions.record, actions.recordingSettings, actions.openRecorded});
  QMenu* marks = hand->addMenu("&Marks");
  marks->addAction(actions.mark);
  marks->addActions(actions.labels);
  hand->addSeparator();
  menus_.scanned = hand->addMenu("Scanned &taxels");
  menus_.scanned->setToolTipsVisible(true);
  menus_.scanned->addActions(
      {actions.scanOnly, actions.scanWithout, actions.scanAlso, actions.scanAll});
  menus_.scanned->addSeparator();
  menus_.scanned->addAction(actions.chooseNone);
  QMenu* others = hand->addMenu("Other &programs");
  others->setToolTipsVisible(true);
  others->addActions({actions.streamSignals, actions.streamTactile, actions.remoteControl});
  hand->addAction(actions.muteAlarms);

  QMenu* playback = window.menuBar()->addMenu("&Playback");
  playback->addAction(actions.play);
  playback->addSeparator();
  playback->addActions({actions.stepBack,
                        actions.stepForward,
                        actions.tenBack,
                        actions.tenForward,
                        actions.toStart,
                        actions.toEnd,
                        actions.goToFrame});
  playback->addSeparator();
  addChoices(playback, "Sp&eed", actions.speeds);
  playback->addActions({actions.faster, actions.slower, actions.loop, actions.skipGaps});

  QMenu* help = window.menuBar()->addMenu("&Help");
  help->addActions({actions.keys, actions.about});
}

void WindowMenus::buildToolBar(QMainWindow& window, const Actions& actions) {
  QToolBar* bar = window.addToolBar("Toolbar");
  bar->setObjectName("Toolbar");
  bar->setMovable(false);
  bar->setContextMenuPolicy(Qt::PreventContextMenu);
  bar->setIconSize({16, 16});
  auto* brand = new QLabel("<b>Palpate</b>", bar);
  brand->setContentsMargins(4, 0, 10, 0);
  bar->addWidget(brand);
  bar->addActions({actions.open, actions.exportPicture});
  bar->addSeparator();
  menus_.connections = new QMenu(bar);
  menus_.connections->setToolTipsVisible(true);
  auto* connectButton = new QToolButton(bar);
  connectButton->setObjectName("connectButton");
  connectButton->setDefaultAction(actions.connectHand);
  connectButton->setMenu(menus_.connections);
  connectButton->setPopupMode(QToolButton::InstantPopup);
  connectButton->setFocusPolicy(Qt::NoFocus);  // it has a key
  bar->addWidget(connectButton);
  link_ = new QLabel(bar);
  link_->setObjectName("LinkPill");
  link_->setTextFormat(Qt::PlainText);
  linkAction_ = bar->addWidget(link_);
  bar->addAction(actions.record);
  record_ = qobject_cast<QToolButton*>(bar->widgetForAction(actions.record));
  record_->setObjectName("recordButton");
  bar->addAction(actions.live);
  withText_.append(connectButton);
  for (QAction* action : {actions.open, actions.exportPicture, actions.live})
    withText_.append(qobject_cast<QToolButton*>(bar->widgetForAction(action)));
  playback_ = bar->addWidget(makePlayback(*bar, actions));
  showLink({}, false);
  setCompact(false);
  auto* spacer = new QWidget(bar);
  spacer->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  bar->addWidget(spacer);
  menus_.recordings = new QComboBox(bar);
  menus_.recordings->setObjectName("recordingsBox");
  menus_.recordings->setMinimumHeight(kWindowMenusControlHeight);
  menus_.recordings->setToolTip("Open recordings (Ctrl+Tab)");
  menus_.recordings->setAccessibleName("Open recordings");
  menus_.recordings->setFocusPolicy(Qt::NoFocus);  // it has a key
  menus_.recordings->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  menus_.recordings->setMaximumWidth(420);
  menus_.recordingsShown = bar->addWidget(menus_.recordings);
  bar->addAction(actions.keys);
}

// What plays a recording, as one: while live is shown nothing of it is of use.
QWidget* WindowMenus::makePlayback(QToolBar& bar, const Actions& actions) {
  auto* group = new QWidget(&bar);
  auto* row = new QHBoxLayout(group);
  row->setContentsMargins(8, 0, 0, 0);
  row->setSpacing(5);
  const auto add = [&](QAction* action) {
    auto* button = new QToolButton(group);
    button->setDefaultAction(action);
    button->setIconSize(bar.iconSize());
    button->setFocusPolicy(Qt::NoFocus);  // it has a key
    row->addWidget(button);
    return button;
  };
  add(actions.toStart);
  add(actions.stepBack);
  play_ = add(actions.play);
  add(actions.stepForward);
  menus_.speed = new QComboBox(group);
  menus_.speed->setObjectName("speedBox");
  menus_.speed->setMinimumHeight(kWindowMenusControlHeight);
  menus_.speed->setToolTip("Speed (Up, Down)");
  menus_.speed->setAccessibleName("Speed");
  menus_.speed->setFocusPolicy(Qt::NoFocus);  // it has a key
  for (const QAction* each : actions.speeds->actions()) menus_.speed->addItem(each->text());
  row->addWidget(menus_.speed);
  withText_.append({play_, add(actions.loop), add(actions.skipGaps)});
  return group;
}

void WindowMenus::setPlaybackShown(bool on) { playback_->setVisible(on); }

void WindowMenus::setCompact(bool on) {
  compact_ = on;
  styleRecord();
  for (QToolButton* button : withText_)
    button->setToolButtonStyle(on ? Qt::ToolButtonIconOnly : Qt::ToolButtonTextBesideIcon);
  // "Play" and "Pause" take the same room: nothing jumps when the playback starts.
  const int textWidth = play_->fontMetrics().horizontalAdvance(" Pause");
  play_->setMinimumWidth(on ? 0 : textWidth + kIconAndPadding);
}

void WindowMenus::showLink(const QString& text, bool good) {
  if (linkAction_->isVisible() == text.isEmpty()) linkAction_->setVisible(!text.isEmpty());
  if (link_->text() != text) link_->setText(text);
  if (link_->property("good").toBool() == good && link_->property("good").isValid()) return;
  link_->setProperty("good", good);
  link_->style()->unpolish(link_);
  link_->style()->polish(link_);
}

// While it records, how long and how much is always read.
void WindowMenus::styleRecord() {
  const bool text = !compact_ || record_->property("recording").toBool();
  record_->setToolButtonStyle(text ? Qt::ToolButtonTextBesideIcon : Qt::ToolButtonIconOnly);
}

void WindowMenus::showRecording(bool on) {
  if (record_->property("recording").toBool() == on) return;
  record_->setProperty("recording", on);
  styleRecord();
  record_->style()->unpolish(record_);
  record_->style()->polish(record_);
}

}  // namespace palpate::gui
