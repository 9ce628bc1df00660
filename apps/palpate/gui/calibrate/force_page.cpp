#include "gui/calibrate/force_page.h"

#include <QFileInfo>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>

#include <palpate/core/error.h>
#include <palpate/core/number_text.h>

#include "gui/appearance/captions.h"
#include "gui/calibrate/calibration_facts.h"
#include "gui/calibrate/force_chart.h"
#include "gui/desktop/ask.h"
#include "gui/widgets/figures_table.h"
#include "gui/widgets/make.h"
#include "gui/widgets/notes_label.h"
#include "gui/widgets/number_field.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {
namespace {

constexpr double kQuantile = 1.96;  // normal quantile for 95 %

std::vector<FigureColumn> forcePageColumns() {
  return {{"matrix", {}, 16, true},
          {"taxels", "Active taxels", 6},
          {"K", "Gain used: the filtered mean, creep corrected [counts]", 8},
          {"kPa", "Pressure of the contact; below: 95 % interval", 8},
          {"N", "Force; below: 95 % interval", 8},
          {"", "Why the value may be wrong", 18, true}};
}

constexpr int kPressureColumn = 3;  // of forcePageColumns()

QString plusMinus(double sd) { return "± " + figure(kQuantile * sd, 2); }

std::vector<FigureCell> forcePageRowOf(const QString& name,
                                       const MatrixForce& force,
                                       bool areaKnown,
                                       const ShownUnit& pressure) {
  if (force.active == 0)
    return {{.text = name}, {.text = "0"}, {.text = "–"}, {.text = "–"}, {.text = "0"}, {}};
  QStringList flags;
  if (!force.inRange) flags.append("outside range");
  if (!areaKnown) flags.append("upper limit: area of the indenter unknown");
  if (force.saturated) flags.append("saturated: the real value is higher");
  if (!force.temperatureKnown) flags.append("temperature assumed");
  if (force.compensated) flags.append("creep corrected");
  if (force.startUnknown) flags.append("the load began before the first frame");
  return {{.text = name},
          {.text = QString::number(force.active)},
          {.text = figure(static_cast<double>(force.staticResponseCounts), 1)},
          {.text = pressure.number(static_cast<double>(force.kpa), 2),
           .detail = "± " + figure(pressure.conversion.ofDifference(
                                       kQuantile * static_cast<double>(force.sdKpa)),
                                   2 + pressure.conversion.moreDecimals)},
          {.text = (areaKnown ? "" : "≤ ") + figure(static_cast<double>(force.forceN), 2),
           .detail = plusMinus(static_cast<double>(force.sdForceN))},
          {.text = flags.value(0),
           .detail = flags.mid(1).join(", "),
           .tip = flags.join("\n"),
           .warning = !force.inRange || force.saturated || !areaKnown}};
}

// The same columns as `palpate calibrate apply` prints, with times in seconds.
TextTable forceTable(const std::shared_ptr<const ForceSeries>& found) {
  return {.header = {"frame",
                     "time_s",
                     "matrix",
                     "active",
                     "K [counts]",
                     "pressure_kpa",
                     "pressure_sd_kpa",
                     "force_n",
                     "force_sd_n",
                     "in_range",
                     "temperature_known",
                     "saturated"},
          .numRows = found->rows.size(),
          .row = [found](std::size_t row) {
            const std::size_t frame = row / found->numMatrices;
            const MatrixForce& force = found->rows[row];
            std::vector<std::string> cells = {std::to_string(frame),
                                              numberText(found->timeS[frame]),
                                              std::to_string(row % found->numMatrices),
                                              std::to_string(force.active)};
            for (const float value : {force.staticResponseCounts, force.kpa, force.sdKpa})
              cells.push_back(numberText(value));
            for (const float value : {force.forceN, force.sdForceN})
              cells.push_back(found->areaKnown ? numberText(value) : std::string());
            for (const bool flag : {force.inRange, force.temperatureKnown, force.saturated})
              cells.emplace_back(flag ? "1" : "0");
            return cells;
          }};
}

}  // namespace

ForcePage::ForcePage(QSettings& settings, Ask& ask, QWidget* parent)
    : ComputedPage("force", parent),
      settings_(settings),
      ask_(ask),
      pressure_(shownUnit(PressureUnit{})) {
  makeTop();
  auto* content = new QWidget(this);
  chart_ = new ForceChart(content);
  table_ = named(new FiguresTable(forcePageColumns(), content), "forceTable", {}, "Forces");
  notes_ = notesLabel("forceNotes", content);
  // Above what is computed under these assumptions, where no small dock hides them.
  notes_->setProperty("role", QVariant());
  content->setLayout(inColumn({notes_, {table_, 3}, {chart_, 2}}, Space::kNone));
  setContent(content);
  connect(table_, &FiguresTable::rowChosen, this, &ForcePage::showChosen);
  connect(chart_, &ForceChart::seekRequested, this, &ForcePage::seekRequested);
  showCalibration();
}

void ForcePage::makeTop() {
  name_ = makeLabel(this, "forceCalibration");
  name_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  drop_ = makeButton(this, "forceDrop", "Don't apply", "Show counts only");
  choose_ = makeButton(this, "forceChoose", "Choose…", "A calibration saved on the page Pressure");
  const auto field = [&](const char* name, const QString& label, double least, double most) {
    auto* made = named(new SecondsField(this),
                       name,
                       label + " used for this recording; a .dsa doesn't store it",
                       label);
    made->setRange(least, most);
    made->setFocusPolicy(Qt::StrongFocus);
    fitToText(*made, [made] {
      made->setFixedWidth(made->fontMetrics().horizontalAdvance("00000.00") + 18);
    });
    return made;
  };
  sensitivity_ =
      field("forceSensitivity", "Sensitivity", SensorSettings::kSensitivity.minimum, 1.0);
  threshold_ = field("forceThreshold", "Threshold in counts", 0.0, 0.0);  // showCalibration()
  threshold_->setDecimals(0);
  keep_ =
      makeButton(this, "forceKeep", "Keep", "Add these settings to the recording (undo: Ctrl+Z)");
  assumed_ = makeLabel(this, "forceAssumed", {}, "assumed");
  assumed_->setToolTip("Neither the recording nor the device says these settings");
  recordedWith_ = makeBox(inRow({"Recorded with sensitivity",
                                 sensitivity_,
                                 "threshold",
                                 threshold_,
                                 assumed_,
                                 keep_,
                                 Stretch{}}),
                          this);
  top().addLayout(inRow({{name_, 1}, drop_, choose_}));
  top().addWidget(recordedWith_);
  connect(choose_, &QPushButton::clicked, this, &ForcePage::chooseCalibration);
  connect(drop_, &QPushButton::clicked, this, [this] { applyThis({}); });
  connect(keep_, &QPushButton::clicked, this, [this] {
    emit keepRequested(sensitivity_->value(), threshold_->value());
  });
  for (QDoubleSpinBox* each : {sensitivity_, threshold_})
    connect(each, &QDoubleSpinBox::valueChanged, this, [this] {
      said_ = SensorSettings{sensitivity_->value(), threshold_->value(), true};
      renew();
    });
}

const HandDescription* ForcePage::hand() const {
  if (live()) return liveHand_ ? &*liveHand_ : nullptr;
  return recording() ? &recording()->profile.hand() : nullptr;
}

std::string ForcePage::handName() const { return hand() ? hand()->name : std::string(); }

QString ForcePage::rowName(std::size_t row) const {
  return row < hand()->layout->numMatrices() ? QString::fromStdString(hand()->matrixName(row))
                                             : QString("whole hand");
}

void ForcePage::chooseCalibration() {
  const QString path = ask_.file("Apply a calibration", {}, "Calibrations (*.json);;All files (*)");
  if (!path.isEmpty() && hand()) applyThis(path);
}

void ForcePage::applyThis(const QString& path) {
  applyCalibration(settings_, handName(), path);
  calibrationChanged();
  emit applied();
}

void ForcePage::setLiveHand(const HandDescription& hand) {
  liveHand_ = hand;
  calibrationChanged();
}

void ForcePage::calibrationChanged() {
  found_.reset();
  shownForces_.reset();
  showCalibration();
  renew();
}

void ForcePage::setKept(const KeptWithRecording& kept) {
  if (kept == kept_) return;
  kept_ = kept;
  if (kept.settings) said_.reset();
  renew();
}

void ForcePage::forget() {
  found_.reset();
  shownForces_.reset();
  said_.reset();
  kept_ = {};
  showCalibration();
}

void ForcePage::showCalibration() {
  const QString path = hand() ? appliedCalibration(settings_, handName()) : QString();
  name_->setText(path.isEmpty() ? "no calibration" : QFileInfo(path).fileName());
  name_->setToolTip(path);
  drop_->setVisible(!path.isEmpty());
  choose_->setEnabled(hand() != nullptr);
  // A live hand's controller reports its settings. Without a calibration the fields have no values.
  recordedWith_->setVisible(!live() && !path.isEmpty());
  const QSignalBlocker blocker(threshold_);
  if (hand()) threshold_->setMaximum(static_cast<double>(hand()->maximumCounts));
  chart_->setVisible(!live());
}

QString ForcePage::emptyReason() const {
  if (QString why = ComputedPage::emptyReason(); !why.isEmpty() && !live()) return why;
  if (live() && !liveHand_) return "Waiting for the hand.";
  if (const QString why = notCalibratable(*hand()); !why.isEmpty()) return why;
  if (appliedCalibration(settings_, handName()).isEmpty())
    return "No calibration is applied to this hand.\n\nMake one on the page "
           "Pressure, or choose a saved one.";
  return live() ? QString() : kept_.problem;
}

void ForcePage::compute() {
  // showLive() shows live values.
  if (live()) return;
  const OpenedRecordingPtr of = recording();
  const QString path = appliedCalibration(settings_, handName());
  run("forces", [this, of, path, typed = said_, kept = kept_](const Progress& progress) -> Take {
    const Calibration calibration = usableCalibration(path);
    const PressureMapOptions options = pressureOptions(kept, typed);
    auto found = std::make_shared<const ForceSeries>(
        forceSeries(of->profile, calibration, options, kept.tare, progress));
    // Those of a calibration may have been read from its device; that this recording has the same
    // is an assumption.
    SensorSettings own = options.settings.empty()
                             ? calibration.settings
                             : options.settings[calibration.matrix % options.settings.size()];
    own.assumed = own.assumed || options.settings.empty();
    return [this, found, own] { take(found, own); };
  });
}

void ForcePage::take(const std::shared_ptr<const ForceSeries>& found, const SensorSettings& own) {
  found_ = found;
  {
    const QSignalBlocker first(sensitivity_), second(threshold_);
    sensitivity_->setValue(own.sensitivity);
    threshold_->setValue(own.thresholdCounts);
  }
  assumed_->setVisible(own.assumed);
  chart_->setSeries(found);
  showFrame();
  QString notes = linesOf(found->assumptions);
  if (found->beyond > 0)
    notes.prepend(QString::number(found->beyond) + " of " + QString::number(found->contacts) +
                  " contacts are outside the measured range (amber): don't rely on them\n");
  notes_->setText(notes);
  const QSignalBlocker blocker(table_);
  table_->selectRow(static_cast<int>(found->numMatrices));
  showChosen(static_cast<int>(found->numMatrices));
  table_->scrollToTop();
  showContent();
}

void ForcePage::showChosen(int row) {
  if (live()) return;
  const auto chosen = static_cast<std::size_t>(row);
  chart_->choose(chosen, rowName(chosen));
}

void ForcePage::setPosition(double seconds) {
  positionS_ = seconds;
  chart_->setPosition(seconds);
  if (shown()) showFrame();
}

void ForcePage::showFrame() {
  if (live() || !found_ || found_->timeS.empty()) return;
  const std::size_t frame = found_->frameAt(positionS_);
  std::vector<MatrixForce> forces;
  for (std::size_t m = 0; m < found_->numMatrices; ++m) forces.push_back(found_->at(frame, m));
  showForces(
      {std::move(forces), found_->forceN(frame), found_->sdForceN(frame), found_->areaKnown});
}

void ForcePage::showLive(const PressureFrame& pressure,
                         const std::vector<std::string>& assumptions) {
  if (!live() || !liveHand_ || !isVisible() || pressure.matrices.empty()) return;
  std::vector<MatrixForce> forces;
  for (const MatrixPressure& matrix : pressure.matrices) forces.push_back(matrixForce(matrix));
  showForces({std::move(forces), pressure.forceN, pressure.sdForceN, pressure.areaKnown});
  const QString notes = linesOf(assumptions);
  if (notes_->text() != notes) notes_->setText(notes);
  if (!shown()) showContent();
}

void ForcePage::showForces(const Shown& now) {
  shownForces_ = now;
  const auto& [forces, sumN, sdN, areaKnown] = *shownForces_;
  std::vector<std::vector<FigureCell>> rows;
  int active = 0;
  bool inRange = true;
  for (std::size_t m = 0; m < forces.size(); ++m) {
    rows.push_back(forcePageRowOf(rowName(m), forces[m], areaKnown, pressure_));
    active += forces[m].active;
    inRange = inRange && forces[m].inRange;
  }
  rows.push_back({{.text = rowName(forces.size())},
                  {.text = QString::number(active)},
                  {},
                  {},
                  {.text = (areaKnown || active == 0 ? "" : "≤ ") + figure(sumN, 2),
                   .detail = active > 0 ? plusMinus(sdN) : QString()},
                  {.text = inRange ? "" : "outside range", .warning = !inRange}});
  table_->setRows(rows);
}

void ForcePage::setUnits(const DisplayUnits& units) {
  pressure_ = shownUnit(units.pressure);
  table_->horizontalHeaderItem(kPressureColumn)->setText(pressure_.symbol);
  if (shownForces_ && hand() && shownForces_->forces.size() == hand()->layout->numMatrices())
    showForces(Shown(*shownForces_));
}

std::vector<ExportedTable> ForcePage::tables() const {
  if (!shown() || !found_) return {};
  return {{"forces", [found = found_] { return forceTable(found); }},
          {"assumptions of the forces", [found = found_] {
             return TextTable{.header = {"assumption"},
                              .numRows = found->assumptions.size(),
                              .row = [found](std::size_t row) {
                                return std::vector<std::string>{found->assumptions[row]};
                              }};
           }}};
}

void ForcePage::paint(QPainter& painter, const PictureLook& look, const QString& title) {
  chart_->paint(painter, look, title);
}

}  // namespace palpate::gui
