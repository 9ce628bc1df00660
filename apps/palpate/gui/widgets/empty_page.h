// Shown in place of a view that has nothing to show: tells why, and offers a button for what can be
// done.
#pragma once

#include <QWidget>

class QLabel;
class QPushButton;

namespace palpate::gui {

class EmptyPage : public QWidget {
  Q_OBJECT
 public:
  // `part`: prefix of the object names of its widgets.
  explicit EmptyPage(const QString& part, QWidget* parent = nullptr);
  // Without a text for the button there is no button.
  void say(const QString& text, const QString& button = {});
  QString text() const;

 signals:
  void buttonClicked();

 private:
  QLabel* text_;
  QPushButton* button_;
};

}  // namespace palpate::gui
