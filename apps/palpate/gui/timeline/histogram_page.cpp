#include "gui/timeline/histogram_page.h"

#include <QComboBox>
#include <QLabel>
#include <QSpinBox>
#include <algorithm>

#include <palpate/core/number_text.h>

#include "gui/appearance/captions.h"
#include "gui/chart/chart_style.h"
#include "gui/chart/plot.h"
#include "gui/timeline/curve_statistics.h"
#include "gui/widgets/make.h"

namespace palpate::gui {

HistogramPage::HistogramPage(const SelectedCurves& selected, QWidget* parent) : QWidget(parent) {
  curve_ = named(new QComboBox(this), "histogramCurve", {}, "Curve of the histogram");
  for (const SelectedCurves::Curve& curve : selected.curves) {
    curve_->addItem(curve.name);
    values_.push_back(curve.values);
    units_.push_back(curve.unit);
  }
  bins_ = named(new QSpinBox(this),
                "histogramBins",
                "0: automatic, after Freedman and Diaconis",
                "Number of bins");
  bins_->setRange(0, static_cast<int>(kMaxHistogramBins));
  bins_->setSpecialValueText("automatic");
  bins_->setKeyboardTracking(false);
  words_ = makeLabel(this, "histogramWords");
  plot_ = new QCustomPlot(this);
  plot_->setMinimumSize(240, 140);
  plot_->setAccessibleName("Histogram");
  arrangeChart(*plot_);
  bars_ = new QCPBars(plot_->xAxis, plot_->yAxis);
  styleChart(*plot_);
  const ThemeColors& colors = colorsOf();
  QColor fill = colors.accent;
  fill.setAlphaF(0.5F);
  bars_->setBrush(fill);
  bars_->setPen(QPen(colors.accent));
  plot_->yAxis->setLabel("frames");
  setLayout(
      inColumn({inRow({makeTitle("C&urve", curve_), {curve_, 1}, makeTitle("&Bins", bins_), bins_}),
                {plot_, 1},
                words_},
               kPageEdges));
  connect(curve_, &QComboBox::currentIndexChanged, this, &HistogramPage::show);
  connect(bins_, &QSpinBox::valueChanged, this, &HistogramPage::show);
  show();
}

void HistogramPage::show() {
  const int at = curve_->currentIndex();
  if (at < 0) return;
  const auto index = static_cast<std::size_t>(at);
  histogram_ = histogramOf(values_[index], static_cast<std::size_t>(bins_->value()));
  QVector<double> keys, counts;
  std::size_t most = 0, all = 0;
  for (std::size_t i = 0; i < histogram_.counts.size(); ++i) {
    keys.append(histogram_.low + (static_cast<double>(i) + 0.5) * histogram_.width);
    counts.append(static_cast<double>(histogram_.counts[i]));
    most = std::max(most, histogram_.counts[i]);
    all += histogram_.counts[i];
  }
  bars_->setData(keys, counts, true);
  bars_->setWidth(histogram_.width);
  const double high =
      histogram_.low + histogram_.width * static_cast<double>(histogram_.counts.size());
  plot_->xAxis->setRange(histogram_.low, std::max(high, histogram_.low + 1e-9));
  plot_->yAxis->setRange(0.0, std::max<double>(1.0, static_cast<double>(most)) * 1.05);
  plot_->xAxis->setLabel(curve_->currentText() + " in " + units_[index]);
  QString words = numberOf(all, "value") + " in " + numberOf(histogram_.counts.size(), "bin") +
                  " of " + QString::number(histogram_.width, 'g', 4) + " " + units_[index];
  if (histogram_.notFinite > 0)
    words += "; " + numberOf(histogram_.notFinite, "frame") + " without a value";
  words_->setText(all == 0 ? "No frame of the selection has a value." : words);
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

TextTable HistogramPage::table() const {
  const std::string unit =
      curve_->currentIndex() < 0
          ? std::string()
          : units_[static_cast<std::size_t>(curve_->currentIndex())].toStdString();
  return {.header = {"from [" + unit + "]", "to [" + unit + "]", "frames"},
          .numRows = histogram_.counts.size(),
          .row = [histogram = histogram_](std::size_t row) {
            const double low = histogram.low + static_cast<double>(row) * histogram.width;
            return std::vector<std::string>{numberText(low),
                                            numberText(low + histogram.width),
                                            std::to_string(histogram.counts[row])};
          }};
}

}  // namespace palpate::gui
