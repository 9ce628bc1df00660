// The chart of a live source: shows the chosen signals of the last seconds and scrolls with time;
// gaps are shaded, marks and grasps are lines. The mouse wheel changes the visible duration.
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

  // Sets the signals of another source with so many matrices and this unit; null: none. `history`
  // must outlive this object, or be replaced before it is destroyed.
  void setHistory(const SignalHistory* history,
                  std::size_t numMatrices,
                  const QString& handUnit = "counts");
  void setSignal(PlottedSignal signal);
  // One entry per matrix and, last, one for the whole hand.
  void setPlotted(const std::vector<bool>& plotted);
  void setTheme(Theme theme);
  // Visible duration [s], clamped to 2..300.
  void setWindowS(double seconds);
  double windowS() const noexcept { return windowS_; }
  // While held, the chart doesn't scroll and shows that it is held; data that arrive meanwhile are
  // drawn afterwards.
  void setHeld(bool held);

  // Takes new samples. `silentS`: time since the last frame [s]; after 0.4 s without a frame the
  // chart scrolls by itself.
  void refresh(double silentS);
  // Draws a line with a name at the time of the event; an event with a duration is shaded.
  void addEvent(const RecordingEvent& event);

  // For tests: number of graphs and of events that are drawn.
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
  void arrangeNames();
  void fitHeight(double fromS);
  void nameAxis();
  void shadeGap(double beginS, double endS);
  void line(double atS, const QString& name, const QColor& color);
  void forget(double beforeS);

  const SignalHistory* history_ = nullptr;
  QString handUnit_ = "counts";
  PlottedSignal signal_ = PlottedSignal::kMean;
  std::vector<bool> plotted_;
  // Row of each graph: a matrix, or the whole hand.
  std::vector<std::size_t> rows_;
  QSharedPointer<QCPAxisTickerFixed> secondsTicker_;
  Theme theme_ = Theme::kDark;
  double windowS_ = kUsualS;
  bool held_ = false;
  // Time stamp of the first sample [us], which is second 0.
  std::optional<std::int64_t> originUs_;
  std::int64_t newestUs_ = 0;
  double nowS_ = 0.0;
  // Upper end of the vertical axis.
  double largest_ = 0.0;
  std::deque<Shown> events_;
  // Number of lines drawn since the start.
  // Scale and height for which the names are arranged; 0: they aren't.
  double arrangedFor_ = 0.0;
};

}  // namespace palpate::gui
