// The part of the recording dialog with the labels of the digit keys, which mark events during a
// recording: ten fields in two columns that fold under a one-line summary.
#pragma once

#include <array>

#include "gui/record/folding_part.h"

class QLineEdit;

namespace palpate::gui {

class KeyLabels : public FoldingPart {
  Q_OBJECT
 public:
  explicit KeyLabels(QWidget* parent = nullptr);

  // Labels of the keys 0..9; each may be empty.
  using Labels = std::array<QString, 10>;
  void setLabels(const Labels& labels);
  // Without leading and trailing blanks.
  Labels labels() const;

 protected:
  QString summary() const override;

 private:
  void fillGrid();

  std::array<QLineEdit*, 10> fields_{};
};

}  // namespace palpate::gui
