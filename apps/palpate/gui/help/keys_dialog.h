// F1: all keys, read from the actions themselves.
#pragma once

#include <QDialog>
#include <QList>
#include <QString>
#include <vector>

class QAction;

namespace palpate::gui {

struct KeyEntry {
  QString section;
  QString keys;  // "Up or +"
  QString what;
};

// Every visible action with a key, in the order of the list.
std::vector<KeyEntry> keysOf(const QList<QAction*>& actions);

class KeysDialog : public QDialog {
  Q_OBJECT
 public:
  KeysDialog(const QList<QAction*>& actions, QWidget* parent);
};

}  // namespace palpate::gui
