// A row of controls that goes on in another line where there is no room for the next one.
#pragma once

#include <QList>
#include <QWidget>

namespace palpate::gui {

class WrappingRow : public QWidget {
 public:
  explicit WrappingRow(QWidget* parent = nullptr);

  // Puts `control` behind the others; it becomes a child of the row.
  void add(QWidget* control);

  // All controls in one line.
  QSize sizeHint() const override;
  // As wide as the widest control, as high as the lines at the present width.
  QSize minimumSizeHint() const override;
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;
  bool event(QEvent* event) override;

 private:
  // Where each visible control is in a row of this width [px].
  QList<QRect> places(int width) const;
  void arrange();

  QList<QWidget*> controls_;
};

}  // namespace palpate::gui
