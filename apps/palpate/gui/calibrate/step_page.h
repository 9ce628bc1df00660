// The page Steps of the dock Calibrate: a table of the loading steps found in one matrix of the
// recording, each with its fit, its 95 % intervals and its warnings; the chosen step is shown as a
// chart.
#pragma once

#include <memory>
#include <optional>

#include <palpate/calibration/step_report.h>

#include "gui/appearance/plotted_signal.h"
#include "gui/widgets/computed_page.h"

class QBoxLayout;
class QCheckBox;
class QComboBox;
class QLabel;

namespace palpate::gui {

class FiguresTable;
class StepChart;

// The steps that were found, and the signal that they were found in.
struct FoundSteps {
  StepReport report;
  StepSignal signal;
};

class StepPage : public ComputedPage {
  Q_OBJECT
 public:
  explicit StepPage(QWidget* parent = nullptr);
  void setPosition(double seconds) override;
  std::vector<ExportedTable> tables() const override;
  void paint(QPainter& painter, const PictureLook& look, const QString& title) override;

  // Null when no steps were searched for.
  const std::shared_ptr<const FoundSteps>& found() const noexcept { return found_; }
  void choose(std::size_t step);
  std::optional<std::size_t> chosen() const;
  StepChart& chart() noexcept { return *chart_; }

 signals:
  // The user chose a row: the span of its step in the recording [s].
  void spanChosen(double fromS, double toS);
  void seekRequested(double seconds);
  // Other steps were found, or none.
  void foundChanged();

 protected:
  QString emptyReason() const override;
  void compute() override;
  void forget() override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void take(const std::shared_ptr<const FoundSteps>& found);
  void showStep(std::size_t step);
  QString stepName(std::size_t step) const;
  QString matrixName(std::size_t matrix) const;

  std::shared_ptr<const FoundSteps> found_;
  // The evaluated matrix; nothing: the loaded one.
  std::optional<std::size_t> matrix_;
  QComboBox* matrices_;
  QComboBox* signal_;
  QCheckBox* robust_;
  FiguresTable* table_;
  QLabel* notes_;
  StepChart* chart_;
  QBoxLayout* halves_;
};

}  // namespace palpate::gui
