#include "gui/spectrum/spectrum_line_page.h"

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QStackedWidget>
#include <algorithm>
#include <cmath>

#include <palpate/core/number_text.h>
#include <palpate/signals/signal_name.h>

#include "gui/appearance/captions.h"
#include "gui/chart/plotted_curve.h"
#include "gui/widgets/figures_table.h"
#include "gui/widgets/fitting_pages.h"
#include "gui/widgets/make.h"

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
                     unit.empty() ? "psd [1/Hz]" : "psd [" + unit + "^2/Hz]",
                     unit.empty() ? "amplitude" : "amplitude [" + unit + "]",
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

const QString kWholeHand = "whole hand";
const QString kKeepTaxels = "the taxels chosen now";

}  // namespace

SpectrumLinePage::SpectrumLinePage(QWidget* parent) : QWidget(parent) {
  chart_ = new SpectrumLineChart(this);
  otherLabel_ = new QLabel("With", this);
  other_ = named(new QComboBox(this), "coherenceWith", {}, "The other signal");
  other_->setToolTip(
      "The other signal: the mean of a matrix, a curve by a formula, taxels,\nor a typed name or "
      "formula: m1_max, m5_x2_y9, angle3, m1_sum-m3_sum");
  other_->setEditable(true);
  other_->setInsertPolicy(QComboBox::NoInsert);
  problem_ = makeLines(this, "coherenceProblem");
  problem_->hide();
  other_->setFocusPolicy(Qt::StrongFocus);
  other_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  other_->setMinimumContentsLength(12);
  pages_ = new FittingPages(this);
  peaks_ = new FiguresTable(
      {{.name = "peak [Hz]", .tip = "frequency", .letters = 7},
       {.name = "density", .tip = "power spectral density at the top [units²/Hz]", .letters = 8},
       {.name = "amplitude", .tip = "amplitude of a sine with this peak", .letters = 8},
       {.name = "width [Hz]",
        .tip = "where the density falls to half (3 dB); a sine is 1.3 "
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
  none_ = makeLines(this, {}, "muted");
  none_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  for (FiguresTable* table : {peaks_, common_}) {
    table->setSingleLine();
    pages_->addWidget(table);
    connect(table, &FiguresTable::rowChosen, chart_, &SpectrumLineChart::setChosenPeak);
  }
  pages_->addWidget(none_);
  auto* side = inColumn({inRow({otherLabel_, {other_, 1}}), problem_, {pages_, 1}},
                        {.top = Space::kUsual, .right = Space::kUsual, .bottom = Space::kUsual});
  setLayout(inRow({{chart_, 3}, {side, 2}}, Space::kNarrow));
  connect(other_, &QComboBox::activated, this, &SpectrumLinePage::choose);
  connect(other_->lineEdit(), &QLineEdit::editingFinished, this, &SpectrumLinePage::choose);
  setChoosing(false);
}

void SpectrumLinePage::setRecording(const OpenedRecordingPtr& recording) {
  recording_ = recording;
  fillOthers();
}

void SpectrumLinePage::setFormulas(const std::vector<FormulaCurve>& formulas) {
  formulas_ = formulas;
  fillOthers();
}

void SpectrumLinePage::fillOthers() {
  if (!recording_) return;
  const HandDescription& hand = recording_->profile.hand();
  QStringList names;
  for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m)
    names.append(QString::fromStdString(hand.matrixName(m)));
  names.append(kWholeHand);
  for (const FormulaCurve& each : formulas_) names.append(each.name);
  for (const SeriesDescription& series : furtherSeriesOf(recording_->profile))
    for (std::size_t column = 0; column < series.columns.size(); ++column)
      names.append(QString::fromStdString(
          palpate::nameOf(columnCurve(series, column, 0).choice, *hand.layout)));
  names.append(kKeepTaxels);
  QStringList present;
  for (int i = 0; i < other_->count(); ++i) present.append(other_->itemText(i));
  const QString before = other_->currentText();
  if (names != present) {
    other_->clear();
    other_->addItems(names);
    // A single matrix may feel nothing.
    const int again = names.indexOf(before);
    other_->setCurrentIndex(again >= 0 ? again : static_cast<int>(names.indexOf(kWholeHand)));
  }
  choose();
}

void SpectrumLinePage::choose() {
  problem_->hide();
  if (!recording_) return;
  const Profile& profile = recording_->profile;
  const SensorLayout& layout = profile.layout();
  const QString text = other_->currentText().simplified();
  const int listed = other_->findText(text, Qt::MatchFixedString | Qt::MatchCaseSensitive);
  const auto numMatrices = static_cast<int>(layout.numMatrices());
  if (listed >= 0 && listed <= numMatrices)
    return take({.index = static_cast<std::size_t>(listed), .signal = SignalKind::kMean},
                "mean of " + text);
  for (const FormulaCurve& each : formulas_)
    if (each.name == text && hasSeries(profile, each.choice())) return take(each.choice(), text);
  QString wrong;
  if (text == kKeepTaxels) {
    if (!taxels_.empty() && TaxelSelection(layout).sameSensor(taxels_)) {
      const SeriesChoice kept{.kind = SeriesChoice::Kind::kTaxels, .taxels = taxels_};
      const QString name = QString::fromStdString(palpate::nameOf(kept, layout));
      const QString shown =
          name.isEmpty() ? QString::number(taxels_.count()) + " kept taxels" : name;
      other_->setEditText(shown);
      return take(kept, shown);
    }
    wrong = "Choose taxels in the matrices first.";
  } else if (text == chosenName_) {
    return;
  } else if (const auto named = signalNamed(text.toStdString(), profile);
             named && hasSeries(profile, *named)) {
    return take(*named, text);
  } else {
    wrong = problemOf(text, &profile);
    if (wrong.isEmpty())
      return take({.kind = SeriesChoice::Kind::kFormula, .formula = text.toStdString()}, text);
  }
  problem_->setText(wrong);
  problem_->show();
}

void SpectrumLinePage::take(const SeriesChoice& choice, const QString& name) {
  chosenName_ = name;
  if (choice == chosen_) return;
  chosen_ = choice;
  emit otherChanged();
}

QString SpectrumLinePage::problem() const {
  return problem_->isHidden() ? QString() : problem_->text();
}

void SpectrumLinePage::setChoosing(bool choosing) {
  otherLabel_->setVisible(choosing);
  other_->setVisible(choosing);
  if (!choosing) problem_->hide();
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
  none_->setText(
      still ? "One of the signals doesn't change here."
      : answer.coherence
          ? "No common frequency: the coherence is nowhere above that of independent noise."
          : "No peak is 3 dB above its surroundings.");
  pages_->setCurrentWidget(rows.empty()       ? static_cast<QWidget*>(none_)
                           : answer.coherence ? common_
                                              : peaks_);
}

std::vector<ExportedTable> SpectrumLinePage::tables() const {
  const SpectrumAnswer& answer = chart_->answer();
  if (answer.coherence) return {{"coherence", [answer] { return coherenceTable(answer); }}};
  if (!answer.mean) return {};
  return {{"mean spectrum", [answer] { return meanLineTable(answer); }},
          {"peaks", [answer] { return peakTable(answer); }}};
}

}  // namespace palpate::gui
