#include "gui/spectrum/spectrum_chart.h"

#include <QMouseEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "gui/appearance/captions.h"
#include "gui/chart/chart_picture.h"
#include "gui/chart/chart_style.h"

namespace palpate::gui {
namespace {

constexpr double kRangeDb = 60.0;  // range of the colours below the strongest value
constexpr double kStepDb = 5.0;    // the upper end is a multiple of this
constexpr double kSpectrumChartHeadroom = 1.06;
constexpr double kSignalShare = 0.55;         // height of the signal relative to the spectrogram
constexpr int kSpectrumChartCursorWidth = 4;  // [px] with its edges
constexpr int kSpectrumChartBarWidth = 12;    // [px] of the colours
// [s]; longer time spans are labelled in other units, as in the timeline.
constexpr double kSpectrumChartLongestInS = 1200.0;
constexpr int kLowBelow = 230;  // [px]; lower: no room for names of axes

QCPColorGradient gradientOf(ColorMapName map) {
  QCPColorGradient gradient;
  QMap<double, QColor> stops;
  const ColorTable& table = colorTable(map);
  constexpr std::size_t kStep = 5;  // 255 = 51 * 5
  for (std::size_t i = 0; i < table.size(); i += kStep)
    stops.insert(static_cast<double>(i) / 255.0, QColor(table[i]));
  gradient.setColorStops(stops);
  gradient.setNanHandling(QCPColorGradient::nhTransparent);
  return gradient;
}

double topDb(const Spectrogram& spectrogram) {
  return std::ceil(decibels(spectrogram.largestPsd, -kRangeDb) / kStepDb) * kStepDb;
}

double spectrumChartCellOf(const SpectrogramPart& part,
                           std::size_t index,
                           SpectrumScale scale,
                           double floorDb) {
  return scale == SpectrumScale::kMagnitude
             ? static_cast<double>(part.magnitude[index])
             : decibels(static_cast<double>(part.psd[index]), floorDb);
}

}  // namespace

QString nameOf(SpectrumScale scale) {
  return scale == SpectrumScale::kMagnitude ? "magnitude" : "PSD in dB";
}

std::vector<QString> spectrumNotes(const SpectrumReport& report, const SpectrumOptions& options) {
  const QString nyquist = "Nyquist " + figure(report.nyquistHz, 1) + " Hz";
  const QString jitter = "intervals vary by " + figure(report.jitter * 100.0, 0) + " %";
  const QString grid = "resampled to " + figure(report.rateHz, 1) + " Hz";
  const QString what = nyquist + "; " + jitter + ": " + grid;
  const double lengthS = options.window / report.rateHz;
  QString rest = "window " + figure(lengthS, 2) + " s, bins " +
                 figure(report.rateHz / options.window, 2) + " Hz apart";
  const auto asked = static_cast<std::size_t>(options.window - options.overlap);
  // The requested hop needs no note.
  if (report.hop > asked) {
    rest += ", a segment every " + QString::number(report.hop) + " samples";
    return {what + " · " + rest,
            what + " · a segment every " + QString::number(report.hop) + " samples",
            what,
            nyquist + "; " + grid,
            nyquist};
  }
  return {what + " · " + rest, what, nyquist + "; " + grid, nyquist};
}

SpectrumChart::SpectrumChart(QWidget* parent) : Chart(parent) {
  setObjectName("spectrumChart");
  setAccessibleName("Signal and its spectra");
  axisRect()->setMinimumMargins(QMargins(timeAxisLeft(*this), 8, 8, 4));
  addGraph();
  spectra_ = addBelow(1.0);
  plotLayout()->setRowStretchFactor(0, kSignalShare);
  time_ = spectra_->axis(QCPAxis::atBottom);
  frequency_ = spectra_->axis(QCPAxis::atLeft);
  frequency_->setLabel("frequency in Hz");
  colors_ = new QCPColorScale(this);
  plotLayout()->addElement(1, 1, colors_);
  colors_->setType(QCPAxis::atRight);
  colors_->setBarWidth(kSpectrumChartBarWidth);
  plotLayout()->setColumnStretchFactor(1, 0.001);
  auto* heights = new QCPMarginGroup(this);
  spectra_->setMarginGroup(QCP::msTop | QCP::msBottom, heights);
  colors_->setMarginGroup(QCP::msTop | QCP::msBottom, heights);
  note_ = new QCPItemText(this);
  note_->setObjectName("spectrumNote");
  note_->position->setType(QCPItemPosition::ptAxisRectRatio);
  note_->position->setAxisRect(spectra_);
  note_->position->setCoords(0.0, 0.0);
  note_->setPositionAlignment(Qt::AlignLeft | Qt::AlignBottom);
  note_->setClipToAxisRect(false);
  note_->setPadding(QMargins(0, 0, 0, 3));
  addCursor(kSpectrumChartCursorWidth);
  connect(this, &QCustomPlot::afterReplot, this, [this] {
    if (isVisible()) emit rightChanged(width() - spectra_->rect().right() - 1);
  });
  restyle();
}

void SpectrumChart::setAnswer(const SpectrumAnswer& answer) {
  answer_ = answer;
  fillSignal();
  fillSpectra();
  restyle();
}

void SpectrumChart::fillSignal() {
  const Series& series = *answer_.series;
  QVector<QCPGraphData> samples;
  samples.reserve(static_cast<qsizetype>(series.timeS.size()));
  std::size_t stretch = 0;
  double low = 0.0, high = 0.0;
  const auto& stretches = answer_.spectrogram->report.stretches;
  for (std::size_t i = 0; i < series.timeS.size(); ++i) {
    // A gap breaks the line.
    if (stretch + 1 < stretches.size() && i == stretches[stretch + 1].first) {
      ++stretch;
      samples.append({series.timeS[i], std::numeric_limits<double>::quiet_NaN()});
    }
    samples.append({series.timeS[i], series.values[i]});
    low = std::min(low, series.values[i]);
    high = std::max(high, series.values[i]);
  }
  graph(0)->data()->set(samples, true);
  if (!(high > low)) high = low + 1.0;
  yAxis->setRange(low < 0.0 ? low * kSpectrumChartHeadroom : 0.0, high * kSpectrumChartHeadroom);
}

// Makes one map for each part without a gap: each has its own frame rate, and between parts there
// is nothing.
void SpectrumChart::fillSpectra() {
  for (QCPColorMap* map : maps_) removePlottable(map);
  maps_.clear();
  if (!answer_.spectrogram) return;
  const Spectrogram& all = *answer_.spectrogram;
  const double top = topDb(all), floorDb = top - kRangeDb;
  double highestHz = 0.0;
  for (const SpectrogramPart& part : all.parts) {
    auto* map = new QCPColorMap(time_, frequency_);
    map->setInterpolate(false);
    map->setTightBoundary(false);
    const auto last = static_cast<double>(part.segments - 1);
    // A single segment is as wide as its window.
    const double air = part.segments == 1 ? 0.5 / part.binHz : 0.0;
    const double rangeHz = part.binHz * static_cast<double>(all.numBins - 1);
    map->data()->setSize(static_cast<int>(part.segments), static_cast<int>(all.numBins));
    map->data()->setRange({part.firstS - air, part.firstS + last * part.stepS + air},
                          {0.0, rangeHz});
    for (std::size_t i = 0; i < part.segments; ++i)
      for (std::size_t k = 0; k < all.numBins; ++k)
        map->data()->setCell(static_cast<int>(i),
                             static_cast<int>(k),
                             spectrumChartCellOf(part, i * all.numBins + k, scale_, floorDb));
    map->setColorScale(colors_);
    maps_.push_back(map);
    const auto window = static_cast<double>(answer_.options.window);
    highestHz = std::max(highestHz, part.binHz * window / 2.0);
  }
  frequency_->setRange(0.0, highestHz);
  colors_->setGradient(gradientOf(map_));
  if (scale_ == SpectrumScale::kDecibels)
    colors_->setDataRange({floorDb, top});
  else
    colors_->setDataRange({0.0, all.largestMagnitude > 0.0 ? all.largestMagnitude : 1.0});
}

void SpectrumChart::setScale(SpectrumScale scale) {
  if (scale == scale_) return;
  scale_ = scale;
  fillSpectra();
  writeNotes();
  replot(QCustomPlot::rpQueuedReplot);
}

void SpectrumChart::setMap(ColorMapName map) {
  if (map == map_) return;
  map_ = map;
  colors_->setGradient(gradientOf(map_));
  replot(QCustomPlot::rpQueuedReplot);
}

void SpectrumChart::style() {
  const ThemeColors& colors = colorsOf();
  styleExtraAxis(*colors_->axis(), *this);
  // A signal from one matrix has the colour of that matrix.
  std::size_t matrix = 0, touched = 0;
  for (std::size_t m = 0; m < answer_.taxels.numMatrices(); ++m) {
    const Mask& mask = answer_.taxels.mask(m);
    if (std::find(mask.begin(), mask.end(), 1) == mask.end()) continue;
    matrix = m;
    ++touched;
  }
  graph(0)->setPen(curvePen(matrix, touched > 1));
  note_->setColor(colors.text);
  note_->setFont(font());
  // Edges make the cursor visible on dark colours.
  cursor().setStyleSheet("background: " + colors.accent.name() + "; border: 0 solid " +
                         colors.window.name() +
                         "; border-left-width: 1px; border-right-width: 1px");
  writeNotes();
}

// A low chart has room only for units.
void SpectrumChart::nameAxes() {
  const bool low = height() < kLowBelow;
  colors_->axis()->ticker()->setTickCount(low ? 2 : 4);
  const bool seconds = time_->range().upper <= kSpectrumChartLongestInS;
  time_->setLabel(low       ? QString()
                  : seconds ? "time from the first frame in s"
                            : "time from the first frame in h:min:s");
  yAxis->setLabel(low ? QString() : answer_.unit);
  frequency_->setLabel(low ? "Hz" : "frequency in Hz");
  const bool db = scale_ == SpectrumScale::kDecibels;
  colors_->axis()->setLabel(low  ? (db ? "dB" : answer_.unit)
                            : db ? "dB re 1 " + answer_.unit + "²/Hz"
                                 : "magnitude in " + answer_.unit);
  spectra_->setMinimumMargins(
      QMargins(timeAxisLeft(*this), fontMetrics().height() + 6, 8, low ? 22 : 10));
}

// Shows the longest notes that fit.
void SpectrumChart::writeNotes() {
  nameAxes();
  if (!answer_.spectrogram || answer_.spectrogram->report.rateHz <= 0.0) return;
  const auto notes = spectrumNotes(answer_.spectrogram->report, answer_.options);
  const int room = spectra_->rect().width() > 1 ? spectra_->rect().width() : width() - 150;
  const auto fits = std::find_if(notes.begin(), notes.end() - 1, [&](const QString& note) {
    return fontMetrics().horizontalAdvance(note) <= room;
  });
  note_->setText(*fits);
}

void SpectrumChart::setVisibleRange(double fromS, double toS) {
  Chart::setVisibleRange(fromS, toS);
  if (toS > kSpectrumChartLongestInS && !time_->ticker().dynamicCast<QCPAxisTickerTime>()) {
    const QSharedPointer<QCPAxisTickerTime> clock(new QCPAxisTickerTime);
    clock->setTimeFormat("%h:%m:%s");
    clock->setTickCount(9);
    time_->setTicker(clock);
  } else if (toS <= kSpectrumChartLongestInS && time_->ticker().dynamicCast<QCPAxisTickerTime>()) {
    time_->setTicker(QSharedPointer<QCPAxisTicker>(new QCPAxisTicker));
    time_->ticker()->setTickCount(9);
  }
  nameAxes();
}

QString SpectrumChart::readingAt(const QPointF& at) const {
  if (!answer_.spectrogram) return {};
  const double seconds = secondsAt(at.x());
  const QString time = figure(seconds, 2) + " s";
  if (spectra_->rect().contains(at.toPoint())) {
    const double hz = frequency_->pixelToCoord(at.y());
    const Spectrogram& all = *answer_.spectrogram;
    for (const SpectrogramPart& part : all.parts) {
      const auto segment = std::lround((seconds - part.firstS) / part.stepS);
      const auto bin = static_cast<std::size_t>(std::max(0L, std::lround(hz / part.binHz)));
      if (segment < 0 || segment >= static_cast<long>(part.segments) || bin >= all.numBins)
        continue;
      const std::size_t cell = static_cast<std::size_t>(segment) * all.numBins + bin;
      const double psd = static_cast<double>(part.psd[cell]);
      return time + " · " + figure(static_cast<double>(bin) * part.binHz, 2) + " Hz\nPSD " +
             (psd > 0.0 ? figure(decibels(psd, -400.0), 1) + " dB" : QString("0")) +
             "\nmagnitude " + figure(static_cast<double>(part.magnitude[cell]), 2) + " " +
             answer_.unit;
    }
    return time + "\nno whole window around this moment";
  }
  if (!axisRect()->rect().contains(at.toPoint())) return {};
  // The last sample at or before that time.
  auto found = graph(0)->data()->findEnd(seconds, false);
  if (found == graph(0)->data()->constBegin() || std::isnan((--found)->value)) return time;
  return time + "\n" + figure(found->value, 0) + " " + answer_.unit;
}

void SpectrumChart::paint(QPainter& painter,
                          const PictureLook& look,
                          const QString& title,
                          const QString& name) {
  // The colour bar is not an axis rectangle, so that paintChart() does not adapt it.
  QCPAxis& axis = *colors_->axis();
  const QColor before = axis.labelColor();
  const QFont fontBefore = axis.labelFont();
  if (look.forPrint) {
    axis.setLabelColor(inkOf(before));
    axis.setTickLabelColor(inkOf(before));
  }
  if (look.textUnits > 0) {
    QFont font = fontBefore;
    font.setPixelSize(look.textUnits);
    axis.setLabelFont(font);
    axis.setTickLabelFont(font);
  }
  paintChart(painter, look, *this, {.title = title, .legend = {{name, graph(0)->pen()}}});
  axis.setLabelColor(before);
  axis.setTickLabelColor(before);
  axis.setLabelFont(fontBefore);
  axis.setTickLabelFont(fontBefore);
}

void SpectrumChart::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) emit fitRequested();
}

void SpectrumChart::hideEvent(QHideEvent* event) {
  QCustomPlot::hideEvent(event);
  emit rightChanged(0);
}

}  // namespace palpate::gui
