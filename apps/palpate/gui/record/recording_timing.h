// The part of the recording dialog that says when a recording begins, when it stops by itself and
// when it goes on in a new file; it folds under a one-line summary.
#pragma once

#include "gui/record/folding_part.h"
#include "gui/source/recording_settings.h"

class QCheckBox;
class QDoubleSpinBox;
class QSpinBox;

namespace palpate::gui {

class RecordingTiming : public FoldingPart {
  Q_OBJECT
 public:
  explicit RecordingTiming(QWidget* parent = nullptr);

  void fill(const RecordingSettings& settings);
  void readInto(RecordingSettings& settings) const;

 protected:
  QString summary() const override;

 private:
  QSpinBox* countdown_;
  QCheckBox* onContact_;
  QDoubleSpinBox* threshold_;
  QDoubleSpinBox* stopAfter_;
  QDoubleSpinBox* released_;
  QDoubleSpinBox* splitMinutes_;
  QDoubleSpinBox* splitMb_;
};

}  // namespace palpate::gui
