#include "gui/spectrum/spectrum_line_chart.h"

#include <algorithm>
#include <cmath>

#include "gui/appearance/captions.h"
#include "gui/chart/chart_picture.h"
#include "gui/chart/chart_style.h"

namespace palpate::gui {
namespace {

constexpr double kLineRangeDb = 100.0;  // range below the largest value
constexpr double kLineHeadroom = 1.08;
constexpr int kPeakSize = 7;        // [px]
constexpr int kLowLineChart = 190;  // [px]; lower: no room for names of axes

}  // namespace

SpectrumLineChart::SpectrumLineChart(QWidget* parent) : Chart(parent) {
  setObjectName("spectrumLineChart");
  setAccessibleName("Mean spectrum or coherence");
  axisRect()->setMinimumMargins(QMargins(timeAxisLeft(*this), fontMetrics().height() + 8, 12, 8));
  addGraph();
  peaks_ = addGraph();
  chosenPeak_ = addGraph();
  level_ = addGraph();
  for (QCPGraph* graph : {peaks_, chosenPeak_}) graph->setLineStyle(QCPGraph::lsNone);
  note_ = new QCPItemText(this);
  note_->setObjectName("spectrumLineNote");
  note_->position->setType(QCPItemPosition::ptAxisRectRatio);
  note_->position->setCoords(0.0, 0.0);
  note_->setPositionAlignment(Qt::AlignLeft | Qt::AlignBottom);
  note_->setClipToAxisRect(false);
  note_->setPadding(QMargins(0, 0, 0, 3));
  restyle();
}

double SpectrumLineChart::binHz() const {
  if (answer_.coherence) return answer_.coherence->binHz;
  return answer_.mean ? answer_.mean->mean.binHz : 0.0;
}

std::size_t SpectrumLineChart::numBins() const {
  if (answer_.coherence) return answer_.coherence->coherence.size();
  return answer_.mean ? answer_.mean->mean.psd.size() : 0;
}

double SpectrumLineChart::valueOf(std::size_t bin) const {
  if (answer_.coherence) return answer_.coherence->coherence[bin];
  const MeanSpectrum& mean = answer_.mean->mean;
  if (scale_ == SpectrumScale::kMagnitude) return mean.magnitude[bin];
  const double largest = *std::max_element(mean.psd.begin(), mean.psd.end());
  const double top = largest > 0.0 ? decibels(largest, -400.0) : 0.0;
  return decibels(mean.psd[bin], top - kLineRangeDb);
}

std::vector<std::size_t> SpectrumLineChart::peakBins() const {
  std::vector<std::size_t> bins;
  if (answer_.coherence)
    for (const CoherencePeak& peak : coherencePeaks(*answer_.coherence)) bins.push_back(peak.bin);
  else
    for (const SpectralPeak& peak : answer_.peaks) bins.push_back(peak.bin);
  return bins;
}

void SpectrumLineChart::setAnswer(const SpectrumAnswer& answer) {
  answer_ = answer;
  chosen_ = -1;
  fill();
  restyle();
}

void SpectrumLineChart::fill() {
  QVector<double> frequencies, values;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t k = 0; k < numBins(); ++k) {
    frequencies.append(static_cast<double>(k) * binHz());
    values.append(valueOf(k));
    if (!std::isfinite(values.back())) continue;
    // The bin at 0 Hz holds what is left of the load at rest: it doesn't decide the range.
    if (k == 0 && numBins() > 2) continue;
    low = std::min(low, values.back());
    high = std::max(high, values.back());
  }
  graph(0)->setData(frequencies, values, true);
  const std::vector<std::size_t> bins = peakBins();
  for (QCPGraph* each : {peaks_, chosenPeak_}) each->data()->clear();
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const double hz = static_cast<double>(bins[i]) * binHz(), value = valueOf(bins[i]);
    peaks_->addData(hz, value);
    if (static_cast<int>(i) == chosen_) chosenPeak_->addData(hz, value);
  }
  const double endHz = frequencies.isEmpty() ? 1.0 : frequencies.back();
  xAxis->setRange(0.0, endHz);
  level_->data()->clear();
  if (answer_.coherence) {
    const double level = answer_.coherence->level95();
    level_->addData(0.0, level);
    level_->addData(endHz, level);
    yAxis->setRange(0.0, 1.0);
  } else if (scale_ == SpectrumScale::kMagnitude) {
    yAxis->setRange(0.0, high > 0.0 ? high * kLineHeadroom : 1.0);
  } else if (high >= low) {
    const double air = std::max(1.0, (high - low) * (kLineHeadroom - 1.0));
    yAxis->setRange(low - air, high + air);
  }
}

void SpectrumLineChart::setScale(SpectrumScale scale) {
  if (scale == scale_) return;
  scale_ = scale;
  if (numBins() == 0) return;
  fill();
  restyle();
}

void SpectrumLineChart::setChosenPeak(int index) {
  if (index == chosen_) return;
  chosen_ = index;
  fill();
  replot(QCustomPlot::rpQueuedReplot);
}

void SpectrumLineChart::style() {
  const ThemeColors& colors = colorsOf();
  graph(0)->setPen(QPen(colors.accent, 1.4));
  peaks_->setScatterStyle(
      QCPScatterStyle(QCPScatterStyle::ssCircle, QPen(colors.text, 1.2), Qt::NoBrush, kPeakSize));
  chosenPeak_->setScatterStyle(
      QCPScatterStyle(QCPScatterStyle::ssDisc, QPen(colors.text), colors.text, kPeakSize + 1));
  QPen dashed(colors.muted, 1.0, Qt::DashLine);
  level_->setPen(dashed);
  note_->setColor(colors.text);
  note_->setFont(font());
  writeNote();
}

void SpectrumLineChart::writeNote() {
  const bool low = height() < kLowLineChart;
  xAxis->setLabel(low ? QString() : "frequency in Hz");
  QString name = "coherence";
  if (!answer_.coherence)
    name = scale_ == SpectrumScale::kMagnitude ? "magnitude in " + answer_.unit
                                               : "dB re 1 " + answer_.unit + "²/Hz";
  yAxis->setLabel(low ? QString() : name);
  std::vector<QString> notes = {QString()};
  if (answer_.coherence && !answer_.coherence->coherence.empty()) {
    const Coherence& found = *answer_.coherence;
    const QString segments = numberOf(found.segments, "segment") + " of " +
                             figure(answer_.options.window / found.report.rateHz, 2) + " s";
    const QString level =
        "independent noise: below " + figure(found.level95(), 2) + " in 95 % of the bins";
    notes = {level + " · " + segments, level, segments};
  } else if (answer_.mean && !answer_.mean->mean.psd.empty()) {
    const QString segments = (answer_.mean->mean.segments > 1 ? "mean of " : "") +
                             numberOf(answer_.mean->mean.segments, "segment") + " of " +
                             figure(answer_.options.window / answer_.mean->report.rateHz, 2) + " s";
    notes = {segments + " · " + spectrumNotes(answer_.mean->report, answer_.options)[1], segments};
  }
  const int room = std::max(axisRect()->rect().width(), 1);
  const auto fits = std::find_if(notes.begin(), notes.end() - 1, [&](const QString& note) {
    return fontMetrics().horizontalAdvance(note) <= room;
  });
  note_->setText(*fits);
}

QString SpectrumLineChart::readingAt(const QPointF& at) const {
  if (numBins() == 0 || !axisRect()->rect().contains(at.toPoint())) return {};
  const double place = std::round(xAxis->pixelToCoord(at.x()) / binHz());
  const auto bin =
      static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(numBins() - 1)));
  const QString hz = figure(static_cast<double>(bin) * binHz(), 2) + " Hz\n";
  if (answer_.coherence) {
    const double value = answer_.coherence->coherence[bin];
    if (std::isnan(value)) return hz + "one of the signals has no power here";
    return hz + "coherence " + figure(value, 3) + "\nphase " +
           figure(answer_.coherence->phaseDeg[bin], 0) + "°";
  }
  const double psd = answer_.mean->mean.psd[bin];
  return hz + "PSD " + (psd > 0.0 ? figure(decibels(psd, -400.0), 1) + " dB" : QString("0")) +
         "\nmagnitude " + figure(answer_.mean->mean.magnitude[bin], 2) + " " + answer_.unit;
}

void SpectrumLineChart::paint(QPainter& painter,
                              const PictureLook& look,
                              const QString& title,
                              const QString& name) {
  paintChart(painter, look, *this, {.title = title, .legend = {{name, graph(0)->pen()}}});
}

}  // namespace palpate::gui
