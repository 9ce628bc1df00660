// The dialog for the vertical axes of the timeline. Every change is shown at once.
#pragma once

#include <QDialog>
#include <QStringList>

#include "gui/timeline/axis_scale.h"

namespace palpate::gui {

class AxisScaleDialog : public QDialog {
  Q_OBJECT
 public:
  // `units`: of the axes that are shown; `seen`: their ranges, for axes that are set by hand next.
  AxisScaleDialog(const QStringList& units,
                  const AxisScales& scales,
                  const std::map<QString, std::pair<double, double>>& seen,
                  QWidget* parent = nullptr);
  const AxisScales& scales() const noexcept { return scales_; }

 signals:
  void changed();

 private:
  void put(const QString& unit, const AxisScale& scale);

  AxisScales scales_;
};

}  // namespace palpate::gui
