// A text in a place of fixed height, so that nothing around it moves; a longer text is scrolled.
#pragma once

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
  // Begins at its first line. `tip` is the tool tip, if it isn't the text.
  void setText(const QString& text, const QString& tip = {});

 private:
  QLabel* label_;
};

}  // namespace palpate::gui
