// What each digit key notes in a recording while it runs: ten labels in two columns, folded away
// under a line that sums them up.
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

  using Labels = std::array<QString, 10>;  // of the keys 0..9; may be empty
  void setLabels(const Labels& labels);
  Labels labels() const;  // without blanks around them

 signals:
  // Opened or folded: the widget wants another height now.
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
