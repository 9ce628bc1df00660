// A line with large digits that counts down to a recording, with a button that cancels it.
#pragma once

#include <QWidget>

class QLabel;

namespace palpate::gui {

class CountdownStrip : public QWidget {
  Q_OBJECT
 public:
  explicit CountdownStrip(QWidget* parent = nullptr);
  // Shows the seconds left; 0 hides the line. `what`: what will be recorded; may be empty.
  void setLeft(int leftS, const QString& what = {});

 signals:
  void cancelRequested();

 private:
  QLabel* digits_;
  QLabel* text_;
};

}  // namespace palpate::gui
