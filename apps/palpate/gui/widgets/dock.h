// A dock widget whose title row has its name, an optional header and a close button. All docks of
// the window are of this class.
#pragma once

#include <QDockWidget>

#include "gui/appearance/theme.h"

class QToolButton;

namespace palpate::gui {

class Dock : public QDockWidget {
  Q_OBJECT
 public:
  // `name` is the title and also the key in settings and for `--dock`. `header` (may be null) is
  // shown in the title row.
  Dock(const QString& name, QWidget* content, QWidget* header, QWidget* parent);
  // The width at which nothing of the dock has to be scrolled sideways [px].
  int contentWidth() const;

 private:
};

}  // namespace palpate::gui
