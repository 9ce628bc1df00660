// A line with large digits that counts down to a recording, with a button that cancels it.
#pragma once

#include <QWidget>

class QLabel;

namespace palpate::gui {

class CountdownStrip : public QWidget {
  Q_OBJECT
 public:
  explicit CountdownStrip(QWidget* parent = nullptr);
  // Shows the seconds left; 0 hides the line.
  void setLeft(int leftS);

 signals:
  void cancelRequested();

 private:
  QLabel* digits_;
};

}  // namespace palpate::gui
