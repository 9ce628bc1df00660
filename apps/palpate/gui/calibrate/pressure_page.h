// The page Pressure of the dock Calibrate: shows a calibration that was made from a table of
// recordings or read from a file, with slices of its surface, its samples, its quality and its
// origin.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "gui/calibrate/calibration_making.h"
#include "gui/widgets/computed_page.h"

class QBoxLayout;
class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QStackedWidget;

namespace palpate::gui {

class Ask;
class FactsView;
class FiguresTable;
class PressureChart;
class SurfaceChart;

class PressurePage : public ComputedPage {
  Q_OBJECT
 public:
  explicit PressurePage(Ask& ask, QWidget* parent = nullptr);
  std::vector<ExportedTable> tables() const override;
  void paint(QPainter& painter, const PictureLook& look, const QString& title) override;

  // The hand whose matrices can be chosen.
  void setHand(const HandDescription& hand);
  // Opens a table of recordings (CSV) or a calibration (.json).
  void open(const std::filesystem::path& path);
  // Null when no calibration is shown.
  const ShownCalibrationPtr& shownCalibration() const noexcept { return now_; }
  // Saves the shown calibration as a file. Throws FileError.
  void save(const std::filesystem::path& path);
  // The shown facts, each as "name: value".
  QStringList facts() const;

 signals:
  // The calibration in this file is to be applied to the hand from now on.
  void applyRequested(const QString& path);

 protected:
  bool ofRecording() const override { return false; }
  QString emptyReason() const override;
  void compute() override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void makeTop();
  void take(const ShownCalibrationPtr& made);
  void showOptions();
  void saveAs();
  void apply();
  CalibrationChoices choices() const;

  Ask& ask_;
  // The opened table or calibration.
  std::filesystem::path path_;
  // Where the shown calibration is stored on disk; empty when it is not saved.
  std::filesystem::path saved_;
  ShownCalibrationPtr now_;
  QLabel* name_ = nullptr;
  QPushButton* save_ = nullptr;
  QPushButton* apply_ = nullptr;
  QCheckBox* study_ = nullptr;
  QCheckBox* robust_ = nullptr;
  QComboBox* matrix_ = nullptr;
  QDoubleSpinBox* area_ = nullptr;
  QDoubleSpinBox* sensitivity_ = nullptr;
  QDoubleSpinBox* threshold_ = nullptr;
  // Shows the surface from above instead of in slices.
  QCheckBox* above_ = nullptr;
  QStackedWidget* charts_;
  PressureChart* chart_;
  SurfaceChart* surface_;
  FiguresTable* samples_;
  FactsView* facts_;
  QBoxLayout* halves_;
};

}  // namespace palpate::gui
