#include "gui/desktop/wheel_guard.h"

#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QScrollBar>

namespace palpate::gui {
namespace {

bool isGuarded(const QWidget& widget) {
  if (qobject_cast<const QAbstractSpinBox*>(&widget) || qobject_cast<const QComboBox*>(&widget))
    return true;
  return qobject_cast<const QAbstractSlider*>(&widget) &&
         !qobject_cast<const QScrollBar*>(&widget) && !widget.property(kTakesWheel).toBool();
}

}  // namespace

WheelGuard::WheelGuard(QObject* parent) : QObject(parent) { qApp->installEventFilter(this); }

bool WheelGuard::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::Wheel && event->type() != QEvent::Polish) return false;
  auto* widget = qobject_cast<QWidget*>(watched);
  if (!widget || !isGuarded(*widget)) return false;
  if (event->type() == QEvent::Polish) {
    // With Qt::WheelFocus the wheel would give the control the focus first.
    if (widget->focusPolicy() == Qt::WheelFocus) widget->setFocusPolicy(Qt::StrongFocus);
    return false;
  }
  if (widget->hasFocus()) return false;
  // An ignored event goes to the parent, which scrolls.
  event->ignore();
  return true;
}

}  // namespace palpate::gui
