// A label whose text wraps also within a word that is wider than the label: after the separators of
// a file name. It needs no more width than a few letters, however long a name is.
#pragma once

#include <QLabel>

namespace palpate::gui {

class BreakingLabel : public QLabel {
  Q_OBJECT
 public:
  explicit BreakingLabel(QWidget* parent = nullptr);
  void setWholeText(const QString& text);
  // Without the invisible places at which the shown text may wrap.
  const QString& wholeText() const noexcept { return text_; }
  QSize minimumSizeHint() const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void renew();

  QString text_;
};

}  // namespace palpate::gui
