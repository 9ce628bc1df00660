// Lets the window's keys with Ctrl work while a text field has the focus. A field takes Ctrl+E,
// Ctrl+U, Ctrl+K and the like for itself (end of the line, delete the line); only the keys that
// everybody knows from fields stay with it: undo, redo, select all, copy, cut, paste. A double
// click in a number field selects the whole number, also right of its digits.
#pragma once

#include <QObject>

namespace palpate::gui {

class FieldKeys : public QObject {
 public:
  explicit FieldKeys(QObject* parent);

 protected:
  // Filters the events of the whole application.
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace palpate::gui
