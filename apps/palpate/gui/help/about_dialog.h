// The About dialog: version, licence, and the libraries that the program uses.
#pragma once

#include <QDialog>

namespace palpate::gui {

class AboutDialog : public QDialog {
  Q_OBJECT
 public:
  explicit AboutDialog(QWidget* parent);
  static QString text();
};

}  // namespace palpate::gui
