// The dock Slip: a lamp for every matrix, how the contact of the chosen one lies and moves, and its
// motion over time; of a recording, computed beside the window, or live.
#pragma once

#include <QSettings>
#include <list>
#include <memory>
#include <optional>
#include <set>
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
  void setTheme(Theme theme) override;
  void setPosition(double seconds) override;
  std::vector<ExportedTable> tables() const override;
  void paint(QPainter& painter, const PictureLook& look, const QString& title) override;
  void setVisibleRange(double fromS, double toS);
  void setMap(ColorMapName map);

  // Of the recording, or all that came live; null: nothing was computed.
  const SlipSeries* found() const noexcept;
  // Frame of found() that is shown.
  std::size_t frame() const noexcept { return frame_; }
  std::size_t chosen() const noexcept { return chosen_; }
  void choose(std::size_t matrix);
  SlipControls& controls() noexcept { return *controls_; }
  SlipView& drawing() noexcept { return *drawing_; }
  SlipChart& chart() noexcept { return *chart_; }
  // The frame that is shown becomes the reference; of what is live, the newest one.
  void setReference();

  // What is connected: its newest verdicts, with the frame they are of.
  void setLiveHand(const HandDescription& hand);
  // Of the same hand other taxels are scanned: what came stays.
  void renewLiveHand(const HandDescription& hand);
  void showLive(const TactileFrame& frame, const std::vector<SlipDetection>& detections);

 signals:
  void foundChanged();  // also when there is nothing any more
  void frameChanged();  // another one is shown
  void seekRequested(double seconds);
  void liveOptionsChanged();
  void liveReferenceAsked();

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
  void showChosen();
  void showFrame();
  void showRows();
  void showScene();
  void showNotes(const SlipSample* sample);
  void changed();
  QString nameOfMatrix(std::size_t matrix) const;
  const HandDescription* hand() const;
  const SlipSample* sampleNow(std::size_t matrix) const;

  Theme theme_ = Theme::kDark;
  std::list<Kept> kept_;  // newest first: of recordings and options that were looked at
  Found found_;
  std::optional<HandDescription> liveHand_;
  SlipSeries liveSeries_;
  std::optional<SlipSegmenter> liveSlips_;
  TactileFrame values_;  // of the frame that is shown
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
