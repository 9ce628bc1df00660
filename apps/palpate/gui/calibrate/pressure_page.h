// The page Pressure of the dock Calibrate: a calibration, made from a table of recordings or read
// from a file; its surface in slices, its samples, what it is worth and what it was made from.
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

class FactsView;
class FiguresTable;
class PressureChart;
class SurfaceChart;

class PressurePage : public ComputedPage {
  Q_OBJECT
 public:
  explicit PressurePage(QWidget* parent = nullptr);
  void setTheme(Theme theme) override;
  std::vector<ExportedTable> tables() const override;
  void paint(QPainter& painter, const PictureLook& look, const QString& title) override;

  // A table (CSV) or a calibration (.json).
  void open(const std::filesystem::path& path);
  // Null: none is there.
  const ShownCalibrationPtr& shownCalibration() const noexcept { return now_; }
  // Throws FileError.
  void save(const std::filesystem::path& path);
  QStringList facts() const;  // "name: value", as they are seen

  // How files are asked for; an empty answer means cancelled. Tests answer themselves.
  std::function<std::filesystem::path()> askForTable;
  std::function<std::filesystem::path(const QString& suggestion)> askForPlace;

 signals:
  // This calibration (a file) shall tell the forces of the hand from now on.
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

  std::filesystem::path path_;   // that is asked for
  std::filesystem::path saved_;  // where this very calibration is on disk; empty: nowhere
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
  QCheckBox* above_ = nullptr;  // the surface is seen from above, not in slices
  QStackedWidget* charts_;
  PressureChart* chart_;
  SurfaceChart* surface_;
  FiguresTable* samples_;
  FactsView* facts_;
  QBoxLayout* halves_;
};

}  // namespace palpate::gui
