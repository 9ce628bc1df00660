#include "gui/desktop/field_keys.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QLineEdit>

namespace palpate::gui {
namespace {

// Returns whether `clicked` is the line of a number field.
bool selectNumber(const QObject& clicked) {
  auto* field = qobject_cast<QAbstractSpinBox*>(clicked.parent());
  if (!field || !qobject_cast<const QLineEdit*>(&clicked)) return false;
  field->selectAll();
  return true;
}

}  // namespace

FieldKeys::FieldKeys(QObject* parent) : QObject(parent) { qApp->installEventFilter(this); }

bool FieldKeys::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::MouseButtonDblClick) return selectNumber(*watched);
  if (event->type() != QEvent::ShortcutOverride) return false;
  // A list that can be typed into has the focus in place of its field.
  const auto* list = qobject_cast<QComboBox*>(watched);
  if (!qobject_cast<QLineEdit*>(watched) && !qobject_cast<QAbstractSpinBox*>(watched) &&
      !(list && list->isEditable()))
    return false;
  const auto* key = static_cast<const QKeyEvent*>(event);
  const bool letter = key->key() >= Qt::Key_A && key->key() <= Qt::Key_Z;
  if (!letter || key->modifiers() != Qt::ControlModifier) return false;
  for (const Qt::Key own : {Qt::Key_A, Qt::Key_C, Qt::Key_V, Qt::Key_X, Qt::Key_Y, Qt::Key_Z})
    if (key->key() == own) return false;
  // An ignored override lets the shortcut be looked up; without one, the field gets the key.
  event->ignore();
  return true;
}

}  // namespace palpate::gui
