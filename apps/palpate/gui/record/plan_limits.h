// The part of the plan of recordings with the limits of the check of each take; it folds under a
// one-line summary.
#pragma once

#include <palpate/recognition/take_quality.h>

#include "gui/record/folding_part.h"

class QDoubleSpinBox;
class QPushButton;
class QSpinBox;

namespace palpate::gui {

class PlanLimits : public FoldingPart {
  Q_OBJECT
 public:
  explicit PlanLimits(QWidget* parent = nullptr);
  void fill(const TakeCheckOptions& limits);
  // What the fields show.
  TakeCheckOptions limits() const;

 signals:
  // The user has changed a limit.
  void edited();

 protected:
  QString summary() const override;

 private:
  QDoubleSpinBox* least_;
  QSpinBox* lost_;
  QDoubleSpinBox* saturated_;
  QSpinBox* taxels_;
  QDoubleSpinBox* quality_;
  QPushButton* usual_;
};

}  // namespace palpate::gui
