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

WindowMenus::WindowMenus(QMainWindow& window,
                         const Actions& actions,
                         const QList<QAction*>& dockToggles) {
  buildMenuBar(window, actions, dockToggles);
  buildToolBar(window, actions);
}

void WindowMenus::buildMenuBar(QMainWindow& window,
                               const Actions& actions,
                               const QList<QAction*>& toggles) {
  QMenu* file = window.menuBar()->addMenu("&File");
  file->addAction(actions.open);
  recent = file->addMenu("Open &recent");
  recent->setToolTipsVisible(true);
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

  edit = window.menuBar()->addMenu("&Edit");
  edit->addActions({actions.undo, actions.redo});
  edit->addSeparator();
  edit->addActions({actions.addLabel, actions.addNote, actions.addGrasp});
  edit->addActions({actions.renameEvent, actions.removeEvent});
  edit->addSeparator();
  edit->addActions({actions.nextEvent, actions.previousEvent, actions.toEvents});
  edit->addSeparator();
  edit->addActions(
      {actions.selectFrom, actions.selectTo, actions.selectAll, actions.dropSelection});
  edit->addActions({actions.zoomSelection, actions.crop});
  edit->addSeparator();
  edit->addAction(actions.nameTaxels);

  QMenu* view = window.menuBar()->addMenu("&View");
  view->addActions({actions.interpolated, actions.values, actions.filtered});
  addChoices(view, "&Colour map", actions.maps);
  view->addAction(actions.nextMap);
  addChoices(view, "Colour r&ange", actions.ranges);
  view->addAction(actions.nextRange);
  view->addSeparator();
  view->addActions({actions.matricesShown, actions.handShown});
  QMenu* space = view->addMenu("Hand in s&pace");
  space->addActions({actions.nextTaxelShape, actions.nextSphere, actions.sphereOfCentroids});
  space->addSeparator();
  space->addActions(
      {actions.normals, actions.contacts, actions.slipArrows, actions.wire, actions.axes});
  space->addSeparator();
  space->addActions({actions.fitHand, actions.resetHand, actions.nearer, actions.further});
  QMenu* turn = space->addMenu("&Turn and move");
  turn->addActions(actions.orbits);
  turn->addActions(actions.pans);
  only = space->addMenu("&One matrix alone");
  only->addActions(actions.onlys);
  view->addSeparator();
  addChoices(view, "Signal in the &timeline", actions.signalsPlotted);
  view->addAction(actions.nextSignal);
  QMenu* plots = view->addMenu("&Plotted matrices");
  plots->addActions(actions.plots);
  view->addAction(actions.chooseCurves);
  view->addActions({actions.zoomIn, actions.zoomOut, actions.fit});
  view->addSeparator();
  view->addActions({actions.slipReference, actions.compare});
  view->addActions(toggles);
  view->addAction(actions.resetLayout);
  view->addSeparator();
  addChoices(view, "T&heme", actions.themes);
  view->addAction(actions.nextTheme);
  view->addAction(actions.fullScreen);

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
  scanned = hand->addMenu("Scanned &taxels");
  scanned->setToolTipsVisible(true);
  scanned->addActions({actions.scanOnly, actions.scanWithout, actions.scanAlso, actions.scanAll});
  scanned->addSeparator();
  scanned->addAction(actions.chooseNone);
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
  connections = new QMenu(bar);
  connections->setToolTipsVisible(true);
  auto* connectButton = new QToolButton(bar);
  connectButton->setObjectName("connectButton");
  connectButton->setDefaultAction(actions.connectHand);
  connectButton->setMenu(connections);
  connectButton->setPopupMode(QToolButton::InstantPopup);
  connectButton->setFocusPolicy(Qt::NoFocus);  // it has a key
  bar->addWidget(connectButton);
  link = new QLabel(bar);
  link->setObjectName("LinkPill");
  link->setTextFormat(Qt::PlainText);
  linkAction_ = bar->addWidget(link);
  bar->addAction(actions.record);
  record = qobject_cast<QToolButton*>(bar->widgetForAction(actions.record));
  record->setObjectName("recordButton");
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
  recordings = new QComboBox(bar);
  recordings->setObjectName("recordingsBox");
  recordings->setMinimumHeight(kWindowMenusControlHeight);
  recordings->setToolTip("Open recordings (Ctrl+Tab)");
  recordings->setAccessibleName("Open recordings");
  recordings->setFocusPolicy(Qt::NoFocus);  // it has a key
  recordings->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  recordings->setMaximumWidth(420);
  recordingsAction = bar->addWidget(recordings);
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
  speed = new QComboBox(group);
  speed->setObjectName("speedBox");
  speed->setMinimumHeight(kWindowMenusControlHeight);
  speed->setToolTip("Speed (Up, Down)");
  speed->setAccessibleName("Speed");
  speed->setFocusPolicy(Qt::NoFocus);  // it has a key
  for (const QAction* each : actions.speeds->actions()) speed->addItem(each->text());
  row->addWidget(speed);
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
  if (link->text() != text) link->setText(text);
  if (link->property("good").toBool() == good && link->property("good").isValid()) return;
  link->setProperty("good", good);
  link->style()->unpolish(link);
  link->style()->polish(link);
}

// While it records, how long and how much is always read.
void WindowMenus::styleRecord() {
  const bool text = !compact_ || record->property("recording").toBool();
  record->setToolButtonStyle(text ? Qt::ToolButtonTextBesideIcon : Qt::ToolButtonIconOnly);
}

void WindowMenus::showRecording(bool on) {
  if (record->property("recording").toBool() == on) return;
  record->setProperty("recording", on);
  styleRecord();
  record->style()->unpolish(record);
  record->style()->polish(record);
}

}  // namespace palpate::gui
