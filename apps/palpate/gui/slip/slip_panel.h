// The content of the dock Slip: a status symbol for every matrix, shape and motion of the contact
// of the chosen matrix, and its motion over time; of a recording (computed in a worker thread) or
// live.
#pragma once

#include <QSettings>
#include <list>
#include <memory>
#include <optional>
#include <vector>

#include "gui/appearance/color_map.h"
#include "gui/slip/slip_view.h"
#include "gui/widgets/computed_page.h"

class QLabel;

namespace palpate::gui {

class FiguresTable;
class SlipChart;
class SlipControls;

class SlipPanel : public ComputedPage {
  Q_OBJECT
 public:
  explicit SlipPanel(QSettings& settings, QWidget* parent = nullptr);
  void setPosition(double seconds) override;
  std::vector<ExportedTable> tables() const override;
  void paint(QPainter& painter, const PictureLook& look, const QString& title) override;
  void setVisibleRange(double fromS, double toS);
  void setMap(ColorMapName map);

  // The slip of the recording, or all live results so far; null when nothing was computed.
  const SlipSeries* found() const noexcept;
  // The shown frame of found().
  std::size_t frame() const noexcept { return frame_; }
  std::size_t chosen() const noexcept { return chosen_; }
  void choose(std::size_t matrix);
  SlipControls& controls() noexcept { return *controls_; }
  SlipView& drawing() noexcept { return *drawing_; }
  SlipChart& chart() noexcept { return *chart_; }
  // Makes the shown frame the reference; for a live source the newest frame.
  void setReference();

  // Shows a connected hand; showLive() then adds its newest results and the frame that they belong
  // to.
  void setLiveHand(const HandDescription& hand);
  // The scanned taxels of the same hand changed; the results so far are kept.
  void renewLiveHand(const HandDescription& hand);
  void showLive(const TactileFrame& frame, const std::vector<SlipDetection>& detections);

 signals:
  // Also emitted when there is no result any more.
  void foundChanged();
  // Another frame is shown.
  void frameChanged();
  void seekRequested(double seconds);
  void liveOptionsChanged();
  void liveReferenceRequested();

 protected:
  QString emptyReason() const override;
  void compute() override;
  void forget() override;

 private:
  using Found = std::shared_ptr<const SlipSeries>;
  struct Kept {
    std::weak_ptr<const OpenedRecording> of;
    SlipSeriesOptions asked;
    Found found;
  };
  void take(const Found& found);
  void chooseBest();
  // Chooses the matrix that slips now; else the one with the strongest contact.
  void chooseBestNow(const std::vector<SlipDetection>& detections);
  void showChosen();
  void showFrame();
  void showRows();
  void showScene();
  void showAllRows();
  void showNotes(const SlipSample* sample);
  void changed();
  QString nameOfMatrix(std::size_t matrix) const;
  const HandDescription* hand() const;
  const SlipSample* sampleNow(std::size_t matrix) const;

  // Results of recent recordings and options, newest first.
  std::list<Kept> kept_;
  Found found_;
  std::optional<HandDescription> liveHand_;
  SlipSeries liveSeries_;
  std::optional<SlipSegmenter> liveSlips_;
  // Of the shown frame.
  TactileFrame values_;
  double positionS_ = 0.0;
  std::size_t frame_ = 0;
  std::size_t chosen_ = 0;
  bool chosenByUser_ = false;
  SlipControls* controls_;
  FiguresTable* list_;
  SlipView* drawing_;
  SlipChart* chart_;
  QLabel* notes_;
};

}  // namespace palpate::gui
