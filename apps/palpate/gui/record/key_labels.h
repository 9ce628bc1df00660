// The part of the recording dialog with the labels of the digit keys, which mark events during a
// recording: ten fields in two columns that fold under a one-line summary.
#pragma once

#include <QString>
#include <QWidget>
#include <array>

class QLabel;
class QLineEdit;
class QToolButton;

namespace palpate::gui {

class KeyLabels : public QWidget {
  Q_OBJECT
 public:
  explicit KeyLabels(QWidget* parent = nullptr);

  // Labels of the keys 0..9; each may be empty.
  using Labels = std::array<QString, 10>;
  void setLabels(const Labels& labels);
  // Without leading and trailing blanks.
  Labels labels() const;

 signals:
  // Opened or folded: the preferred height has changed.
  void folded();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QWidget* makeGrid();
  void fold(bool open);
  void sumUp();

  QToolButton* header_;
  QLabel* summary_;
  std::array<QLineEdit*, 10> fields_{};
  QWidget* grid_;
};

}  // namespace palpate::gui
