#include "gui/calibrate/pressure_page.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QResizeEvent>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QStackedWidget>

#include <palpate/control/grasp_request.h>
#include <palpate/core/error.h>
#include <palpate/core/number_text.h>

#include "gui/appearance/captions.h"
#include "gui/calibrate/calibration_facts.h"
#include "gui/calibrate/pressure_chart.h"
#include "gui/calibrate/surface_chart.h"
#include "gui/desktop/ask.h"
#include "gui/widgets/facts_view.h"
#include "gui/widgets/figures_table.h"
#include "gui/widgets/fitting_pages.h"
#include "gui/widgets/make.h"
#include "gui/widgets/notes_label.h"
#include "gui/widgets/number_field.h"
#include "gui/widgets/text_fit.h"
#include "gui/widgets/wrapping_row.h"

namespace palpate::gui {
namespace {

constexpr int kPressurePageWideFrom = 980;  // [px]; wider: chart and figures side by side

std::vector<FigureColumn> pressurePageColumns() {
  return {{"recording", {}, 15, true},
          {"kPa", "Applied pressure", 7},
          {"K", "Gain of the step [counts]", 8},
          {"m", "Drift [counts/s]", 8},
          {"°C", "Temperature used by the model", 7},
          {"off by", "Pressure of the surface minus applied pressure [kPa]", 8},
          {"", "Why it isn't used", 14, true}};
}

std::vector<FigureCell> pressurePageRowOf(const PressureSample& sample,
                                          const PressureModel& model) {
  const QString name = QString::fromStdString(std::filesystem::path(sample.file).filename());
  const double degC = temperatureOf(sample, model.options);
  const bool known = (model.options.study ? sample.studyDegC : sample.nearestDegC).has_value();
  const bool measured = sample.used || sample.staticResponseCounts > 0.0;
  const auto value = [&](double of, int decimals) {
    return measured ? figure(of, decimals) : QString("–");
  };
  QString off = "–";
  if (model.valid() && measured)
    off = figure(model.gain.at(sample.staticResponseCounts, degC).value - sample.pressureKpa, 2);
  return {
      {.text = name, .tip = QString::fromStdString(sample.file + "\n" + sample.sha256)},
      {.text = figure(sample.pressureKpa, 2)},
      {.text = value(sample.staticResponseCounts, 1)},
      {.text = value(sample.driftCountsPerS, 2)},
      {.text = known ? figure(degC, 1) : QString("–"),
       .tip = known ? QString() : "not recorded: " + figure(degC, 0) + " °C assumed"},
      {.text = off},
      {.text = sample.used            ? QString()
               : sample.notes.empty() ? "left out"
                                      : "left out: " + QString::fromStdString(sample.notes.back()),
       .tip = linesOf(sample.notes),
       .warning = !sample.used}};
}

}  // namespace

PressurePage::PressurePage(Ask& ask, QWidget* parent)
    : ComputedPage("pressure", parent), ask_(ask) {
  makeTop();
  auto* content = new QWidget(this);
  charts_ = new FittingPages(content);
  chart_ = new PressureChart(charts_);
  surface_ = new SurfaceChart(charts_);
  charts_->addWidget(chart_);
  charts_->addWidget(surface_);
  connect(above_, &QCheckBox::toggled, charts_, [this](bool above) {
    charts_->setCurrentIndex(above ? 1 : 0);
  });
  auto* figures = new QWidget(content);
  samples_ =
      named(new FiguresTable(pressurePageColumns(), figures), "pressureSamples", {}, "Samples");
  samples_->setSingleLine();
  facts_ = named(new FactsView(figures), "pressureFacts");
  auto* framed = makeBox(inColumn({facts_, Stretch{}}, kPageEdges), figures);
  auto* scroll = new QScrollArea(figures);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setWidget(framed);
  figures->setLayout(inColumn({{samples_, 3}, {scroll, 4}}, Space::kNone));
  halves_ = new QBoxLayout(QBoxLayout::TopToBottom, content);
  halves_->setContentsMargins(0, 0, 0, 0);
  halves_->setSpacing(0);
  halves_->addWidget(charts_, 1);
  halves_->addWidget(figures, 1);
  setContent(content);
  connect(samples_, &FiguresTable::rowChosen, this, [this](int row) {
    chart_->choose(static_cast<std::size_t>(row));
    surface_->choose(static_cast<std::size_t>(row));
  });
  showOptions();
}

void PressurePage::makeTop() {
  auto* files = new WrappingRow(this);
  auto* openIt = makeButton(this,
                            "pressureOpen",
                            "Open…",
                            "A table (file,pressure_kpa[,temperature_c]) of recordings, or a "
                            "calibration that was saved");
  name_ = makeLabel(this, "pressureName");
  name_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  save_ = makeButton(this, "pressureSave", "Save…", "Save as JSON, with the data it was made from");
  apply_ = makePrimary(this,
                       "pressureApply",
                       "Apply to this hand",
                       "Use this calibration for pressures and forces of this hand type");
  files->add(openIt);
  files->add(save_);
  files->add(apply_);
  auto* options = new WrappingRow(this);
  study_ = named(new QCheckBox("As in the study", this), "pressureStudy");
  study_->setToolTip(
      "All terms, and the study's temperatures; off: only terms that cross-validation keeps");
  options->add(study_);
  robust_ = named(new QCheckBox("Robust", this),
                  "pressureRobust",
                  "Outliers within a step count less (Huber's loss)");
  options->add(robust_);
  matrix_ = named(new QComboBox(this), "pressureMatrix", "The matrix that was loaded", "Matrix");
  matrix_->addItem("loaded matrix");
  options->add(matrix_);
  above_ = named(new QCheckBox("From above", this), "pressureAbove");
  above_->setToolTip(
      "The surface over gain and temperature, pressure as colour; off: slices of it");
  options->add(above_);
  auto* measured = new WrappingRow(this);
  const auto field = [&](const char* name, const QString& label, const QString& tip, double most) {
    auto* made = named(new SecondsField(this), name, tip, label);
    made->setRange(0.0, most);
    made->setFocusPolicy(Qt::StrongFocus);
    fitToText(*made, [made] {
      made->setFixedWidth(made->fontMetrics().horizontalAdvance("00000.00") + 18);
    });
    auto* both = new QWidget(measured);
    auto* words = new QLabel(label, both);
    words->setToolTip(tip);
    both->setLayout(inRow({words, made}));
    measured->add(both);
    return made;
  };
  area_ = field("pressureArea",
                "Indenter in mm²",
                "Area of the indenter; forces are then those on this area. 0: not known",
                PressureModelOptions::kIndenterAreaMm2.maximum);
  sensitivity_ = field(
      "pressureSensitivity", "Sensitivity", "Used for the recordings, which don't store it", 1.0);
  sensitivity_->setMinimum(SensorSettings::kSensitivity.minimum);
  sensitivity_->setValue(SensorSettings{}.sensitivity);
  threshold_ = field("pressureThreshold",
                     "Threshold",
                     "Used for the recordings, which don't store it [counts]",
                     static_cast<double>(movableHand().maximumCounts));
  threshold_->setDecimals(0);
  threshold_->setValue(SensorSettings{}.thresholdCounts);
  setHand(movableHand());
  top().addWidget(files);
  top().addWidget(name_);
  top().addWidget(options);
  top().addWidget(measured);
  connect(openIt, &QPushButton::clicked, this, [this] {
    const QString path = ask_.file("Open a table of recordings and pressures, or a calibration",
                                   {},
                                   "Tables and calibrations (*.csv *.json);;All files (*)");
    if (!path.isEmpty()) open(path.toStdString());
  });
  connect(save_, &QPushButton::clicked, this, &PressurePage::saveAs);
  connect(apply_, &QPushButton::clicked, this, &PressurePage::apply);
  for (QCheckBox* each : {study_, robust_})
    connect(each, &QCheckBox::toggled, this, &PressurePage::renew);
  connect(matrix_, &QComboBox::activated, this, &PressurePage::renew);
  for (QDoubleSpinBox* each : {area_, sensitivity_, threshold_})
    connect(each, &QDoubleSpinBox::valueChanged, this, &PressurePage::renew);
}

void PressurePage::setHand(const HandDescription& hand) {
  const int chosen = matrix_->currentIndex();
  while (matrix_->count() > 1) matrix_->removeItem(1);
  for (const MatrixDescription& matrix : hand.matrices)
    matrix_->addItem(QString::fromStdString(matrix.shortName));
  matrix_->setCurrentIndex(chosen < matrix_->count() ? chosen : 0);
  const QSignalBlocker quiet(threshold_);
  threshold_->setMaximum(static_cast<double>(hand.maximumCounts));
}

CalibrationChoices PressurePage::choices() const {
  CalibrationChoices choices;
  choices.model.study = study_->isChecked();
  choices.model.indenterAreaMm2 = area_->value();
  choices.settings = {sensitivity_->value(), threshold_->value(), true};
  choices.robust = robust_->isChecked();
  if (matrix_->currentIndex() > 0)
    choices.matrix = static_cast<std::size_t>(matrix_->currentIndex() - 1);
  return choices;
}

void PressurePage::open(const std::filesystem::path& path) {
  path_ = path;
  now_.reset();
  renew();
  showOptions();
}

QString PressurePage::emptyReason() const {
  if (!path_.empty()) return {};
  return "Open a table of recordings that were made under known pressures (columns file, "
         "pressure_kpa and, if known, temperature_c), or a calibration that was saved.";
}

void PressurePage::compute() {
  saved_.clear();
  if (path_.extension() == ".json") {
    run("the calibration", [this, path = path_](const Progress&) -> Take {
      const ShownCalibrationPtr read = calibrationFromFile(path);
      return [this, read] {
        saved_ = read->source;
        take(read);
      };
    });
    return;
  }
  run("the calibration",
      [this, path = path_, known = now_, choices = choices()](const Progress& progress) -> Take {
        auto shown = calibrationFromTable(path, choices, known, progress);
        return [this, shown] { take(shown); };
      });
}

void PressurePage::take(const ShownCalibrationPtr& shown) {
  now_ = shown;
  const Calibration& calibration = shown->calibration;
  std::vector<std::vector<FigureCell>> rows;
  for (const PressureSample& sample : calibration.samples)
    rows.push_back(pressurePageRowOf(sample, calibration.pressure));
  samples_->setRows(rows);
  samples_->clearSelection();
  chart_->setModel(calibration.pressure, calibration.samples);
  surface_->setModel(calibration.pressure, calibration.samples);
  facts_->setFacts(calibrationFacts(calibration));
  showOptions();
  showContent();
}

void PressurePage::showOptions() {
  const bool there = now_ != nullptr;
  const bool fromTable = !there || now_->gathered;
  name_->setVisible(!path_.empty());
  name_->setText(QString::fromStdString(path_.filename().string()));
  name_->setToolTip(QString::fromStdString(path_.string()));
  save_->setEnabled(there);
  apply_->setEnabled(there && now_->calibration.pressure.valid());
  for (QWidget* option :
       std::initializer_list<QWidget*>{study_, robust_, matrix_, area_, sensitivity_, threshold_})
    option->setEnabled(fromTable);
  if (fromTable) return;
  const Calibration& read = now_->calibration;
  const QSignalBlocker study(study_), area(area_), first(sensitivity_), second(threshold_);
  study_->setChecked(read.pressure.options.study);
  area_->setValue(read.pressure.options.indenterAreaMm2);
  sensitivity_->setValue(read.settings.sensitivity);
  threshold_->setValue(read.settings.thresholdCounts);
}

void PressurePage::save(const std::filesystem::path& path) {
  // The dialog has asked before it replaces a file.
  saveCalibration(now_->calibration, path, Overwrite::kReplace);
  saved_ = path;
}

void PressurePage::saveAs() {
  const std::filesystem::path path =
      ask_.newFile(
              "Save the calibration",
              QString::fromStdString((now_->source.parent_path() / now_->source.stem()).string()) +
                  ".json",
              "Calibrations (*.json)",
              ".json")
          .toStdString();
  if (path.empty()) return;
  try {
    save(path);
    emit said("saved " + QString::fromStdString(path.filename().string()));
  } catch (const Error& error) {
    emit said(error.what());
  }
}

// An applied calibration must be on disk, because the program reads it again at the next start.
void PressurePage::apply() {
  if (saved_.empty()) saveAs();
  if (!saved_.empty()) emit applyRequested(QString::fromStdString(saved_.string()));
}

QStringList PressurePage::facts() const {
  QStringList lines;
  for (const Fact& fact : facts_->facts()) lines.append(fact.name + ": " + fact.value);
  return lines;
}

std::vector<ExportedTable> PressurePage::tables() const {
  if (!shown()) return {};
  return {{"samples", [now = now_] { return sampleTable(now); }},
          {"calibration", [facts = facts_->facts()] { return factTable(facts); }}};
}

void PressurePage::paint(QPainter& painter, const PictureLook& look, const QString&) {
  if (above_->isChecked())
    surface_->paint(painter, look, name_->text());
  else
    chart_->paint(painter, look, name_->text());
}

void PressurePage::resizeEvent(QResizeEvent* event) {
  ComputedPage::resizeEvent(event);
  halves_->setDirection(event->size().width() >= kPressurePageWideFrom ? QBoxLayout::LeftToRight
                                                                       : QBoxLayout::TopToBottom);
}

}  // namespace palpate::gui
