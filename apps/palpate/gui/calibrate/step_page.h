// The page Steps of the dock Calibrate: the loading steps found in a matrix of the recording, each
// with its fit, the 95 % intervals and what speaks against it; the chosen one as a chart.
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

// What was found, with the signal that it was found in.
struct FoundSteps {
  StepReport report;
  StepSignal signal;
};

class StepPage : public ComputedPage {
  Q_OBJECT
 public:
  explicit StepPage(QWidget* parent = nullptr);
  void setTheme(Theme theme) override;
  void setPosition(double seconds) override;
  std::vector<ExportedTable> tables() const override;
  void paint(QPainter& painter, const PictureLook& look, const QString& title) override;

  // Null: none was computed.
  const std::shared_ptr<const FoundSteps>& found() const noexcept { return found_; }
  void choose(std::size_t step);
  std::optional<std::size_t> chosen() const;
  StepChart& chart() noexcept { return *chart_; }

 signals:
  // A row was chosen: its span in the recording [s].
  void spanChosen(double fromS, double toS);
  void seekRequested(double seconds);
  void foundChanged();  // other steps than before, or none

 protected:
  void compute() override;
  void forget() override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void take(const std::shared_ptr<const FoundSteps>& found);
  void showStep(std::size_t step);
  QString stepName(std::size_t step) const;
  QString matrixName(std::size_t matrix) const;

  std::shared_ptr<const FoundSteps> found_;
  std::optional<std::size_t> matrix_;  // nothing: the loaded one
  QComboBox* matrices_;
  QComboBox* signal_;
  QCheckBox* robust_;
  FiguresTable* table_;
  QLabel* notes_;
  StepChart* chart_;
  QBoxLayout* halves_;
};

}  // namespace palpate::gui
