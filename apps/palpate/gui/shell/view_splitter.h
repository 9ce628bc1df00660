// The views of the centre: side by side, or below one another where there is not enough width.
#pragma once

#include <QSplitter>

namespace palpate::gui {

class ViewSplitter : public QSplitter {
  Q_OBJECT
 public:
  explicit ViewSplitter(QWidget* parent = nullptr);

  // The width at which the visible views fit side by side [px].
  int widthSideBySide() const;
  // The smallest size at which the views fit in one of the two ways.
  QSize minimumSizeHint() const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;
  bool event(QEvent* event) override;

 private:
  // The sum of the smallest sizes of the visible views, with the handles between them, and the
  // largest of them.
  QSize sum() const;
  QSize largest() const;
  // Whether there is room for the views below one another.
  bool mayStack() const;
  void arrange();
};

}  // namespace palpate::gui
