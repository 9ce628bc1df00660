// A combo box that may be narrower than its text: the middle of the text is left out then, and the
// list shows it in full.
#pragma once

#include <QComboBox>

namespace palpate::gui {

class ElidingBox : public QComboBox {
  Q_OBJECT
 public:
  using QComboBox::QComboBox;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
};

}  // namespace palpate::gui
