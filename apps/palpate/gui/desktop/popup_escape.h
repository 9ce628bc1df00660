// Tells whether a list or menu was open when Esc was pressed. Qt may close it before the shortcut
// of that key is triggered, which must then do nothing else.
#pragma once

#include <QObject>

namespace palpate::gui {

class PopupEscape : public QObject {
 public:
  explicit PopupEscape(QObject* parent);

  // Of the press that is being handled.
  bool inPopup() const noexcept { return inPopup_; }

 protected:
  // Filters the events of the whole application.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  bool inPopup_ = false;
};

}  // namespace palpate::gui
