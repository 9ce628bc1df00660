// Input fields for a frame index and for seconds. A comma counts as a decimal point, a number out
// of range becomes the nearest one in range, and anything else changes nothing. Enter accepts the
// input, Escape discards it.
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
 public:
  explicit SecondsField(QWidget* parent);

 protected:
  QValidator::State validate(QString& text, int& position) const override;
  void fixup(QString& text) const override;
  double valueFromText(const QString& text) const override;
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
};

}  // namespace palpate::gui
