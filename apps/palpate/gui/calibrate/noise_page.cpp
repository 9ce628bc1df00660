#include "gui/calibrate/noise_page.h"

#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QStyle>
#include <algorithm>

#include <palpate/core/error.h>
#include <palpate/core/hash.h>
#include <palpate/core/number_text.h>
#include <palpate/core/output_file.h>

#include "gui/appearance/captions.h"
#include "gui/calibrate/applied_calibration.h"
#include "gui/calibrate/measure_row.h"
#include "gui/calibrate/noise_chart.h"
#include "gui/desktop/ask.h"
#include "gui/widgets/figures_table.h"
#include "gui/widgets/make.h"
#include "gui/widgets/notes_label.h"
#include "gui/widgets/number_field.h"

namespace palpate::gui {
namespace {

constexpr double kFitShare = 0.9;  // part of the work; the rest is the hash of the file
constexpr int kNoiseMeasureS = 60;
constexpr const char* kApplyTip =
    "High sensitivity (dock Hand) keeps thresholds just above these lines";

std::vector<FigureColumn> noisePageColumns() {
  return {{"matrix", {}, 15, true},
          {"slope", "[counts/°C]", 6},
          {"at 0 °C", "Intercept of the line [counts]", 6},
          {"RMSE", "RMSE as in the study [counts]; below: of this line", 9},
          {"°C", "Temperatures it was measured at", 9},
          {"threshold", "Line + 3 RMSE at the highest temperature [counts]: noise stays below", 8},
          {"frames", "With a temperature; below: those far above the line", 7},
          {"", {}, 6, true}};
}

std::vector<FigureCell> noisePageRowOf(const NoiseLine& line, const QString& name) {
  const FigureCell none{.text = "–"};
  std::vector<FigureCell> row{{.text = name}};
  if (line.valid) {
    row.push_back({.text = figure(line.slope, 3)});
    row.push_back({.text = figure(line.intercept, 2)});
    row.push_back({.text = figure(line.rmse, 3), .detail = "true " + figure(line.rmseTrue, 2)});
    row.push_back({.text = figure(line.minDegC, 1) + "–" + figure(line.maxDegC, 1)});
    row.push_back({.text = figure(line.threshold(line.maxDegC), 1)});
  } else {
    row.insert(row.end(), 5, none);
  }
  const QString notes = linesOf(line.notes);
  row.push_back({.text = QString::number(line.numFrames),
                 .detail = line.numOutliers > 0 ? QString::number(line.numOutliers) + " far above"
                                                : QString(),
                 .warning = line.numOutliers > 0});
  const QString state = !line.valid ? "missing" : !line.atRest ? "not at rest" : "notes";
  row.push_back({.text = state == "notes" && notes.isEmpty() ? QString() : state,
                 .tip = line.valid && !line.atRest ? "The matrix was not at rest (touched, or a "
                                                     "noisy taxel): this does not look like noise"
                                                   : notes,
                 .warning = !line.valid || !line.atRest});
  return row;
}

std::string given(bool valid, double value) { return valid ? numberText(value) : std::string(); }

TextTable lineTable(const std::shared_ptr<const FoundNoise>& found) {
  return {.header = {"matrix",
                     "slope [counts/degC]",
                     "intercept [counts]",
                     "rmse [counts]",
                     "rmse_true [counts]",
                     "least_degC",
                     "most_degC",
                     "frames",
                     "outliers",
                     "notes"},
          .numRows = found->floor.lines.size(),
          .row = [found](std::size_t row) {
            const NoiseLine& line = found->floor.lines[row];
            std::vector<std::string> cells = {std::to_string(line.matrix)};
            for (const double value :
                 {line.slope, line.intercept, line.rmse, line.rmseTrue, line.minDegC, line.maxDegC})
              cells.push_back(given(line.valid, value));
            cells.push_back(std::to_string(line.numFrames));
            cells.push_back(std::to_string(line.numOutliers));
            cells.push_back(linesOf(line.notes).replace('\n', "; ").toStdString());
            return cells;
          }};
}

TextTable binTable(const std::shared_ptr<const FoundNoise>& found) {
  std::vector<std::pair<std::size_t, NoiseBin>> bins;
  for (const NoiseLine& line : found->floor.lines)
    for (const NoiseBin& bin : line.bins) bins.emplace_back(line.matrix, bin);
  const std::size_t count = bins.size();
  return {.header = {"matrix", "centre_degC", "mean [counts]", "sd [counts]", "frames"},
          .numRows = count,
          .row = [bins = std::move(bins)](std::size_t row) {
            const auto& [matrix, bin] = bins[row];
            return std::vector<std::string>{std::to_string(matrix),
                                            numberText(bin.centreDegC),
                                            given(bin.count > 0, bin.mean),
                                            given(bin.count > 0, bin.sd),
                                            std::to_string(bin.count)};
          }};
}

}  // namespace

NoisePage::NoisePage(QSettings& settings, Ask& ask, QWidget* parent)
    : ComputedPage("noise", parent) {
  measure_ = new MeasureRow(settings,
                            {.part = "noise",
                             .usualSeconds = kNoiseMeasureS,
                             .needsThreshold0 = true,
                             .tip = "Noise of the connected hand at threshold 0 while it warms up"},
                            this);
  top().addWidget(measure_);
  bins_ = named(new FrameField(this),
                "noiseBins",
                "Equal bins over the temperatures; the study uses 20",
                "Bins");
  bins_->setRange(static_cast<int>(NoiseFloorOptions::kBins.minimum),
                  static_cast<int>(NoiseFloorOptions::kBins.maximum));
  bins_->setValue(static_cast<int>(NoiseFloorOptions{}.bins));
  save_ = makeButton(this, "noiseSave", "Save…", "Save as JSON, or as XML for the prior program");
  save_->setEnabled(false);
  apply_ = makePrimary(this, "noiseApply", "Apply to this hand", kApplyTip);
  apply_->setEnabled(false);
  auto* openLines = makeButton(this,
                               "noiseOpen",
                               "Apply a file…",
                               "Apply saved lines (JSON), or those of the prior program (XML)");
  top().addLayout(inRow({"Bins", bins_, Stretch{}, openLines, save_, apply_}));

  auto* content = new QWidget(this);
  chart_ = new NoiseChart(content);
  table_ = named(
      new FiguresTable(noisePageColumns(), content), "noiseTable", {}, "Noise of every matrix");
  notes_ = notesLabel("noiseNotes", content);
  content->setLayout(inColumn({{chart_, 1}, table_, notes_}, Space::kNone));
  setContent(content);

  connect(measure_, &MeasureRow::measured, this, &NoisePage::setMeasured);
  connect(measure_, &MeasureRow::said, this, &NoisePage::said);
  connect(apply_, &QPushButton::clicked, this, [this] { emit applyRequested(found_->floor); });
  connect(openLines, &QPushButton::clicked, this, [this, &ask] {
    const QString path =
        ask.file("Apply noise lines", {}, "Noise lines (*.json *.xml);;All files (*)");
    if (path.isEmpty()) return;
    reading_.start(
        [this, path]() -> FileReading::Take {
          NoiseFloor floor = noiseFromFile(path);
          if (!floor.notAtRest.empty())
            throw Error("These lines are not noise: the hand was " + floor.notAtRest + ".");
          return [this, floor = std::move(floor)] { emit applyRequested(floor); };
        },
        [this](const QString& why) { emit said(why); });
  });
  connect(bins_, &QSpinBox::valueChanged, this, &NoisePage::renew);
  connect(table_, &FiguresTable::rowChosen, this, [this](int chosen) {
    chart_->choose(static_cast<std::size_t>(chosen));
    showNotes(static_cast<std::size_t>(chosen));
  });
  connect(save_, &QPushButton::clicked, this, [this, &ask] {
    const std::filesystem::path path =
        ask.newFile("Save the noise lines",
                    QString::fromStdString(found_->file.stem().string()) + "_noise.json",
                    "Noise lines (*.json);;For the prior program (*.xml)")
            .toStdString();
    if (path.empty()) return;
    try {
      save(path);
      emit said("saved " + QString::fromStdString(path.filename().string()));
    } catch (const Error& error) {
      emit said(error.what());
    }
  });
}

void NoisePage::forget() {
  // Lines that were chosen for one hand aren't applied to another.
  if (reading_.busy()) {
    reading_.abandon();
    emit said("noise lines not applied: another hand or recording is shown");
  }
  found_.reset();
  save_->setEnabled(false);
  apply_->setEnabled(false);
  apply_->setToolTip(kApplyTip);
}

QStringList NoisePage::names() const {
  QStringList names;
  for (const NoiseLine& line : found_->floor.lines)
    names.append(QString::fromStdString(recording()->profile.hand().matrixName(line.matrix)));
  return names;
}

void NoisePage::compute() {
  const OpenedRecordingPtr of = recording();
  NoiseFloorOptions options;
  options.bins = static_cast<std::size_t>(bins_->value());
  run("the noise floor", [this, of, options](const Progress& progress) -> Take {
    auto found = std::make_shared<FoundNoise>();
    found->options = options;
    found->file = of->path;
    found->floor = fitNoiseFloor(
        of->profile, options, [&](double done) { return progress(kFitShare * done); });
    if (isMeasured(*of)) {
      found->measured = of;
      if (const std::string why = found->floor.notAtRest; !why.empty())
        return [this, why] { say(refusal(why)); };
      return [this, found] { take(found); };
    }
    // A recording that was never on disk has no hash.
    std::error_code ignored;
    if (std::filesystem::exists(of->path, ignored)) found->sha256 = sha256OfFile(of->path);
    return [this, found] { take(found); };
  });
}

QString NoisePage::liveReason() const {
  return "\"Measure now\" reads the noise of the connected hand. Nothing may touch it, its "
         "thresholds "
         "must be 0, and it must warm up.\n\nOr record it (Ctrl+R), then open the recording.";
}

void NoisePage::take(const std::shared_ptr<const FoundNoise>& found) {
  found_ = found;
  const auto& lines = found->floor.lines;
  const bool any =
      std::any_of(lines.begin(), lines.end(), [](const NoiseLine& line) { return line.valid; });
  save_->setEnabled(any);
  const QString touched = QString::fromStdString(found->floor.notAtRest);
  apply_->setEnabled(any && touched.isEmpty());
  apply_->setToolTip(touched.isEmpty() ? QString(kApplyTip) : "Can't be applied: " + touched);
  if (!any) {
    QString why = linesOf(found->floor.notes);
    if (why.isEmpty() && !lines.empty()) why = linesOf(lines.front().notes);
    return say(why +
               "\n\nNoise lines need a hand that nothing touches, recorded at threshold 0 while it "
               "warms up.");
  }
  const QStringList all = names();
  std::vector<std::vector<FigureCell>> rows;
  for (std::size_t i = 0; i < lines.size(); ++i)
    rows.push_back(noisePageRowOf(lines[i], all[static_cast<qsizetype>(i)]));
  table_->setRows(rows);
  chart_->setFloor(found->floor, all);
  const QSignalBlocker blocker(table_);
  table_->selectRow(0);
  showNotes(0);
  showContent();
}

void NoisePage::showNotes(std::size_t matrix) {
  QString lines = linesOf(found_->floor.notes, found_->floor.lines.at(matrix).notes);
  const QString touched = QString::fromStdString(found_->floor.notAtRest);
  if (!touched.isEmpty())
    lines.prepend("The hand was " + touched +
                  ".\nThese lines are not noise and can't be applied: record the hand while "
                  "nothing touches it." +
                  (lines.isEmpty() ? "" : "\n"));
  notes_->setProperty("role", touched.isEmpty() ? "muted" : "warning");
  notes_->style()->polish(notes_);
  notes_->setText(lines);
  notes_->setVisible(!lines.isEmpty());
}

void NoisePage::save(const std::filesystem::path& path) const {
  // The dialog has asked before it replaces a file.
  OutputFile file(path, Overwrite::kReplace);
  if (path.extension() == ".xml") {
    file.write(noiseXml(found_->floor));
  } else {
    Json json = calibrationProvenance("noise");
    json.set("file", found_->file.string()).set("sha256", found_->sha256);
    if (const OpenedRecordingPtr& measured = found_->measured) {
      Json missing = Json::array();
      for (const std::string& line : measured->profile.info().warnings) missing.push(line);
      json.set("measured",
               Json::object()
                   .set("hand", measured->profile.hand().name)
                   .set("serial", measured->profile.info().serial)
                   .set("begin_us", measured->profile.frameTimeUs(0))
                   .set("seconds", measured->durationS())
                   .set("frames", measured->profile.numFrames())
                   .set("missing", std::move(missing)));
    }
    json.set("options", Json::object().set("bins", found_->options.bins));
    const Json lines = jsonOf(found_->floor);
    for (const std::string& key : lines.keys()) json.set(key, lines.at(key));
    file.write(json.text() + "\n");
  }
  file.commit();
}

std::vector<ExportedTable> NoisePage::tables() const {
  if (!shown()) return {};
  return {{"noise lines", [found = found_] { return lineTable(found); }},
          {"bins", [found = found_] { return binTable(found); }}};
}

void NoisePage::paint(QPainter& painter, const PictureLook& look, const QString& title) {
  chart_->paint(painter, look, title);
}

}  // namespace palpate::gui
