// The page Noise of the dock Calibrate: for each matrix a line fitted to the largest reading over
// temperature, with its RMSE and range, of a recording or measured now of the connected hand. It is
// saved as JSON, or as XML for the prior program.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <palpate/calibration/noise_floor.h>

#include "gui/source/file_reading.h"
#include "gui/widgets/computed_page.h"

class QLabel;
class QPushButton;
class QSettings;
class QSpinBox;

namespace palpate::gui {

class Ask;
class FiguresTable;
class MeasureRow;
class NoiseChart;

// A noise floor with the options and the recording that it was computed from.
struct FoundNoise {
  NoiseFloor floor;
  NoiseFloorOptions options;
  std::filesystem::path file;
  std::string sha256;
  // Frames of the connected hand; null: of a recording.
  OpenedRecordingPtr measured = {};
};

class NoisePage : public ComputedPage {
  Q_OBJECT
 public:
  NoisePage(QSettings& settings, Ask& ask, QWidget* parent = nullptr);
  std::vector<ExportedTable> tables() const override;
  void paint(QPainter& painter, const PictureLook& look, const QString& title) override;

  MeasureRow& measureRow() noexcept { return *measure_; }
  // Null when no noise floor was computed.
  const std::shared_ptr<const FoundNoise>& found() const noexcept { return found_; }
  // Saves the noise floor: an .xml file in the form of the prior program, any other as JSON. Throws
  // FileError.
  void save(const std::filesystem::path& path) const;

 signals:
  // The high-sensitivity mode of the hand is to use this noise floor from now on.
  void applyRequested(const palpate::NoiseFloor& floor);

 protected:
  void compute() override;
  void forget() override;
  QString liveReason() const override;

 private:
  void take(const std::shared_ptr<const FoundNoise>& found);
  void showNotes(std::size_t matrix);
  QStringList names() const;

  std::shared_ptr<const FoundNoise> found_;
  MeasureRow* measure_;
  QSpinBox* bins_;
  QPushButton* save_;
  QPushButton* apply_;
  FiguresTable* table_;
  QLabel* notes_;
  NoiseChart* chart_;
  FileReading reading_{this};
};

}  // namespace palpate::gui
