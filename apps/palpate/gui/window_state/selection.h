// What is chosen of what is shown: taxels, a span of time, the part of the recording that is in
// sight, the rows that are plotted. Views show it and change it here; each hears of the others'
// changes.
#pragma once

#include <QObject>
#include <optional>
#include <vector>

#include <palpate/model/taxel_selection.h>
#include <palpate/model/time_span.h>

namespace palpate::gui {

class Selection : public QObject {
  Q_OBJECT
 public:
  explicit Selection(QObject* parent = nullptr) : QObject(parent) {}

  const TaxelSelection& taxels() const noexcept { return taxels_; }
  void setTaxels(const TaxelSelection& taxels);
  void clearTaxels();

  // Of the recording that is shown; nothing: none.
  const std::optional<TimeSpan>& span() const noexcept { return span_; }
  // In any order; clamped to the recording.
  void setSpan(std::optional<TimeSpan> span);

  // As the timeline shows it. What is asked for may be changed by it: a little air, the ends of the
  // recording.
  const TimeSpan& visibleSpan() const noexcept { return visibleSpan_; }
  void setVisibleSpan(const TimeSpan& span);  // by the timeline: so it is
  void show(const TimeSpan& span) { emit visibleSpanRequested(span); }
  void showWithMargin(const TimeSpan& span) { emit spanRequested(span); }
  void showAll() { emit fullRangeRequested(); }
  void zoomAbout(double seconds, double factor) { emit zoomRequested(seconds, factor); }

  // Which rows are plotted: a row per matrix, the whole hand last.
  const std::vector<bool>& plotted() const noexcept { return plotted_; }
  void setPlotted(const std::vector<bool>& plotted);

  // A span that is shown is no shorter [s], not even of a single frame.
  static constexpr double kShortestS = 0.05;
  // Another recording of so many seconds: no span of it is chosen, all of it is in sight. 0: there
  // is none.
  void begin(double durationS);
  double durationS() const noexcept { return durationS_; }

 signals:
  void taxelsChanged();
  void spanChanged();
  void visibleSpanChanged();
  void plottedChanged();
  void visibleSpanRequested(const palpate::TimeSpan& span);
  void spanRequested(const palpate::TimeSpan& span);
  void fullRangeRequested();
  void zoomRequested(double seconds, double factor);

 private:
  TaxelSelection taxels_;
  std::optional<TimeSpan> span_;
  TimeSpan visibleSpan_;
  std::vector<bool> plotted_;
  double durationS_ = 0.0;
};

}  // namespace palpate::gui
