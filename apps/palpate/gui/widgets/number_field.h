// Input fields for a frame index and for seconds. A comma counts as a decimal point, a number out
// of range becomes the nearest one in range, and anything else changes nothing. Enter accepts the
// input, Escape discards it. A field for seconds serves for other measures too; it says which
// number was out of range, and is marked until its value changes or is edited again.
#pragma once

#include <QDoubleSpinBox>
#include <QSpinBox>

namespace palpate::gui {

class FrameField : public QSpinBox {
 public:
  explicit FrameField(QWidget* parent);

 protected:
  QValidator::State validate(QString& text, int& position) const override;
  void fixup(QString& text) const override;
  int valueFromText(const QString& text) const override;
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
};

class SecondsField : public QDoubleSpinBox {
  Q_OBJECT
 public:
  explicit SecondsField(QWidget* parent);
  // The unit in the texts of corrected(), as written after a number: "°", " counts".
  void setSaidUnit(const QString& unit) { saidUnit_ = unit; }
  // Shows `text` in place of the least value, as long as nothing is typed; empty: shows the value.
  void setPlaceholder(const QString& text);
  // Removes the mark of a corrected number.
  void endCorrection();
  // Marks the field as one whose number isn't used, or ends that.
  void showMark(bool on);

 signals:
  // The typed number was out of range: "Target of finger 0 distal: 200 is out of -90 .. 90°; set to
  // 90". Empty: the mark of the field ended.
  void corrected(const QString& what);

 protected:
  QValidator::State validate(QString& text, int& position) const override;
  void fixup(QString& text) const override;
  double valueFromText(const QString& text) const override;
  QString textFromValue(double value) const override;
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void showCorrection();

  QString saidUnit_;
  QString placeholder_;
  // What was typed, if it was out of range and that was not said yet.
  mutable QString outOfRange_;
  bool corrected_ = false;
  // The tool tip without the mark.
  QString usualToolTip_;
};

}  // namespace palpate::gui
