// The page Tare of the dock Calibrate: the readings of each matrix's taxels without contact, and
// the time windows that they were found in, of a recording or measured now of the connected hand.
// The tare is kept as an event of the recording; the recorded values are not changed.
#pragma once

#include <memory>

#include <palpate/calibration/tare.h>
#include <palpate/model/event.h>

#include "gui/widgets/computed_page.h"

class QLabel;
class QPushButton;
class QSettings;

namespace palpate::gui {

class FiguresTable;
class MeasureRow;

// The event that stores a tare; `profile` must have frames.
Event tareEvent(const Tare& tare, const Profile& profile);
// The same for a tare that was measured live, to be added at `atUs` [us since 1970] to the
// recording that is running. It has no windows, because these are frames of the measurement.
Event liveTareEvent(Tare tare, const Profile& measured, std::int64_t atUs);

class TarePage : public ComputedPage {
  Q_OBJECT
 public:
  explicit TarePage(QSettings& settings, QWidget* parent = nullptr);
  std::vector<ExportedTable> tables() const override;
  void paint(QPainter& painter, const PictureLook& look, const QString& title) override;

  // Sets whether the recording now has a tare as an event.
  void setKept(bool kept);
  // Sets whether the connected hand is being recorded, so that a measured tare can be added.
  void setRecordingRuns(bool runs);
  // The tare was added to the recording that is running.
  void setAdded();
  MeasureRow& measureRow() noexcept { return *measure_; }
  // What the tare was computed from; null when none was computed.
  OpenedRecordingPtr foundIn() const { return found_ ? recording() : nullptr; }
  // Null when no tare was computed.
  const std::shared_ptr<const Tare>& found() const noexcept { return found_; }

 signals:
  // The tare that was found is to be kept.
  void keepRequested();
  void removeRequested();
  // The user chose a matrix: its longest window without contact [s].
  void spanChosen(double fromS, double toS);

 protected:
  void compute() override;
  void forget() override;
  QString liveReason() const override;

 private:
  void take(const std::shared_ptr<const Tare>& found);
  void showState();

  std::shared_ptr<const Tare> found_;
  bool kept_ = false;
  bool recordingRuns_ = false;
  bool added_ = false;
  MeasureRow* measure_;
  QLabel* state_;
  QPushButton* keep_;
  QPushButton* remove_;
  FiguresTable* table_;
  QLabel* notes_;
};

}  // namespace palpate::gui
