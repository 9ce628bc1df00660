// The dialog with all keys (F1), collected from the actions of the window.
#pragma once

#include <QDialog>
#include <QList>
#include <QString>
#include <vector>

class QAction;

namespace palpate::gui {

// One line of the list: the keys and what they do.
struct KeyEntry {
  QString section;
  // The keys as text: "Up or +".
  QString keys;
  QString what;
};

// Every visible action that has a key, in the order of `actions`.
std::vector<KeyEntry> keysOf(const QList<QAction*>& actions);

class KeysDialog : public QDialog {
  Q_OBJECT
 public:
  KeysDialog(const QList<QAction*>& actions, QWidget* parent);
};

}  // namespace palpate::gui
