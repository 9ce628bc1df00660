#include "gui/timeline/curve_statistics.h"

#include <QClipboard>
#include <QDialogButtonBox>
#include <QGuiApplication>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <cmath>
#include <memory>

#include <palpate/core/number_text.h>
#include <palpate/signals/curve_comparison.h>
#include <palpate/signals/range_statistics.h>

#include "gui/timeline/curve_table.h"
#include "gui/widgets/figures_table.h"

namespace palpate::gui {
namespace {

// Cells of a curve table before those of the curves.
constexpr std::size_t kTimeCells = 3;
constexpr std::size_t kTimeCell = 2;  // time_s
constexpr int kStatisticsDigits = 6;

double valueOfCell(const std::string& cell) {
  return parseDouble(cell).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string statisticsCell(double value) {
  return std::isfinite(value) ? numberText(value) : std::string();
}

}  // namespace

TextTable statisticsTable(const OpenedRecordingPtr& recording,
                          const std::vector<PlottedCurve>& curves,
                          const FrameSpan& span,
                          const Progress& progress) {
  const TextTable values = curveTable(recording, curves, span);
  std::vector<double> timeS;
  std::vector<std::vector<double>> series(curves.size());
  for (std::size_t i = 0; i < values.numRows; ++i) {
    reportProgress(progress, i, values.numRows);
    const std::vector<std::string> cells = values.row(i);
    timeS.push_back(valueOfCell(cells[kTimeCell]));
    for (std::size_t c = 0; c < series.size(); ++c)
      series[c].push_back(valueOfCell(cells[kTimeCells + c]));
  }
  auto rows = std::make_shared<std::vector<std::vector<std::string>>>();
  for (std::size_t c = 0; c < series.size(); ++c) {
    const RangeStatistics found =
        rangeStatistics(timeS, series[c], gapFromS(recording->timingNow()));
    const bool ofMatrix = curves[c].choice.kind == SeriesChoice::Kind::kMatrix;
    const QString name =
        curves[c].name + (ofMatrix ? " " + nameOf(curves[c].choice.signal) : QString());
    rows->push_back({name.toStdString(),
                     curves[c].unit.toStdString(),
                     std::to_string(found.count),
                     statisticsCell(found.mean),
                     statisticsCell(found.sd),
                     statisticsCell(found.minimum),
                     statisticsCell(found.maximum),
                     statisticsCell(found.slope),
                     statisticsCell(found.integral)});
  }
  return {.header = {"curve",
                     "unit",
                     "frames",
                     "mean",
                     "sd",
                     "min",
                     "max",
                     "slope [unit/s]",
                     "integral [unit s]"},
          .numRows = rows->size(),
          .row = [rows](std::size_t row) { return (*rows)[row]; }};
}

StatisticsDialog::StatisticsDialog(const TextTable& table, const QString& range, QWidget* parent)
    : QDialog(parent) {
  setWindowTitle("Statistics of the selection");
  auto* heading = new QLabel(range, this);
  heading->setTextFormat(Qt::PlainText);
  heading->setWordWrap(true);
  auto* figures =
      new FiguresTable({{.name = "curve", .letters = 24, .words = true},
                        {.name = "unit", .letters = 7, .words = true},
                        {.name = "frames"},
                        {.name = "mean", .letters = 9},
                        {.name = "sd", .tip = "standard deviation, n - 1", .letters = 9},
                        {.name = "min", .letters = 9},
                        {.name = "max", .letters = 9},
                        {.name = "slope [unit/s]", .letters = 9},
                        {.name = "integral [unit s]", .letters = 9}},
                       this);
  figures->setObjectName("statisticsTable");
  figures->setSingleLine();
  std::vector<std::vector<FigureCell>> rows;
  for (std::size_t i = 0; i < table.numRows; ++i) {
    std::vector<FigureCell> cells;
    for (const std::string& cell : table.row(i)) {
      const auto number = cells.size() < kTimeCells ? std::nullopt : parseDouble(cell);
      cells.push_back({number ? QString::number(*number, 'g', kStatisticsDigits)
                              : QString::fromStdString(cell)});
    }
    rows.push_back(std::move(cells));
  }
  figures->setRows(rows);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  QPushButton* copy = buttons->addButton("Copy", QDialogButtonBox::ActionRole);
  copy->setObjectName("copyStatistics");
  copy->setToolTip("Copies the table with all digits, for a spreadsheet");
  connect(copy, &QPushButton::clicked, this, [table] {
    QGuiApplication::clipboard()->setText(QString::fromStdString(tabbedText(table, table.numRows)));
  });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* page = new QVBoxLayout(this);
  page->addWidget(heading);
  page->addWidget(figures, 1);
  page->addWidget(buttons);
  constexpr int kWidth = 900, kHeight = 320;  // [px]
  resize(kWidth, kHeight);
}

}  // namespace palpate::gui
