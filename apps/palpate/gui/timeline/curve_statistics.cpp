#include "gui/timeline/curve_statistics.h"

#include <QClipboard>
#include <QDialogButtonBox>
#include <QGuiApplication>
#include <QLabel>
#include <QPushButton>
#include <QTabWidget>
#include <algorithm>
#include <cmath>
#include <memory>

#include <palpate/core/number_text.h>
#include <palpate/signals/curve_comparison.h>
#include <palpate/signals/range_statistics.h>

#include "gui/appearance/plotted_signal.h"
#include "gui/timeline/curve_table.h"
#include "gui/timeline/histogram_page.h"
#include "gui/timeline/relation_page.h"
#include "gui/widgets/figures_table.h"
#include "gui/widgets/make.h"

namespace palpate::gui {
namespace {

// Cells of a curve table before those of the curves.
constexpr std::size_t kTimeCells = 3;
constexpr std::size_t kTimeCell = 2;   // time_s
constexpr std::size_t kTextCells = 2;  // name and unit
constexpr int kStatisticsDigits = 6;

double valueOfCell(const std::string& cell) {
  return parseDouble(cell).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string statisticsCell(double value) {
  return std::isfinite(value) ? numberText(value) : std::string();
}

}  // namespace

SelectedCurves selectedCurves(const OpenedRecordingPtr& recording,
                              const std::vector<PlottedCurve>& curves,
                              const FrameSpan& span,
                              const Progress& progress,
                              const std::optional<Profile>& with) {
  SelectedCurves selected{.gapS = gapFromS(recording->timingNow())};
  for (const PlottedCurve& curve : curves) {
    const bool ofMatrix = curve.choice.kind == SeriesChoice::Kind::kMatrix;
    selected.curves.push_back(
        {curve.name + (ofMatrix ? " " + nameOf(curve.choice.signal) : QString()), curve.unit});
  }
  const TextTable values = curveTable(recording, curves, span, with);
  for (std::size_t i = 0; i < values.numRows; ++i) {
    reportProgress(progress, i, values.numRows);
    const std::vector<std::string> cells = values.row(i);
    selected.timeS.push_back(valueOfCell(cells[kTimeCell]));
    for (std::size_t c = 0; c < selected.curves.size(); ++c)
      selected.curves[c].values.push_back(
          curves[c].conversion.of(valueOfCell(cells[kTimeCells + c])));
  }
  return selected;
}

TextTable statisticsTable(const SelectedCurves& selected) {
  auto rows = std::make_shared<std::vector<std::vector<std::string>>>();
  for (const SelectedCurves::Curve& curve : selected.curves) {
    const RangeStatistics found = rangeStatistics(selected.timeS, curve.values, selected.gapS);
    rows->push_back({curve.name.toStdString(),
                     curve.unit.toStdString(),
                     std::to_string(found.count),
                     statisticsCell(found.mean),
                     statisticsCell(found.sd),
                     statisticsCell(found.minimum),
                     statisticsCell(found.maximum),
                     statisticsCell(found.slope),
                     statisticsCell(found.integral),
                     statisticsCell(found.median),
                     statisticsCell(found.rms)});
  }
  return {.header = {"curve",
                     "unit",
                     "frames",
                     "mean",
                     "sd",
                     "min",
                     "max",
                     "slope [unit/s]",
                     "integral [unit s]",
                     "median",
                     "rms"},
          .numRows = rows->size(),
          .row = [rows](std::size_t row) { return (*rows)[row]; }};
}

TextTable statisticsTable(const OpenedRecordingPtr& recording,
                          const std::vector<PlottedCurve>& curves,
                          const FrameSpan& span,
                          const Progress& progress,
                          const std::optional<Profile>& with) {
  std::vector<PlottedCurve> inFiles;
  for (const PlottedCurve& curve : curves) inFiles.push_back(inBaseUnit(curve));
  return statisticsTable(selectedCurves(recording, inFiles, span, progress, with));
}

TextTable differenceTable(const SelectedCurves& selected) {
  auto rows = std::make_shared<std::vector<std::vector<std::string>>>();
  for (const SelectedCurves::Curve& curve : selected.curves) {
    std::vector<std::string> cells = {curve.name.toStdString(), curve.unit.toStdString()};
    const auto change = rangeChange(
        selected.timeS.size(),
        [&](std::size_t frame) { return selected.timeS[frame]; },
        [&](std::size_t frame) { return curve.values[frame]; });
    if (!change) {
      cells.resize(6);
      rows->push_back(std::move(cells));
      continue;
    }
    const auto rate = change->rate();
    cells.insert(cells.end(),
                 {statisticsCell(change->from),
                  statisticsCell(change->to),
                  statisticsCell(change->difference()),
                  rate ? statisticsCell(*rate) : std::string()});
    rows->push_back(std::move(cells));
  }
  return {.header = {"curve", "unit", "at begin", "at end", "dy", "dy/dt [unit/s]"},
          .numRows = rows->size(),
          .row = [rows](std::size_t row) { return (*rows)[row]; }};
}

StatisticsDialog::StatisticsDialog(const SelectedCurves& selected,
                                   const QString& range,
                                   QWidget* parent)
    : QDialog(parent) {
  setWindowTitle("Statistics of the selection");
  auto* heading = makeLines(this, {}, {}, range);
  auto* tabs = named(new QTabWidget(this), "statisticsTabs");
  const auto table = [&](const char* name, const TextTable& of, const auto& columns) {
    auto* figures = named(new FiguresTable(columns, tabs), name);
    figures->setSingleLine();
    std::vector<std::vector<FigureCell>> rows;
    for (std::size_t i = 0; i < of.numRows; ++i) {
      std::vector<FigureCell> cells;
      for (const std::string& cell : of.row(i)) {
        // Name and unit are texts, and the number of frames is shown as it is.
        const bool text = cells.size() < kTextCells || of.header[cells.size()] == "frames";
        const auto number = text ? std::nullopt : parseDouble(cell);
        cells.push_back({number ? QString::number(*number, 'g', kStatisticsDigits)
                                : QString::fromStdString(cell)});
      }
      rows.push_back(std::move(cells));
    }
    figures->setRows(rows);
    return figures;
  };
  const TextTable statistics = statisticsTable(selected), differences = differenceTable(selected);
  tabs->addTab(table("statisticsTable",
                     statistics,
                     std::vector<FigureColumn>{
                         {.name = "curve", .letters = 24, .words = true},
                         {.name = "unit", .letters = 7, .words = true},
                         {.name = "frames"},
                         {.name = "mean", .letters = 9},
                         {.name = "sd", .tip = "standard deviation, n - 1", .letters = 9},
                         {.name = "min", .letters = 9},
                         {.name = "max", .letters = 9},
                         {.name = "slope [unit/s]", .letters = 9},
                         {.name = "integral [unit s]", .letters = 9},
                         {.name = "median", .letters = 9},
                         {.name = "rms", .tip = "root of the mean square", .letters = 9}}),
               "&Statistics");
  tabs->addTab(table("differenceTable",
                     differences,
                     std::vector<FigureColumn>{
                         {.name = "curve", .letters = 24, .words = true},
                         {.name = "unit", .letters = 7, .words = true},
                         {.name = "at begin", .tip = "first value of the range", .letters = 9},
                         {.name = "at end", .tip = "last value of the range", .letters = 9},
                         {.name = "dy", .tip = "at end - at begin", .letters = 9},
                         {.name = "dy/dt [unit/s]", .letters = 9}}),
               "&Differences");
  auto* histogram = new HistogramPage(selected, tabs);
  auto* relation = new RelationPage(selected, tabs);
  tabs->addTab(histogram, "&Histogram");
  tabs->addTab(relation, "XY &plot");
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  QPushButton* copy = buttons->addButton("C&opy", QDialogButtonBox::ActionRole);
  copy->setObjectName("copyStatistics");
  copy->setToolTip("Copy the table of this page with all digits, for a spreadsheet");
  connect(copy, &QPushButton::clicked, this, [=] {
    const int page = tabs->currentIndex();
    const TextTable shown = page == 0   ? statistics
                            : page == 1 ? differences
                            : page == 2 ? histogram->table()
                                        : relation->table();
    QGuiApplication::clipboard()->setText(QString::fromStdString(tabbedText(shown, shown.numRows)));
  });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  setLayout(inColumn({heading, {tabs, 1}, buttons}, kPageEdges));
  constexpr int kWidth = 900, kHeight = 420;  // [px]
  resize(kWidth, kHeight);
}

}  // namespace palpate::gui
