#include "gui/window_state/selection.h"

#include <algorithm>

namespace palpate::gui {

void Selection::setTaxels(const TaxelSelection& taxels) {
  if (taxels == taxels_) return;
  taxels_ = taxels;
  emit taxelsChanged();
}

void Selection::clearTaxels() {
  TaxelSelection none = taxels_;
  none.clear();
  setTaxels(none);
}

void Selection::setSpan(std::optional<TimeSpan> span) {
  if (span && durationS_ <= 0.0) span.reset();
  if (span) {
    const auto [low, high] = std::minmax(span->fromS, span->toS);
    span = TimeSpan{std::clamp(low, 0.0, durationS_), std::clamp(high, 0.0, durationS_)};
  }
  if (span == span_) return;
  span_ = span;
  emit spanChanged();
}

void Selection::setVisibleSpan(const TimeSpan& span) {
  if (span == visibleSpan_) return;
  visibleSpan_ = span;
  emit visibleSpanChanged();
}

void Selection::setPlotted(const std::vector<bool>& plotted) {
  if (plotted == plotted_) return;
  plotted_ = plotted;
  emit plottedChanged();
}

void Selection::begin(double durationS) {
  durationS_ = durationS;
  visibleSpan_ = {0.0, durationS};
  setSpan(std::nullopt);
}

}  // namespace palpate::gui
