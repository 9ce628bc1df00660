// A text in a place of fixed height, so that nothing around it moves; a longer text is scrolled.
// Tab stops here only while there is something to scroll; a frame shows that it has the keyboard.
#pragma once

#include <QFrame>
#include <QLabel>
#include <QScrollArea>

namespace palpate::gui {

class StatusLines : public QScrollArea {
  Q_OBJECT
 public:
  // Room for `lines` lines of text. `name` is the object name of the label.
  StatusLines(int lines, const QString& name, QWidget* parent = nullptr);
  QLabel& label() noexcept { return *label_; }
  QString text() const { return label_->text(); }
  // Begins at its first line; a text of which only numbers changed stays scrolled as it is. `tip`
  // is the tool tip, if it isn't the text.
  void setText(const QString& text, const QString& tip = {});

 protected:
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  QLabel* label_;
  QFrame* focusFrame_;
};

}  // namespace palpate::gui
