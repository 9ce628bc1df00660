// Input fields for a whole number (a frame, a number of samples) and for a number with decimals
// (seconds and other measures). A comma counts as a decimal point. Enter accepts the input, Escape
// discards it. What is out of range or no number is refused: the value stays as it was, the field
// says so, and is marked for ten seconds, or until it is edited again or gets a value by the user.
#pragma once

#include <QDoubleSpinBox>
#include <QSpinBox>
#include <QTimer>

namespace palpate::gui {

// What was typed into a number field and isn't used.
class RefusedNumber : public QObject {
  Q_OBJECT
 public:
  explicit RefusedNumber(QAbstractSpinBox& field);
  // The unit in the texts of changed(), as written after a number: "°", " counts".
  void setSaidUnit(const QString& unit) { saidUnit_ = unit; }
  // `typed` is no number from `least` to `most` as the field takes it. It is said when the field is
  // left, or with Enter.
  void keep(const QString& typed, double least, double most);
  // What was kept is not said, and the mark goes: the input was discarded, or goes on.
  void end();
  bool marked() const noexcept { return marked_; }
  // Marks the field as one whose number isn't used, or ends that.
  void showMark(bool on);

 signals:
  // "Target of finger 0 distal: 200 is out of -90 .. 90°; 12.5 stays". Empty: the mark ended. Where
  // nobody takes it, it is shown beside the field.
  void changed(const QString& what);

 private:
  void tell();

  QAbstractSpinBox& field_;
  QString saidUnit_;
  // Why the input isn't used; empty: it is, or that was said.
  QString why_;
  bool marked_ = false;
  // Ends the mark; a value that the field only shows, such as a measured angle, doesn't.
  QTimer timer_{this};
  // The tool tip without the mark.
  QString usualToolTip_;
};

class FrameField : public QSpinBox {
 public:
  explicit FrameField(QWidget* parent);
  RefusedNumber& refused() const noexcept { return *refused_; }

 protected:
  QValidator::State validate(QString& text, int& position) const override;
  void fixup(QString& text) const override;
  int valueFromText(const QString& text) const override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  RefusedNumber* refused_;
};

class SecondsField : public QDoubleSpinBox {
 public:
  explicit SecondsField(QWidget* parent);
  // Shows `text` in place of the least value, as long as nothing is typed; empty: shows the value.
  void setPlaceholder(const QString& text);
  RefusedNumber& refused() const noexcept { return *refused_; }

 protected:
  QValidator::State validate(QString& text, int& position) const override;
  void fixup(QString& text) const override;
  double valueFromText(const QString& text) const override;
  QString textFromValue(double value) const override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  RefusedNumber* refused_;
  QString placeholder_;
};

}  // namespace palpate::gui
