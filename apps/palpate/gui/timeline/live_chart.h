// The chart of a live source: shows the chosen curves of the last seconds and scrolls with time;
// gaps are shaded, recordings have a bar, marks and motions are lines. It can be frozen and
// scrolled back through all that the history keeps while data go on arriving; two cursors measure
// differences. The wheel changes the visible duration, Shift+wheel, Shift+drag and the middle
// button scroll, a drag sets both cursors, a double click returns to the newest frame.
#pragma once

#include <QPointer>
#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <palpate/core/text_table.h>
#include <palpate/live/live_series.h>
#include <palpate/model/event.h>
#include <palpate/model/hand_description.h>
#include <palpate/signals/axis_range.h>

#include "gui/chart/chart.h"
#include "gui/chart/lanes.h"
#include "gui/chart/plotted_curve.h"
#include "gui/chart/span_overlay.h"
#include "gui/chart/unit_axes.h"

class QLabel;

namespace palpate::gui {

class LiveChart : public Chart {
  Q_OBJECT
 public:
  static constexpr double kShortestS = 2.0, kUsualS = 30.0, kMaxWindowS = 600.0;

  explicit LiveChart(QWidget* parent = nullptr);

  // Takes another source, or none (null). `history` must outlive this object, or be replaced before
  // it is destroyed; `hand` tells where values end (saturation), and the fingers.
  void setHistory(const SignalHistory* history, const HandDescription* hand = nullptr);
  // Curves without values stay empty.
  void setCurves(std::vector<PlottedCurve> curves);
  const std::vector<PlottedCurve>& curves() const noexcept { return curves_; }
  UnitAxes& axes() noexcept { return *axes_; }
  // Visible duration [s], clamped to 2..600. The newest frame, or the middle of a chart that was
  // scrolled back, stays where it is.
  void setWindowS(double seconds);
  double windowS() const noexcept { return windowS_; }
  // Curves of each finger in a lane of their own, except on a logarithmic axis.
  void setLanes(bool on);
  // While held, the chart doesn't change and shows that it is held; data that arrive meanwhile are
  // drawn afterwards.
  void setHeld(bool held);

  // Takes new samples. `silentS`: time since the last frame [s]; after 0.4 s without a frame the
  // chart scrolls by itself.
  void refresh(double silentS);
  // Draws a line with a name at the time of the event.
  void addEvent(const Event& event);
  // Marks the span of a recording by the stamps of its first and last frame [us since 1970]; while
  // it runs, the last frame is the newest one.
  void showRecording(std::int64_t firstUs, std::int64_t lastUs, bool runs);

  // Whether the chart scrolls with the newest frame; otherwise it is frozen, at the newest frame or
  // further back.
  bool following() const noexcept { return following_; }
  void setFollowing(bool on);
  // Scrolls by a share of the visible duration, below 0 to earlier times. Arriving at the newest
  // frame, the chart follows it again.
  void scroll(double share);
  void showOldest();
  // Freezes the chart at this span, limited to what is kept.
  void showSpan(double fromS, double toS);
  QCPRange seen() const { return xAxis->range(); }

  // Times of the two cursors, each at a sample; nothing: it isn't set.
  using Cursors = std::array<std::optional<double>, 2>;
  const Cursors& cursors() const noexcept { return cursors_; }
  void setTimeCursor(std::size_t which, double seconds);
  // Sets a cursor at the newest frame or, in a frozen chart, where the mouse is over it, otherwise
  // at its middle.
  void setTimeCursorHere(std::size_t which);
  // Moves the cursor that was set last by so many samples.
  void moveTimeCursor(std::ptrdiff_t samples);
  void clearTimeCursors();
  // "12.30 – 15.10 s · Δt 2.80 s"; of one cursor "12.30 s"; empty: none is set.
  QString cursorWords() const;
  // Times and values at both cursors, and their differences, in base units; a row per curve.
  TextTable cursorTable() const;

  // What the tool tip says at a time: time and values; empty where nothing was measured.
  QString valuesAt(double seconds) const;

  // For tests: number of graphs, of events and gaps that are drawn, and of ends of recordings.
  int numGraphs() const { return graphCount(); }
  std::size_t numEvents() const { return events_.size() - numRecordingEnds(); }
  std::size_t numRecordingEnds() const;

  QSize sizeHint() const override { return {900, 210}; }
  QSize minimumSizeHint() const override { return {240, 110}; }

 signals:
  void windowChanged(double seconds);
  void followingChanged(bool on);
  void cursorsChanged();
  void menuRequested(const QPoint& globalPosition);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void style() override;
  void resized() override;
  void panBy(double seconds) override { scroll(seconds / seen().size()); }
  void zoomAbout(double seconds, double factor) override;
  bool event(QEvent* event) override;

 private:
  enum class Drag { kNone, kPan, kSelect, kFirst, kSecond };
  struct Shown {
    double beginS = 0.0;
    double endS = 0.0;
    bool isGap = false;
    QCPAbstractItem* shape = nullptr;
    QCPItemText* name = nullptr;
    // All of it, for the tool tip.
    QString text;
    // Whether a recording begins or ends here.
    bool endsRecording = false;
  };
  struct Recorded {
    double beginS = 0.0;
    double endS = 0.0;
    bool runs = true;
    QCPItemRect* bar = nullptr;
  };
  void rebuildGraphs();
  // For the names at the right ends of the curves.
  void makeRoomForNames();
  void follow(double nowS);
  // Shows the span and draws it.
  void showRange(double fromS, double toS);
  // Freezes the chart at the span that begins there, as long as now.
  void scrollTo(double fromS);
  void refill();
  void scaleAxes();
  // The title of the axis of time; in a low chart only the unit.
  void nameTime();
  void arrangeNames();
  void shadeNewGaps();
  // Shades from the newest frame to here while none arrives.
  void shadeSilence(double toS);
  void shadeSlip(double beginS, double endS, const QString& text);
  void line(double atS, const QString& name, const QString& text, const QColor& color);
  void forget(double beforeS);
  void placeOverlays();
  void placeWords();
  void showBehind();
  QString cursorText(int mostLines) const;
  std::optional<double> differenceAtCursors(const SeriesChoice& choice) const;
  void renewToolTip();
  Drag dragAt(const QPointF& at) const;
  void dragTo(const QPointF& at);

  LiveSeries series_;
  bool hasHistory_ = false;
  // Where the values of taxels end; nothing: not known.
  std::optional<double> saturation_;
  std::vector<PlottedCurve> curves_;
  std::unique_ptr<UnitAxes> axes_;
  bool wantsLanes_ = false;
  Lanes lanes_;
  std::optional<HandDescription> hand_;
  // The unit of time where the axis has no title.
  QPointer<QCPItemText> timeUnit_;
  std::map<QString, RollingRange> ranges_;
  QSharedPointer<QCPAxisTickerFixed> secondsTicker_;
  double windowS_ = kUsualS;
  bool held_ = false;
  bool following_ = true;
  double drawnToS_ = 0.0;  // the newest time that is drawn
  // Right end of the axis when it was drawn last.
  double nowS_ = 0.0;
  QPointer<QCPItemRect> silence_;
  // End of the last gap that is shaded.
  double shadedToS_ = 0.0;
  std::deque<Shown> events_;
  std::deque<Recorded> recordings_;
  // Scale and height for which the names are arranged; 0: they aren't.
  double arrangedFor_ = 0.0;
  SpanOverlay span_;
  Cursors cursors_;
  std::size_t lastCursor_ = 0;
  // Values at the cursors, and how far behind the newest frame the chart is.
  QLabel* readings_;
  QLabel* behind_;
  Drag drag_ = Drag::kNone;
  QPointF pressedAt_;
  double pressedS_ = 0.0;
  QCPRange panFrom_;
  // The tool tip that is shown, where it is, and for what time it was made.
  QString toolTip_;
  QPoint toolTipAt_;
};

}  // namespace palpate::gui
