#include "gui/hand/dialog_stop.h"

#include <QApplication>
#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLayout>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>
#include <utility>

#include "gui/widgets/dialog_properties.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

constexpr const char* kDialogStopName = "dialogStop";
constexpr const char* kDialogStopStateName = "dialogStopState";
constexpr const char* kDialogStopReached = "A hand is connected.";
constexpr const char* kDialogStopMoving = "The hand is moving.";
constexpr const char* kDialogStopNotReached = "The hand can't be stopped from here.";
constexpr const char* kDialogStopNotReachedTip =
    "Its motion controller does not answer: use the emergency stop, or switch its power off";

// No layout counts the width of its menu bar. A message box sizes itself, by the rows of its
// layout.
void widen(QDialog& dialog, QWidget& bar) {
  if (qobject_cast<QMessageBox*>(&dialog)) return;
  for (QWidget* child : bar.findChildren<QWidget*>()) child->ensurePolished();
  bar.layout()->invalidate();
  dialog.setMinimumWidth(std::max(dialog.minimumWidth(), bar.sizeHint().width()));
}

}  // namespace

DialogStop::DialogStop(QAction& stop, QObject* parent) : QObject(parent), stop_(stop) {
  qApp->installEventFilter(this);
}

void DialogStop::showState(QLabel& state) const {
  state.setText(!reached_ ? kDialogStopNotReached
                : moving_ ? kDialogStopMoving
                          : kDialogStopReached);
  state.setToolTip(reached_ ? "" : kDialogStopNotReachedTip);
}

void DialogStop::setReached(bool reached) {
  if (std::exchange(reached_, reached) != reached) showStates();
}

void DialogStop::setMoving(bool moving) {
  if (std::exchange(moving_, moving) != moving) showStates();
}

void DialogStop::showStates() const {
  for (QWidget* top : QApplication::topLevelWidgets()) {
    auto* dialog = qobject_cast<QDialog*>(top);
    if (!dialog) continue;
    auto* bar = dialog->findChild<QWidget*>(kDialogStopName, Qt::FindDirectChildrenOnly);
    if (!bar) continue;
    showState(*bar->findChild<QLabel*>(kDialogStopStateName));
  }
}

bool DialogStop::eventFilter(QObject* watched, QEvent* event) {
  // Polish comes before the dialogue gets its size, Show each time that it is opened.
  if (event->type() != QEvent::Polish && event->type() != QEvent::Show) return false;
  auto* dialog = qobject_cast<QDialog*>(watched);
  if (!dialog) return false;
  if (dialog->isModal())
    showIn(*dialog);
  else if (dialog->property(kWantsStopProperty).toBool())
    follow(*dialog);
  return false;
}

void DialogStop::follow(QDialog& dialog) {
  showIn(dialog);
  disconnect(&stop_, &QAction::enabledChanged, &dialog, nullptr);
  connect(&stop_, &QAction::enabledChanged, &dialog, [this, &dialog] { showIn(dialog); });
}

void DialogStop::showIn(QDialog& dialog) {
  QLayout* layout = dialog.layout();
  if (!layout) return;
  if (layout->menuBar() && layout->menuBar()->objectName() != kDialogStopName) return;
  auto* bar = dialog.findChild<QWidget*>(kDialogStopName, Qt::FindDirectChildrenOnly);
  if (!stop_.isEnabled()) {
    if (!bar) return;
    layout->setMenuBar(nullptr);
    layout->removeWidget(bar);
    bar->deleteLater();
    return;
  }
  if (bar) return widen(dialog, *bar);
  bar = named(new QWidget(&dialog), kDialogStopName);
  auto* button = makeButton(bar, "dialogStopButton", "Stop  (Esc)", stop_.toolTip());
  button->setProperty("danger", true);
  button->setFocusPolicy(Qt::NoFocus);
  connect(button, &QPushButton::clicked, &stop_, &QAction::trigger);
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(12, 8, 12, 0);
  auto* state = makeLabel(bar, kDialogStopStateName);
  // Every text has room: a dialogue doesn't change its size while it is read.
  state->ensurePolished();
  int width = 0;
  for (const char* text : {kDialogStopReached, kDialogStopMoving, kDialogStopNotReached}) {
    state->setText(text);
    width = std::max(width, state->sizeHint().width());
  }
  state->setMinimumWidth(width);
  showState(*state);
  row->addWidget(state);
  row->addStretch(1);
  row->addWidget(button);
  // A layout gives its menu bar a row of its own, whatever else the dialogue has. A message box
  // doesn't count it into its size: there it is a row below.
  auto* grid = qobject_cast<QGridLayout*>(layout);
  if (grid && qobject_cast<QMessageBox*>(&dialog))
    grid->addWidget(bar, grid->rowCount(), 0, 1, grid->columnCount());
  else
    layout->setMenuBar(bar);
  widen(dialog, *bar);
}

}  // namespace palpate::gui
