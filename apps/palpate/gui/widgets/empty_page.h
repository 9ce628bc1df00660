// What stands where there is nothing to show: why, and what can be done about it.
#pragma once

#include <QWidget>

class QLabel;
class QPushButton;

namespace palpate::gui {

class EmptyPage : public QWidget {
  Q_OBJECT
 public:
  // `part`: the beginning of its parts' names.
  explicit EmptyPage(const QString& part, QWidget* parent = nullptr);
  // Without a text on its button there is no button.
  void say(const QString& text, const QString& button = {});
  QString text() const;

 signals:
  void buttonClicked();

 private:
  QLabel* text_;
  QPushButton* button_;
};

}  // namespace palpate::gui
