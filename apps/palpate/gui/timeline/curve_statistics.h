// The statistics of the curves over the selected range, in tables that can be copied, and their
// histogram and XY plot.
#pragma once

#include <QDialog>

#include <palpate/core/progress.h>
#include <palpate/core/text_table.h>

#include "gui/chart/plotted_curve.h"
#include "gui/picture/exported_view.h"
#include "gui/source/opened_recording.h"

namespace palpate::gui {

// The values of the shown curves at the frames of a selection.
struct SelectedCurves {
  struct Curve {
    QString name;
    QString unit;
    // One value per frame; NaN where there is none.
    std::vector<double> values = {};
  };
  // Times of the frames from the first frame of the recording [s].
  std::vector<double> timeS = {};
  std::vector<Curve> curves = {};
  // Longer intervals between frames are gaps [s].
  double gapS = 0.0;
};
// Values are in the units that are shown. Reads every frame of the span. Throws Cancelled,
// FormatError (a damaged frame). `with`: as curveTable().
SelectedCurves selectedCurves(const OpenedRecordingPtr& recording,
                              const std::vector<PlottedCurve>& curves,
                              const FrameSpan& span,
                              const Progress& progress = {},
                              const std::optional<Profile>& with = {});

// A row per curve: its name and unit, the number of frames with a value, mean, standard deviation,
// smallest and largest value, slope [unit/s], integral over time [unit s], median, rms; see
// palpate/signals/range_statistics.h.
TextTable statisticsTable(const SelectedCurves& selected);
// The same for files, in base units, as curveTable(). Reads every frame of the span. Throws
// Cancelled, FormatError (a damaged frame).
TextTable statisticsTable(const OpenedRecordingPtr& recording,
                          const std::vector<PlottedCurve>& curves,
                          const FrameSpan& span,
                          const Progress& progress = {},
                          const std::optional<Profile>& with = {});

// A row per curve: name, unit, its first and its last value in the selection, their difference, and
// the difference by the time between them [unit/s].
TextTable differenceTable(const SelectedCurves& selected);

// Shows the statistics, the differences between the ends, a histogram, and an XY plot of the
// selection.
class StatisticsDialog : public QDialog {
  Q_OBJECT
 public:
  // `range`: what the tables are of, in words.
  StatisticsDialog(const SelectedCurves& selected, const QString& range, QWidget* parent = nullptr);
};

}  // namespace palpate::gui
