// The page Force of the dock Calibrate: pressures and forces by the calibration that is applied to
// this hand, as numbers for the shown frame and as a chart over time for a recording. It is empty
// without a calibration.
#pragma once

#include <QSettings>
#include <memory>
#include <optional>

#include <palpate/calibration/force_series.h>

#include "gui/appearance/display_units.h"
#include "gui/calibrate/applied_calibration.h"
#include "gui/widgets/computed_page.h"

class QDoubleSpinBox;
class QLabel;
class QPushButton;

namespace palpate::gui {

class Ask;
class FiguresTable;
class ForceChart;

class ForcePage : public ComputedPage {
  Q_OBJECT
 public:
  ForcePage(QSettings& settings, Ask& ask, QWidget* parent = nullptr);
  // The unit in which pressures are shown; tables() are in kPa.
  void setUnits(const DisplayUnits& units);
  void setPosition(double seconds) override;
  std::vector<ExportedTable> tables() const override;
  void paint(QPainter& painter, const PictureLook& look, const QString& title) override;

  void setKept(const KeptWithRecording& kept);
  // Call this when another calibration was applied.
  void calibrationChanged();
  // Shows the pressures of a connected hand instead of a recording.
  void setLiveHand(const HandDescription& hand);
  void showLive(const PressureFrame& pressure, const std::vector<std::string>& assumptions);
  // The forces of the recording; null when none were computed.
  const std::shared_ptr<const ForceSeries>& found() const noexcept { return found_; }

 signals:
  // The typed sensor settings are to be kept as an event of the recording.
  void keepRequested(double sensitivity, double thresholdCounts);
  // Another calibration was applied, or the applied one was removed.
  void applied();
  void seekRequested(double seconds);

 protected:
  QString emptyReason() const override;
  void compute() override;
  void forget() override;

 private:
  void makeTop();
  void take(const std::shared_ptr<const ForceSeries>& found, const SensorSettings& own);
  void showFrame();
  // The forces of the matrices and their sum.
  struct Shown {
    std::vector<MatrixForce> forces;
    double sumN = 0.0;
    double sdN = 0.0;
    bool areaKnown = true;
  };
  void showForces(const Shown& now);
  void showChosen(int row);
  void applyThis(const QString& path);
  void showCalibration();
  void chooseCalibration();
  std::string handName() const;
  QString rowName(std::size_t row) const;
  const HandDescription* hand() const;

  QSettings& settings_;
  Ask& ask_;
  KeptWithRecording kept_;
  // Settings that the user typed and that are not kept yet.
  std::optional<SensorSettings> said_;
  std::optional<HandDescription> liveHand_;
  double positionS_ = 0.0;
  ShownUnit pressure_;
  // Nothing: no forces are shown.
  std::optional<Shown> shownForces_;
  std::shared_ptr<const ForceSeries> found_;
  QLabel* name_ = nullptr;
  QWidget* recordedWith_ = nullptr;
  QPushButton* choose_ = nullptr;
  QPushButton* drop_ = nullptr;
  QPushButton* keep_ = nullptr;
  QDoubleSpinBox* sensitivity_ = nullptr;
  QDoubleSpinBox* threshold_ = nullptr;
  ForceChart* chart_;
  FiguresTable* table_;
  QLabel* assumed_ = nullptr;  // beside the settings
  QLabel* notes_;
};

}  // namespace palpate::gui
