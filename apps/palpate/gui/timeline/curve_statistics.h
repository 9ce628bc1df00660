// The statistics of the curves over the selected range, in a table that can be copied.
#pragma once

#include <QDialog>

#include <palpate/core/progress.h>
#include <palpate/core/text_table.h>

#include "gui/chart/plotted_curve.h"
#include "gui/picture/exported_view.h"
#include "gui/source/opened_recording.h"

namespace palpate::gui {

// A row per curve: its name and unit, the number of frames with a value, mean, standard deviation,
// smallest and largest value, slope [unit/s], integral over time [unit s]; see
// palpate/signals/range_statistics.h. Values are those of curveTable(). Reads every frame of the
// span. Throws Cancelled, FormatError (a damaged frame).
TextTable statisticsTable(const OpenedRecordingPtr& recording,
                          const std::vector<PlottedCurve>& curves,
                          const FrameSpan& span,
                          const Progress& progress = {});

class StatisticsDialog : public QDialog {
  Q_OBJECT
 public:
  // `range`: what the table is of, in words.
  StatisticsDialog(const TextTable& table, const QString& range, QWidget* parent = nullptr);
};

}  // namespace palpate::gui
