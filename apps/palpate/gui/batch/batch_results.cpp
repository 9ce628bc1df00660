#include "gui/batch/batch_results.h"

#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QStyledItemDelegate>
#include <algorithm>
#include <string_view>
#include <utility>

#include <palpate/core/error.h>
#include <palpate/core/escaped_line.h>
#include <palpate/core/number_text.h>
#include <palpate/core/text_table.h>

#include "gui/appearance/captions.h"
#include "gui/desktop/ask.h"
#include "gui/desktop/reveal_file.h"
#include "gui/widgets/keep_keys.h"
#include "gui/widgets/make.h"
#include "gui/widgets/rows_table.h"

namespace palpate::gui {
namespace {

using State = BatchResult::State;
enum Column { kRecording, kResultState, kWhy, kNumColumns };

bool isBadResult(const BatchResult& result) {
  return result.state == State::kFailed || result.state == State::kInPart;
}

QString textOfPath(const std::filesystem::path& path) {
  return QString::fromStdString(escapedLine(path.string()));
}

// Without the recording's path at the begin, which is in another column.
QString textOfResult(const BatchItem& item, const BatchResult& result) {
  const std::string begin = item.source.string() + ": ";
  const std::size_t skipped = result.text.rfind(begin, 0) == 0 ? begin.size() : 0;
  return inWindowWords(
      QString::fromStdString(escapedLine(std::string_view(result.text).substr(skipped))));
}

// Paths that are too long lose their folders, not the name at their end.
class PathDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override {
    QStyledItemDelegate::initStyleOption(option, index);
    option->textElideMode = Qt::ElideLeft;
  }
};

}  // namespace

void BatchResultsModel::show(std::shared_ptr<const BatchOutcome> outcome, bool all) {
  beginResetModel();
  outcome_ = std::move(outcome);
  rows_.clear();
  if (outcome_)
    for (std::size_t i = 0; i < outcome_->report.results.size(); ++i)
      if (all || isBadResult(outcome_->report.results[i])) rows_.push_back(i);
  endResetModel();
}

int BatchResultsModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int BatchResultsModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : kNumColumns;
}

QVariant BatchResultsModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || (role != Qt::DisplayRole && role != Qt::ToolTipRole)) return {};
  const std::size_t row = rows_[static_cast<std::size_t>(index.row())];
  const BatchItem& item = outcome_->plan.items[row];
  const BatchResult& result = outcome_->report.results[row];
  switch (index.column()) {
    case kRecording:
      if (role == Qt::ToolTipRole || item.root.empty()) return textOfPath(item.source);
      return textOfPath(item.source.lexically_relative(item.root));
    case kResultState:
      return nameOf(result.state);
    default:
      return textOfResult(item, result);
  }
}

QVariant BatchResultsModel::headerData(int section, Qt::Orientation orientation, int role) const {
  static const QStringList names = {"Recording", "State", "What was made, or why not"};
  if (role != Qt::DisplayRole || orientation != Qt::Horizontal) return {};
  return names.value(section);
}

QString BatchResultsModel::source(int row) const {
  return QString::fromStdString(
      outcome_->plan.items[rows_[static_cast<std::size_t>(row)]].source.string());
}

BatchResults::BatchResults(Ask& ask, QWidget* parent)
    : QWidget(parent), reveal(revealInFileManager), ask_(ask), model_(new BatchResultsModel(this)) {
  summary_ = makeLines(nullptr, "batchSummary");
  table_ = named(new RowsTable, "batchTable");
  table_->setModel(model_);
  table_->setItemDelegateForColumn(kRecording, new PathDelegate(table_));
  table_->horizontalHeader()->setStretchLastSection(true);
  table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  table_->setColumnWidth(kRecording, 260);
  table_->setColumnWidth(kResultState, 100);
  all_ = named(new QCheckBox("Show all &recordings"), "batchShowAll");
  copy_ = makeButton(nullptr, "batchCopy", "Co&py", "Copy the selected rows, or all (Ctrl+C)");
  save_ =
      makeButton(nullptr,
                 "batchSaveReport",
                 "Save re&port…",
                 "A table as CSV, a row for each recording: source, result, state, text, files");
  show_ = makeButton(nullptr,
                     "batchReveal",
                     "Sho&w recording",
                     "Show the recording in the file manager (or double-click it)");
  setLayout(
      inColumn({summary_, {table_, 1}, inRow({all_, Stretch{}, show_, copy_, save_})}, kPageEdges));
  keepKeys(*table_, QKeySequence::Copy, [this] { copyRows(); });
  connect(copy_, &QPushButton::clicked, this, &BatchResults::copyRows);
  connect(save_, &QPushButton::clicked, this, &BatchResults::saveReport);
  connect(all_, &QCheckBox::toggled, this, &BatchResults::fill);
  const auto revealRow = [this](const QModelIndex& index) {
    if (index.isValid()) reveal(model_->source(index.row()));
  };
  connect(table_, &QTableView::doubleClicked, this, revealRow);
  connect(show_, &QPushButton::clicked, this, [this, revealRow] {
    revealRow(table_->selectionModel()->currentIndex());
  });
  connect(table_->selectionModel(),
          &QItemSelectionModel::currentChanged,
          this,
          [this](const QModelIndex& now) { show_->setEnabled(now.isValid()); });
  fill();
}

void BatchResults::begin() {
  running_ = true;
  fill();
}

void BatchResults::show(const std::shared_ptr<const BatchOutcome>& outcome) {
  running_ = false;
  outcome_ = outcome;
  fill();
}

void BatchResults::fill() {
  const bool some = outcome_ != nullptr;
  // Where nothing went wrong there is nothing to hide, also after a batch that was cancelled.
  const bool someWrong =
      some &&
      std::any_of(outcome_->report.results.begin(), outcome_->report.results.end(), isBadResult);
  all_->setEnabled(someWrong);
  model_->show(outcome_, all_->isChecked() || !someWrong);
  show_->setEnabled(false);
  copy_->setEnabled(some && model_->rowCount() > 0);
  save_->setEnabled(some);
  if (running_)
    return summary_->setText(some ? "A batch is running. The table shows the previous one."
                                  : "A batch is running.");
  if (!some) return summary_->setText("No batch has run yet.");
  QString text =
      (outcome_->report.cancelled ? "Cancelled: " : "") + countsText(outcome_->report.status);
  std::size_t files = 0;
  for (const BatchResult& result : outcome_->report.results) files += result.files.size();
  if (files > 0) text += "; " + QString::fromStdString(counted(files, "file"));
  text += ".";
  if (outcome_->report.cancelled) text += " Start resumes with the unfinished files.";
  for (const std::string& problem : outcome_->plan.problems)
    text += "\n" + inWindowWords(QString::fromStdString(escapedLine(problem)));
  summary_->setText(text);
}

void BatchResults::copyRows() {
  const QModelIndexList rows = table_->chosenOrAllRows();
  if (rows.isEmpty()) return;
  const TextTable table{.header = {"recording", "state", "text"},
                        .numRows = static_cast<std::size_t>(rows.size()),
                        .row = [&](std::size_t i) -> std::vector<std::string> {
                          const int row = rows[static_cast<qsizetype>(i)].row();
                          return {model_->source(row).toStdString(),
                                  model_->index(row, kResultState).data().toString().toStdString(),
                                  model_->index(row, kWhy).data().toString().toStdString()};
                        }};
  QApplication::clipboard()->setText(
      QString::fromStdString(tabbedText(table, static_cast<std::size_t>(rows.size()))));
  emit said(
      QString("%1 copied").arg(rows.size() == 1 ? "1 row" : QString("%1 rows").arg(rows.size())));
}

void BatchResults::saveReport() {
  if (!outcome_) return;
  QString path = ask_.newFile("Save the report", "batch.csv", "Tables (*.csv)");
  if (path.isEmpty()) return;
  // The file dialog has asked whether a file of the chosen name may be replaced.
  Overwrite overwrite = Overwrite::kReplace;
  if (!path.endsWith(".csv", Qt::CaseInsensitive)) {
    path += ".csv";
    overwrite = Overwrite::kRefuse;
  }
  try {
    writeTable(reportTable(outcome_->plan, outcome_->report), path.toStdString(), overwrite);
    emit said("saved: " + path);
  } catch (const Error& error) {
    emit said(QString::fromStdString(escapedLine(error.what())));
  }
}

}  // namespace palpate::gui
