// Fields to type a number into. What is typed is never mutilated: a comma is a point, a number out
// of range is taken as the nearest in range, anything else as no change. Enter takes it, Escape
// doesn't.
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
