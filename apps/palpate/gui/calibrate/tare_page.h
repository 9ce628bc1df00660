// The page Tare of the dock Calibrate: the readings of each matrix's taxels without contact, and
// the time windows that they were found in. The tare is kept as an event of the recording; the
// recorded values are not changed.
#pragma once

#include <memory>

#include <palpate/calibration/tare.h>
#include <palpate/recording/recording_event.h>

#include "gui/widgets/computed_page.h"

class QLabel;
class QPushButton;

namespace palpate::gui {

class FiguresTable;

// The event that stores a tare; `profile` must have frames.
RecordingEvent tareEvent(const Tare& tare, const Profile& profile);

class TarePage : public ComputedPage {
  Q_OBJECT
 public:
  explicit TarePage(QWidget* parent = nullptr);
  void setTheme(Theme theme) override;
  std::vector<ExportedTable> tables() const override;
  void paint(QPainter& painter, const PictureLook& look, const QString& title) override;

  // Sets whether the recording now has a tare as an event.
  void setKept(bool kept);
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

 private:
  void take(const std::shared_ptr<const Tare>& found);
  void showState();

  std::shared_ptr<const Tare> found_;
  bool kept_ = false;
  Theme theme_ = Theme::kDark;
  QLabel* state_;
  QPushButton* keep_;
  QPushButton* remove_;
  FiguresTable* table_;
  QLabel* notes_;
};

}  // namespace palpate::gui
