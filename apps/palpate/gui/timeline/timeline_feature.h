// The feature of the dock Timeline: curves over time of a recording or a live source, the selected
// and the visible span, cropping, and editing of events.
#pragma once

#include <QStackedWidget>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/computed/computed_series.h>

#include "gui/chart/plotted_curve.h"
#include "gui/timeline/baseline_controls.h"
#include "gui/timeline/crop_job.h"
#include "gui/timeline/event_editing.h"
#include "gui/timeline/signal_tree.h"
#include "gui/timeline/taxel_groups.h"
#include "gui/timeline/timeline_actions.h"
#include "gui/window_state/feature.h"

namespace palpate::gui {

class AxisEditor;
class CursorReadout;
class GraspExport;
class LiveChart;
class TimelineChart;
class TimelineHeader;
class TimelinePanel;

class TimelineFeature : public Feature {
  Q_OBJECT
 public:
  TimelineFeature(WindowState& windowState, QWidget* window);
  ~TimelineFeature() override;

  TimelinePanel& panel() noexcept { return *panel_; }
  BaselineControls& baselines() noexcept { return *baselines_; }
  LiveChart& liveChart() noexcept { return *liveChart_; }
  SignalTree& signalTree() noexcept { return *signalTree_; }
  CropJob& cropJob() noexcept { return *crop_; }

  std::vector<DockSpec> docks() override;
  std::vector<ExportedView> views() override;
  std::vector<BannerSpec> strips() override;
  void remember() override;
  void settle() override;

 private:
  void connectSubject();
  void connectLive();
  void connectLiveChart();
  void connectSelection();
  void connectActions();
  void connectCurves();
  void takeSource();
  // The series that can be computed of what is shown, with the calibration that is applied now.
  void renewComputed();
  // Escape: curves that are being computed are no longer ticked. False: none is.
  bool cancelComputing();
  // That of a matrix: in kPa or N where it is wanted and known.
  PlottedCurve matrixCurveOf(const HandDescription& hand, std::size_t row) const;
  void takeLive();
  // The curves that the live source has.
  void offerLiveCurves();
  void takeLiveSeries(const LiveResults& results);
  // Those beside the series of the hand, of what is shown.
  std::vector<SeriesDescription> furtherSeries() const;
  // What is plotted of each matrix, and the choices that show it.
  PlottedSignal plottedSignal() const;
  void showSignal();
  std::vector<PlottedCurve> curves() const;
  void showCurves();
  // Why curves of forces have gaps; empty: the calibration knows the area of its indenter, or no
  // force is plotted.
  QString reasonOfGaps(const std::vector<PlottedCurve>& curves) const;
  // Why a formula can't be computed on this recording; empty: it can.
  QString reasonAgainst(const FormulaCurve& formula) const;
  void showReading();
  void showSelection();
  void selectEnd(bool begin);
  void nameChosenTaxels();
  // Asks for a curve by a formula; an empty name: a new one.
  void askForFormula(const QString& name);
  void showStatistics();

  TimelineActions actions_;
  TaxelGroups groups_;
  PlottedExtras extras_;
  TimelineHeader* header_;
  SignalTree* signalTree_;
  QStackedWidget* charts_;
  TimelinePanel* panel_;
  // The chart of panel_.
  TimelineChart* chart_;
  CursorReadout* readout_;
  LiveChart* liveChart_;
  AxisEditor* axisEditor_;
  Dock* dock_;
  std::unique_ptr<CropJob> crop_;
  GraspExport* graspExport_;
  // Of the shown recording: computed_ are series of profile_, which is empty without a recording.
  std::vector<ComputedSeries> computed_;
  std::optional<Profile> profile_;
  // Computes the statistics of a selection.
  BackgroundJob statisticsJob_;
  std::unique_ptr<EventEditing> editing_;
  std::unique_ptr<BaselineControls> baselines_;
  // The reasons against formulas, by their text, and the recording that they are about.
  mutable std::map<QString, QString> reasons_;
  mutable std::weak_ptr<const OpenedRecording> reasonsFor_;
  // Identifies the source of the live chart; never dereferenced.
  const SignalHistory* history_ = nullptr;
  // The further series of the live source that have samples.
  std::vector<std::shared_ptr<const SeriesDescription>> liveSeries_;
  // Whether the live source has forces now: a calibration is applied.
  bool hasForces_ = false;
  // Whether its calibration lacks the area of the indenter: the forces are upper limits.
  bool forcesAreLimits_ = false;
};

}  // namespace palpate::gui
