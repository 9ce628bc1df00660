// The feature with the menu Help: the list of keys, the manual, What's this and the About dialog.
#pragma once

#include <QDialog>
#include <QPointer>

#include "gui/window_state/feature.h"

namespace palpate::gui {

class ManualWindow;

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

 private:
  void showManual();

  QPointer<ManualWindow> manual_;
};

}  // namespace palpate::gui
