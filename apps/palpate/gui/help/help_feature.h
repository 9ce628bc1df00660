// The feature with the menu Help: the list of keys and the About dialog.
#pragma once

#include <QDialog>

#include "gui/window_state/feature.h"

namespace palpate::gui {

// The About dialog: version, licence, and the libraries that the program uses.
class AboutDialog : public QDialog {
  Q_OBJECT
 public:
  explicit AboutDialog(QWidget* parent);
  static QString text();
};

class HelpFeature : public Feature {
  Q_OBJECT
 public:
  HelpFeature(WindowState& windowState, QWidget* window);
};

}  // namespace palpate::gui
