// A label in as many lines as its width needs. A word that is longer than a line, such as the name
// of a file, is broken, so that it doesn't make the window wider.
#pragma once

#include <QLabel>

namespace palpate::gui {

class LongWordLabel : public QLabel {
  Q_OBJECT

 public:
  explicit LongWordLabel(QWidget* parent = nullptr);

  QSize minimumSizeHint() const override;
  int heightForWidth(int width) const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  bool isBroken(int width) const;
  QRect textRect(int width) const;
};

}  // namespace palpate::gui
