// Holds what the user has selected in the displayed source: taxels, a span of time, the visible
// part of the recording, the plotted rows. Views show the selection and change it here; each is
// notified of the changes of the others.
#pragma once

#include <QObject>
#include <optional>
#include <vector>

#include <palpate/model/taxel_selection.h>
#include <palpate/model/timing.h>

namespace palpate::gui {

class Selection : public QObject {
  Q_OBJECT
 public:
  explicit Selection(QObject* parent = nullptr) : QObject(parent) {}

  const TaxelSelection& taxels() const noexcept { return taxels_; }
  void setTaxels(const TaxelSelection& taxels);
  void clearTaxels();

  // The selected span of the displayed recording; nothing: no span is selected.
  const std::optional<TimeSpan>& span() const noexcept { return span_; }
  // The ends may come in any order; they are clamped to the recording.
  void setSpan(std::optional<TimeSpan> span);

  // The span that the timeline shows. It may differ from the requested one by a margin, or because
  // it is limited to the recording.
  const TimeSpan& visibleSpan() const noexcept { return visibleSpan_; }
  // Called by the timeline, with the span that it shows.
  void setVisibleSpan(const TimeSpan& span);
  void show(const TimeSpan& span) { emit visibleSpanRequested(span); }
  void showWithMargin(const TimeSpan& span) { emit spanRequested(span); }
  void showAll() { emit fullRangeRequested(); }
  void zoomAbout(double seconds, double factor) { emit zoomRequested(seconds, factor); }

  // Which rows are plotted: one row per matrix, the whole hand last.
  const std::vector<bool>& plotted() const noexcept { return plotted_; }
  void setPlotted(const std::vector<bool>& plotted);

  // Shortest visible span [s], even for a single frame.
  static constexpr double kShortestS = 0.05;
  // Starts anew for another recording of this duration [s]: no span is selected, all of it is
  // visible. 0: there is no recording.
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
