// A dock with a calm title row: name, whatever belongs to it, and a way to close it.
#pragma once

#include <QDockWidget>

#include "gui/appearance/theme.h"

class QToolButton;

namespace palpate::gui {

class Dock : public QDockWidget {
  Q_OBJECT
 public:
  // `name` is the title and, in settings and `--dock`, the key. `header` (or null) stands in the
  // title row.
  Dock(const QString& name, QWidget* content, QWidget* header, QWidget* parent);
  void setTheme(Theme theme);

 private:
  QToolButton* close_;
};

}  // namespace palpate::gui
