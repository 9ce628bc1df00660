// The page Noise of the dock Calibrate: per matrix the line of the largest reading over
// temperature, its RMSE and range; kept as JSON, or as XML for the prior program.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <palpate/calibration/noise_floor.h>

#include "gui/widgets/computed_page.h"

class QLabel;
class QPushButton;
class QSpinBox;

namespace palpate::gui {

class FiguresTable;
class NoiseChart;

struct FoundNoise {
  NoiseFloor floor;
  NoiseFloorOptions options;
  std::filesystem::path file;
  std::string sha256;
};

class NoisePage : public ComputedPage {
  Q_OBJECT
 public:
  explicit NoisePage(QWidget* parent = nullptr);
  void setTheme(Theme theme) override;
  std::vector<ExportedTable> tables() const override;
  void paint(QPainter& painter, const PictureLook& look, const QString& title) override;

  // Null: none was computed.
  const std::shared_ptr<const FoundNoise>& found() const noexcept { return found_; }
  // .xml as the prior program reads it, else JSON. Throws FileError.
  void save(const std::filesystem::path& path) const;

  // How a place is asked for; an empty answer means cancelled. Tests answer themselves.
  std::function<std::filesystem::path(const QString& suggestion)> askForPlace;
  std::function<QString()> askForLines;

 signals:
  // High sensitivity of the hand shall go by these lines from now on.
  void applyRequested(const palpate::NoiseFloor& floor);

 protected:
  void compute() override;
  void forget() override;

 private:
  void take(const std::shared_ptr<const FoundNoise>& found);
  void showNotes(std::size_t matrix);
  QStringList names() const;

  std::shared_ptr<const FoundNoise> found_;
  QSpinBox* bins_;
  QPushButton* save_;
  QPushButton* apply_;
  FiguresTable* table_;
  QLabel* notes_;
  NoiseChart* chart_;
};

}  // namespace palpate::gui
