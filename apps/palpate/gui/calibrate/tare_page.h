// The page Tare of the dock Calibrate: what the taxels of each matrix read when nothing touches
// them, and the windows it was found in. Kept as an event of the recording; the values stay as they
// are.
#pragma once

#include <memory>

#include <palpate/calibration/tare.h>
#include <palpate/recording/recording_event.h>

#include "gui/widgets/computed_page.h"

class QLabel;
class QPushButton;

namespace palpate::gui {

class FiguresTable;

// The event of a tare of a recording that has frames.
RecordingEvent tareEvent(const Tare& tare, const Profile& profile);

class TarePage : public ComputedPage {
  Q_OBJECT
 public:
  explicit TarePage(QWidget* parent = nullptr);
  void setTheme(Theme theme) override;
  std::vector<ExportedTable> tables() const override;
  void paint(QPainter& painter, const PictureLook& look, const QString& title) override;

  // Whether a tare is kept with the recording now.
  void setKept(bool kept);
  // Null: none was computed.
  const std::shared_ptr<const Tare>& found() const noexcept { return found_; }

 signals:
  void keepRequested();  // what was found
  void removeRequested();
  void spanChosen(double fromS, double toS);  // the longest window of a matrix

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
