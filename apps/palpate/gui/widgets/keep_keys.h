// Keys that belong to a widget while it has the focus, although they are shortcuts of the window.
#pragma once

#include <QKeySequence>
#include <QList>
#include <functional>

class QWidget;

namespace palpate::gui {

// Up and Down, Home and End, Page Up and Page Down.
extern const QList<QKeySequence> kRowKeys;

// Each of `keys` is one key with exactly its modifiers, also where it is on the keypad. `pressed`
// is done in place of what the widget does with them itself.
void keepKeys(QWidget& widget, const QList<QKeySequence>& keys, std::function<void()> pressed = {});
// All keys that the desktop has for it, such as Ctrl+C and Ctrl+Insert.
void keepKeys(QWidget& widget, QKeySequence::StandardKey keys, std::function<void()> pressed = {});

}  // namespace palpate::gui
