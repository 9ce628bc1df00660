#include "gui/calibrate/step_page.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QResizeEvent>
#include <QSignalBlocker>
#include <algorithm>
#include <array>
#include <cmath>

#include <palpate/calibration/calibration_samples.h>
#include <palpate/core/number_text.h>

#include "gui/appearance/captions.h"
#include "gui/calibrate/calibration_facts.h"
#include "gui/calibrate/step_chart.h"
#include "gui/widgets/figures_table.h"
#include "gui/widgets/make.h"
#include "gui/widgets/notes_label.h"

namespace palpate::gui {
namespace {

constexpr double kMatrixShare = 0.3;     // part of the work: finding the loaded matrix
constexpr int kStepPageWideFrom = 1240;  // [px]; wider: table and chart side by side
constexpr double kLarge = 1000.0;

std::vector<FigureColumn> stepPageColumns() {
  return {
      {"begin [s]", "Time of loading, from the first frame; below: frames of the step", 8},
      {"K [counts]",
       "Gain: what the signal reaches without the drift; below: half width of the 95 % interval",
       8},
      {"m [counts/s]", "Drift afterwards", 10},
      {"T1 [s]", "The slower time constant", 7},
      {"T2 [s]", "The faster time constant", 7},
      {"d", "Damping, from T1 and T2; below: T", 7},
      {"RMSE", "Root of the mean square of the residuals [counts]; below: the temperature", 8},
      {"", "Why the fit may be wrong", 16, true}};
}

// Writes `value` with as many decimals as its interval justifies.
QString stepPagePlain(double value, double interval) {
  if (!std::isfinite(value)) return "–";
  const double size =
      std::isfinite(interval) && interval > 0.0 ? interval : std::abs(value) / kLarge;
  const int decimals =
      size > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(size))), 0, 4) : 1;
  return figure(value, decimals);
}

FigureCell withInterval(double value, double interval) {
  FigureCell cell{.text = stepPagePlain(value, interval)};
  cell.detail =
      std::isfinite(interval) ? "± " + stepPagePlain(interval, interval) : QString("not known");
  return cell;
}

// The warnings of a step, a few words each.
QStringList flagsOf(const FittedStep& step) {
  QStringList flags;
  if (!step.fit.converged && !step.fit.gainUndetermined) flags.append("no fit");
  if (step.fit.converged && !step.fit.steadyStateReached) flags.append("cut off");
  if (step.saturatedFrames > 0) flags.append("saturated");
  if (!step.step.beginSeen) flags.append("start not recorded");
  if (step.fit.gainUndetermined) flags.append("K unknown");
  if (step.fit.identifiable && !step.fit.timesIdentifiable) flags.append("T2 unknown");
  if (step.step.flickerFrames > 0) flags.append("flickers");
  return flags;
}

QString notesOf(const FittedStep& step) { return linesOf(step.notes, step.fit.notes); }

std::vector<FigureCell> stepPageRowOf(const FittedStep& step, const StepSignal& signal) {
  const StepFit& fit = step.fit;
  const StepParameters& p = fit.parameters;
  const FigureCell none{.text = "–"};
  std::vector<FigureCell> row;
  const double begin = signal.timeS[step.step.begin], end = signal.timeS[step.step.end];
  row.push_back({.text = figure(begin, 2),
                 .detail = "to " + figure(end, 2),
                 .tip = "frames " + QString::number(step.step.begin) + " to " +
                        QString::number(step.step.end)});
  if (fit.converged) {
    row.push_back(withInterval(p.staticResponseCounts, fit.interval95(0)));
    row.push_back(withInterval(p.driftCountsPerS, fit.interval95(1)));
    row.push_back(withInterval(p.t1S(), fit.interval95(2)));
    row.push_back(withInterval(p.t2S(), fit.interval95(3)));
    row.push_back(
        {.text = figure(p.damping, 2), .detail = "T " + figure(p.timeConstantS, 3) + " s"});
    row.push_back({.text = figure(fit.rmse, 2),
                   .detail = step.nearestDegC ? figure(*step.nearestDegC, 1) + " °C" : QString()});
  } else {
    row.insert(row.end(), 6, none);
  }
  const QString notes = notesOf(step);
  row.push_back({.text = step.usable() ? "usable" : "not usable",
                 .detail = flagsOf(step).join(", "),
                 .tip = notes,
                 .warning = !step.usable()});
  return row;
}

TextTable stepTable(const std::shared_ptr<const FoundSteps>& found) {
  return {.header = {"step",          "begin_frame",  "end_frame",
                     "begin_s",       "end_s",        "K [counts]",
                     "K_95",          "m [counts/s]", "m_95",
                     "T1 [s]",        "T1_95",        "T2 [s]",
                     "T2_95",         "T [s]",        "d",
                     "rmse [counts]", "degC",         "saturated_frames",
                     "converged",     "identifiable", "gain_reached",
                     "usable",        "notes"},
          .numRows = found->report.steps.size(),
          .row = [found](std::size_t index) {
            const FittedStep& step = found->report.steps[index];
            const StepFit& fit = step.fit;
            const StepParameters& p = fit.parameters;
            std::vector<std::string> cells = {std::to_string(index),
                                              std::to_string(step.step.begin),
                                              std::to_string(step.step.end),
                                              numberText(found->signal.timeS[step.step.begin]),
                                              numberText(found->signal.timeS[step.step.end])};
            const std::array values = {p.staticResponseCounts, p.driftCountsPerS, p.t1S(), p.t2S()};
            const auto number = [](double value) {
              return std::isfinite(value) ? numberText(value) : std::string();
            };
            for (int i = 0; i < 4; ++i)
              for (const double value : {values[static_cast<std::size_t>(i)], fit.interval95(i)})
                cells.push_back(fit.converged ? number(value) : std::string());
            for (const double value : {p.timeConstantS, p.damping, fit.rmse})
              cells.push_back(fit.converged ? number(value) : std::string());
            cells.push_back(step.nearestDegC ? numberText(*step.nearestDegC) : std::string());
            cells.push_back(std::to_string(step.saturatedFrames));
            for (const bool flag :
                 {fit.converged, fit.identifiable, fit.steadyStateReached, step.usable()})
              cells.emplace_back(flag ? "1" : "0");
            cells.push_back(notesOf(step).replace('\n', "; ").toStdString());
            return cells;
          }};
}

TextTable sampleTable(const std::shared_ptr<const FoundSteps>& found, std::size_t index) {
  const FittedStep step = found->report.steps[index];
  const auto samples = std::make_shared<const StepSignal>(samplesOf(found->signal, step.step));
  return {.header = {"time_s", "signal", "fit", "residual"},
          .numRows = samples->timeS.size(),
          .row = [samples, step](std::size_t row) {
            const double t = samples->timeS[row], value = samples->values[row];
            std::vector<std::string> cells = {numberText(t), numberText(value), "", ""};
            if (!step.fit.converged) return cells;
            const double fitted = stepResponse(step.fit.parameters, t);
            cells[2] = numberText(fitted);
            cells[3] = numberText(value - fitted);
            return cells;
          }};
}

}  // namespace

StepPage::StepPage(QWidget* parent) : ComputedPage("steps", parent) {
  matrices_ = named(new QComboBox(this), "stepMatrix", "The matrix that was loaded", "Matrix");
  matrices_->setEnabled(false);
  signal_ = named(new QComboBox(this),
                  "stepSignal",
                  "Signal of the matrix; a calibration uses the filtered mean",
                  "Signal");
  for (const PlottedSignal each : kAllSignalKinds) signal_->addItem(nameOf(each));
  signal_->setCurrentText(nameOf(PlottedSignal::kFilteredMean));
  robust_ = named(
      new QCheckBox("Robust", this), "stepRobust", "Gives outliers less weight (Huber's loss)");
  top().addLayout(inRow({matrices_, signal_, robust_, Stretch{}}));

  auto* content = new QWidget(this);
  auto* left = new QWidget(content);
  table_ = named(new FiguresTable(stepPageColumns(), left), "stepTable", {}, "Steps");
  notes_ = notesLabel("stepNotes", left);
  left->setLayout(inColumn({{table_, 1}, notes_}, Space::kNone));
  chart_ = new StepChart(content);
  halves_ = new QBoxLayout(QBoxLayout::TopToBottom, content);
  halves_->setContentsMargins(0, 0, 0, 0);
  halves_->setSpacing(0);
  halves_->addWidget(left, 2);
  halves_->addWidget(chart_, 3);
  setContent(content);

  connect(matrices_, &QComboBox::activated, this, [this](int index) {
    matrix_ = static_cast<std::size_t>(index);
    renew();
  });
  connect(signal_, &QComboBox::activated, this, &StepPage::renew);
  connect(robust_, &QCheckBox::toggled, this, &StepPage::renew);
  connect(table_, &FiguresTable::rowChosen, this, [this](int chosenRow) {
    const auto step = static_cast<std::size_t>(chosenRow);
    showStep(step);
    const LoadingStep& span = found_->report.steps[step].step;
    emit spanChosen(found_->signal.timeS[span.begin], found_->signal.timeS[span.end]);
  });
  connect(chart_, &StepChart::seekRequested, this, &StepPage::seekRequested);
}

void StepPage::forget() {
  found_.reset();
  matrix_.reset();
  matrices_->clear();
  matrices_->setEnabled(recording() != nullptr);  // a connected hand has no steps
  emit foundChanged();
  if (!recording()) return;
  for (std::size_t m = 0; m < recording()->numMatrices(); ++m) matrices_->addItem(matrixName(m));
}

QString StepPage::matrixName(std::size_t matrix) const {
  return QString::fromStdString(recording()->profile.hand().matrixName(matrix));
}

void StepPage::compute() {
  const OpenedRecordingPtr of = recording();
  StepReportOptions options;
  options.steps.signal = plottedSignalFrom(signal_->currentText());
  if (robust_->isChecked()) options.fit.loss = StepLoss::kHuber;
  run("loading steps", [this, of, options, matrix = matrix_](const Progress& progress) -> Take {
    auto found = std::make_shared<FoundSteps>();
    const double before = matrix ? 0.0 : kMatrixShare;
    const Progress looking = [&](double done) { return progress(before * done); };
    const std::size_t which = matrix ? *matrix : loadedMatrix(of->profile, looking);
    found->signal = stepSignal(of->profile, which, options.steps.signal, [&](double done) {
      return progress(before + (1.0 - before) * done);
    });
    found->report = reportSteps(of->profile, which, found->signal, options);
    return [this, found] { take(found); };
  });
}

void StepPage::take(const std::shared_ptr<const FoundSteps>& found) {
  found_ = found;
  const StepReport& report = found->report;
  matrix_ = report.matrix;
  matrices_->setCurrentIndex(static_cast<int>(report.matrix));
  emit foundChanged();
  if (report.steps.empty()) {
    const QString notes = linesOf(report.notes);
    return say((notes.isEmpty() ? "No loading step was found." : notes) +
               "\n\nA step is a load that is put on a matrix and stays for at least one second. "
               "You can choose another matrix above.");
  }
  std::vector<std::vector<FigureCell>> rows;
  for (const FittedStep& step : report.steps) rows.push_back(stepPageRowOf(step, found->signal));
  table_->setRows(rows);
  showContent();
  // The program selects this row, not the user, so the timeline does not move.
  const QSignalBlocker blocker(table_);
  table_->selectRow(0);
  showStep(0);
}

QString StepPage::emptyReason() const {
  const QString why = ComputedPage::emptyReason();
  return why.isEmpty() ? notCalibratable(recording()->profile.hand()) : why;
}

void StepPage::choose(std::size_t step) { table_->selectRow(static_cast<int>(step)); }

std::optional<std::size_t> StepPage::chosen() const {
  const int row = found_ ? table_->chosenRow() : -1;
  return row < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(row));
}

void StepPage::showStep(std::size_t index) {
  const FittedStep& step = found_->report.steps.at(index);
  chart_->setStep(step,
                  samplesOf(found_->signal, step.step),
                  found_->signal.timeS[step.step.begin],
                  found_->report.matrix,
                  found_->report.signal);
  QStringList lines;
  const StepCharacteristics& shape = step.characteristics;
  if (step.fit.converged && std::isfinite(shape.deadTimeS))
    lines.append("dead time " + figure(shape.deadTimeS, 3) + " s · inflection " +
                 figure(shape.inflectionS, 3) + " s · t_k " + figure(shape.tangentAtGainS, 3) +
                 " s · steady from " + figure(shape.steadyS, 2) + " s");
  for (const QString& notes : {linesOf(found_->report.notes), notesOf(step)})
    if (!notes.isEmpty()) lines.append(notes);
  notes_->setText(lines.join("\n"));
  notes_->setVisible(!lines.isEmpty());
}

QString StepPage::stepName(std::size_t step) const {
  return matrixName(found_->report.matrix) + " · step " + QString::number(step + 1) + " of " +
         QString::number(found_->report.steps.size());
}

void StepPage::setPosition(double seconds) { chart_->setPosition(seconds); }

std::vector<ExportedTable> StepPage::tables() const {
  const auto step = chosen();
  if (!shown() || !step) return {};
  return {{"steps", [found = found_] { return stepTable(found); }},
          {"chosen step", [found = found_, step] { return sampleTable(found, *step); }}};
}

void StepPage::paint(QPainter& painter, const PictureLook& look, const QString& title) {
  if (const auto step = chosen()) chart_->paint(painter, look, title, stepName(*step));
}

void StepPage::resizeEvent(QResizeEvent* event) {
  ComputedPage::resizeEvent(event);
  const bool wide = event->size().width() >= kStepPageWideFrom;
  halves_->setDirection(wide ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
  halves_->setStretch(0, wide ? 1 : 2);
  halves_->setStretch(1, wide ? 1 : 3);
}

}  // namespace palpate::gui
