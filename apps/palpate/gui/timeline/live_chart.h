// The chart of a live source: chosen signals of the last seconds, rolling; gaps shaded, marks and
// grasps as lines. The wheel changes how many seconds are seen.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include <palpate/live/signal_history.h>
#include <palpate/recording/recording_event.h>

#include "gui/appearance/plotted_signal.h"
#include "gui/appearance/theme.h"
#include "gui/chart/plot.h"

namespace palpate::gui {

class LiveChart : public QCustomPlot {
  Q_OBJECT
 public:
  static constexpr double kShortestS = 2.0, kUsualS = 30.0, kMaxWindowS = 300.0;

  explicit LiveChart(QWidget* parent = nullptr);

  // Another source, with so many matrices; null: nothing. Must outlive this, or be taken away
  // before.
  void setHistory(const SignalHistory* history, std::size_t numMatrices);
  void setSignal(PlottedSignal signal);
  // Per matrix and, last, the whole hand.
  void setPlotted(const std::vector<bool>& plotted);
  void setTheme(Theme theme);
  void setWindowS(double seconds);  // clamped to 2..300
  double windowS() const noexcept { return windowS_; }
  // Held, nothing rolls, and it says so; what comes meanwhile is there afterwards.
  void setHeld(bool held);

  // Takes what is new; when nothing came for `silentS` the picture rolls on by itself.
  void refresh(double silentS);
  // A line with a name at its moment; an event of a span is shaded.
  void addEvent(const RecordingEvent& event);

  // For tests: how many samples and events are drawn.
  int numGraphs() const { return graphCount(); }
  std::size_t numEvents() const noexcept { return events_.size(); }
  double largestSeen() const noexcept { return largest_; }

  QSize sizeHint() const override { return {900, 210}; }
  QSize minimumSizeHint() const override { return {240, 110}; }

 signals:
  void windowChanged(double seconds);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  struct Shown {
    double beginS = 0.0;
    double endS = 0.0;
    bool isGap = false;
    QCPAbstractItem* shape = nullptr;
    QCPItemText* name = nullptr;
  };
  double secondsOf(std::int64_t hostUs) const;
  void rebuild();
  void append(const std::vector<SignalSample>& samples, bool areNew);
  void roll(double nowS);
  void fitHeight(double fromS);
  void nameAxis();
  void shadeGap(double beginS, double endS);
  void line(double atS, const QString& name, const QColor& color);
  void forget(double beforeS);

  const SignalHistory* history_ = nullptr;
  PlottedSignal signal_ = PlottedSignal::kMean;
  std::vector<bool> plotted_;
  std::vector<std::size_t> rows_;  // of each graph
  QSharedPointer<QCPAxisTickerFixed> secondsTicker_;
  Theme theme_ = Theme::kDark;
  double windowS_ = kUsualS;
  bool held_ = false;
  std::optional<std::int64_t> originUs_;  // stamp of the first sample: second 0
  std::int64_t newestUs_ = 0;
  double nowS_ = 0.0;
  double largest_ = 0.0;  // end of the vertical axis
  std::deque<Shown> events_;
  std::size_t lines_ = 0;  // ever drawn
};

}  // namespace palpate::gui
