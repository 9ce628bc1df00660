// About: version, licence, and what the program is built on.
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
