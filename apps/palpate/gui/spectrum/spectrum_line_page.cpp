#include "gui/spectrum/spectrum_line_page.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include <palpate/core/number_text.h>

#include "gui/appearance/captions.h"
#include "gui/widgets/figures_table.h"
#include "gui/widgets/fitting_pages.h"

namespace palpate::gui {
namespace {

std::string lineCell(double value) {
  return std::isfinite(value) ? numberText(value) : std::string();
}

// As `palpate spectrum --welch` prints it.
TextTable meanLineTable(const SpectrumAnswer& answer) {
  const std::string unit = answer.unit.toStdString();
  return {.header = {"frequency_hz", "psd [" + unit + "^2/Hz]", "magnitude [" + unit + "]"},
          .numRows = answer.mean->mean.psd.size(),
          .row = [mean = answer.mean](std::size_t row) {
            return std::vector<std::string>{numberText(static_cast<double>(row) * mean->mean.binHz),
                                            numberText(mean->mean.psd[row]),
                                            numberText(mean->mean.magnitude[row])};
          }};
}

TextTable peakTable(const SpectrumAnswer& answer) {
  const std::string unit = answer.unit.toStdString();
  return {.header = {"frequency_hz",
                     "psd [" + unit + "^2/Hz]",
                     "amplitude [" + unit + "]",
                     "width_hz",
                     "prominence_db"},
          .numRows = answer.peaks.size(),
          .row = [peaks = answer.peaks](std::size_t row) {
            const SpectralPeak& peak = peaks[row];
            return std::vector<std::string>{numberText(peak.frequencyHz),
                                            numberText(peak.psd),
                                            numberText(peak.amplitude),
                                            numberText(peak.widthHz),
                                            numberText(peak.prominenceDb)};
          }};
}

TextTable coherenceTable(const SpectrumAnswer& answer) {
  return {.header = {"frequency_hz", "coherence", "phase_deg", "psd_a", "psd_b"},
          .numRows = answer.coherence->coherence.size(),
          .row = [found = answer.coherence](std::size_t row) {
            return std::vector<std::string>{numberText(static_cast<double>(row) * found->binHz),
                                            lineCell(found->coherence[row]),
                                            lineCell(found->phaseDeg[row]),
                                            lineCell(found->psdA[row]),
                                            lineCell(found->psdB[row])};
          }};
}

}  // namespace

SpectrumLinePage::SpectrumLinePage(QWidget* parent) : QWidget(parent) {
  chart_ = new SpectrumLineChart(this);
  otherLabel_ = new QLabel("With", this);
  other_ = new QComboBox(this);
  other_->setObjectName("coherenceWith");
  other_->setAccessibleName("The other signal");
  other_->setToolTip("The other signal: the mean of the active taxels of a matrix");
  other_->setFocusPolicy(Qt::StrongFocus);
  other_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  other_->setMinimumContentsLength(12);
  pages_ = new FittingPages(this);
  peaks_ = new FiguresTable(
      {{.name = "peak [Hz]", .tip = "frequency", .letters = 7},
       {.name = "density", .tip = "power spectral density at the top [units²/Hz]", .letters = 8},
       {.name = "amplitude", .tip = "amplitude of a tone with this peak", .letters = 8},
       {.name = "width [Hz]",
        .tip = "where the density falls to half (3 dB); a pure tone is 1.3 "
               "to 2 bins wide",
        .letters = 7}},
      this);
  peaks_->setObjectName("spectrumPeaks");
  peaks_->setAccessibleName("Peaks of the mean spectrum");
  common_ = new FiguresTable(
      {{.name = "peak [Hz]", .tip = "frequency", .letters = 7},
       {.name = "coherence", .letters = 8},
       {.name = "phase [°]", .tip = "of the other signal; negative: it is later", .letters = 7}},
      this);
  common_->setObjectName("coherencePeaks");
  common_->setAccessibleName("Common frequencies");
  none_ = new QLabel(this);
  none_->setWordWrap(true);
  none_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  none_->setProperty("role", "muted");
  for (FiguresTable* table : {peaks_, common_}) {
    table->setSingleLine();
    pages_->addWidget(table);
    connect(table, &FiguresTable::rowChosen, chart_, &SpectrumLineChart::setChosenPeak);
  }
  pages_->addWidget(none_);
  auto* with = new QHBoxLayout;
  with->setSpacing(6);
  with->addWidget(otherLabel_);
  with->addWidget(other_, 1);
  auto* side = new QVBoxLayout;
  side->setContentsMargins(0, 8, 8, 8);
  side->setSpacing(6);
  side->addLayout(with);
  side->addWidget(pages_, 1);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(4);
  row->addWidget(chart_, 3);
  row->addLayout(side, 2);
  connect(other_, &QComboBox::activated, this, &SpectrumLinePage::otherChanged);
  setChoosing(false);
}

void SpectrumLinePage::setHand(const HandDescription& hand) {
  QStringList names;
  for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m)
    names.append(QString::fromStdString(hand.matrixName(m)));
  names.append("whole hand");
  QStringList present;
  for (int i = 0; i < other_->count(); ++i) present.append(other_->itemText(i));
  if (names == present) return;
  other_->clear();
  other_->addItems(names);
  // A single matrix may feel nothing.
  other_->setCurrentIndex(other_->count() - 1);
}

SeriesChoice SpectrumLinePage::other() const {
  return {.index = static_cast<std::size_t>(std::max(0, other_->currentIndex())),
          .signal = SignalKind::kMean};
}

QString SpectrumLinePage::otherName() const { return "mean of " + other_->currentText(); }

void SpectrumLinePage::setChoosing(bool choosing) {
  otherLabel_->setVisible(choosing);
  other_->setVisible(choosing);
}

void SpectrumLinePage::setAnswer(const SpectrumAnswer& answer) {
  chart_->setAnswer(answer);
  std::vector<std::vector<FigureCell>> rows;
  const auto cell = [](double value, int digits) {
    return FigureCell{QString::number(value, 'g', digits)};
  };
  if (answer.coherence) {
    for (const CoherencePeak& peak : coherencePeaks(*answer.coherence))
      rows.push_back(
          {{figure(peak.frequencyHz, 2)}, {figure(peak.coherence, 3)}, {figure(peak.phaseDeg, 0)}});
    common_->setRows(rows);
  } else {
    for (const SpectralPeak& peak : answer.peaks)
      rows.push_back({{figure(peak.frequencyHz, 2)},
                      cell(peak.psd, 4),
                      cell(peak.amplitude, 4),
                      {figure(peak.widthHz, 2)}});
    peaks_->setRows(rows);
  }
  for (FiguresTable* table : {peaks_, common_}) table->clearSelection();
  const auto known = [](double value) { return std::isfinite(value); };
  const bool still =
      answer.coherence &&
      std::none_of(answer.coherence->coherence.begin(), answer.coherence->coherence.end(), known);
  none_->setText(still              ? "One of the signals doesn't change here."
                 : answer.coherence ? "No common frequency: nowhere is the coherence above that of "
                                      "independent noise."
                                    : "No peak stands 3 dB above its surroundings.");
  pages_->setCurrentWidget(rows.empty()       ? static_cast<QWidget*>(none_)
                           : answer.coherence ? common_
                                              : peaks_);
}

void SpectrumLinePage::setTheme(Theme theme) {
  chart_->setTheme(theme);
  peaks_->setTheme(theme);
  common_->setTheme(theme);
}

std::vector<ExportedTable> SpectrumLinePage::tables() const {
  const SpectrumAnswer& answer = chart_->answer();
  if (answer.coherence) return {{"coherence", [answer] { return coherenceTable(answer); }}};
  if (!answer.mean) return {};
  return {{"mean spectrum", [answer] { return meanLineTable(answer); }},
          {"peaks", [answer] { return peakTable(answer); }}};
}

}  // namespace palpate::gui
