#include "gui/library/log_panel.h"

#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QHeaderView>
#include <QLineEdit>
#include <QScrollBar>
#include <QStackedWidget>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include <palpate/core/error.h>
#include <palpate/core/output_file.h>

#include "gui/desktop/ask.h"
#include "gui/widgets/empty_page.h"
#include "gui/widgets/fitting_pages.h"
#include "gui/widgets/keep_keys.h"
#include "gui/widgets/make.h"
#include "gui/widgets/text_fit.h"

namespace palpate::gui {

namespace {

constexpr int kAroundLine = 6;  // above and below the text of a row together [px]

}  // namespace

LogFilter::LogFilter(ActivityLog& log, QObject* parent) : QSortFilterProxyModel(parent), log_(log) {
  setSourceModel(&log);
}

void LogFilter::setLeast(LogLine::Severity least) {
  least_ = least;
  invalidateRowsFilter();
}

void LogFilter::setWords(const QString& words) {
  words_ = words.split(' ', Qt::SkipEmptyParts);
  invalidateRowsFilter();
}

bool LogFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
  if (parent.isValid()) return false;
  const LogLine& line = log_.line(row);
  return line.severity >= least_ &&
         std::all_of(words_.begin(), words_.end(), [&](const QString& word) {
           return line.text.contains(word, Qt::CaseInsensitive);
         });
}

void LogTable::resizeEvent(QResizeEvent* event) {
  RowsTable::resizeEvent(event);
  // The width of the last column follows.
  QTimer::singleShot(0, this, &LogTable::fitAllRows);
}

void LogTable::setModel(QAbstractItemModel* model) {
  RowsTable::setModel(model);
  setWordWrap(true);
  connect(model,
          &QAbstractItemModel::rowsInserted,
          this,
          [this](const QModelIndex&, int first, int last) { fitRows(first, last); });
  connect(
      model,
      &QAbstractItemModel::dataChanged,
      this,
      [this](const QModelIndex& from, const QModelIndex& to) { fitRows(from.row(), to.row()); });
  connect(model, &QAbstractItemModel::modelReset, this, &LogTable::fitAllRows);
  connect(model, &QAbstractItemModel::layoutChanged, this, &LogTable::fitAllRows);
  fitToText(*this, [this] { fitToFont(); });
}

void LogTable::fitToFont() {
  verticalHeader()->setDefaultSectionSize(fontMetrics().lineSpacing() + kAroundLine);
  const auto widthOf = [this](const QString& text) {
    constexpr int kAroundCell = 20;  // [px]
    return fontMetrics().horizontalAdvance(text) + kAroundCell;
  };
  horizontalHeader()->resizeSection(ActivityLog::kTime, widthOf("00:00:00"));
  horizontalHeader()->resizeSection(ActivityLog::kSeverity, widthOf("warning"));
  fitAllRows();
}

void LogTable::fitAllRows() { fitRows(0, model()->rowCount() - 1); }

// Most lines fit into one row of text, which is known faster than by a layout of the text. The hint
// of the table alone leaves the padding of the cells (theme.cpp) out of the width.
void LogTable::fitRows(int first, int last) {
  constexpr int kAroundText = 20;  // [px]
  constexpr int kAnyHeight = 100'000;
  const int room = columnWidth(ActivityLog::kText) - kAroundText;
  const int usual = verticalHeader()->defaultSectionSize();
  for (int row = first; row <= last; ++row) {
    const QString text = model()->index(row, ActivityLog::kText).data().toString();
    const bool fits = fontMetrics().horizontalAdvance(text) <= room;
    const auto wrapped = [&] {
      const QRect within(0, 0, room, kAnyHeight);
      return fontMetrics().boundingRect(within, Qt::TextWordWrap, text).height() + kAroundLine;
    };
    const int height = fits ? usual : std::max({usual, sizeHintForRow(row), wrapped()});
    if (rowHeight(row) != height) setRowHeight(row, height);
  }
}

LogPanel::LogPanel(ActivityLog& log, Ask& ask, QWidget* parent)
    : QWidget(parent), log_(log), ask_(ask), filter_(new LogFilter(log, this)) {
  setObjectName("LogPanel");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  buildTop();
  buildTable();
  const auto changed = [this] { showState(); };
  connect(filter_, &QAbstractItemModel::rowsInserted, this, changed);
  connect(filter_, &QAbstractItemModel::rowsRemoved, this, changed);
  connect(filter_, &QAbstractItemModel::modelReset, this, changed);
  showState();
}

void LogPanel::buildTop() {
  severity_ = named(new QComboBox(this), "logSeverity", "Which lines are shown");
  severity_->addItems({"everything", "warnings and errors", "errors"});
  words_ = named(new QLineEdit(this), "logSearch", {}, "Search the log");
  words_->setClearButtonEnabled(true);
  words_->setPlaceholderText("Search");
  constexpr int kAroundWord = 24;  // [px]
  fitToText(*words_, [words = words_] {
    words->setMinimumWidth(words->fontMetrics().horizontalAdvance("Search") + kAroundWord);
  });
  auto* row = inRow({severity_, {words_, 1}}, around(Space::kUsual));
  const auto button = [&](const QString& text, const char* name, const QString& tip) {
    auto* made = makeToolButton(this, name, text, tip);
    made->setProperty("flat", true);
    row->addWidget(made);
    return made;
  };
  QToolButton* copy = button("Copy", "logCopy", "Copy the selected lines, or all lines shown");
  QToolButton* save = button("Save…", "logSave", "Save the selected lines, or all lines shown");
  static_cast<QBoxLayout*>(layout())->addLayout(row);
  connect(severity_, &QComboBox::currentIndexChanged, this, [this](int index) {
    filter_->setLeast(static_cast<LogLine::Severity>(index));
    showState();
  });
  connect(words_, &QLineEdit::textChanged, this, [this](const QString& words) {
    filter_->setWords(words);
    showState();
  });
  connect(
      copy, &QToolButton::clicked, this, [this] { QApplication::clipboard()->setText(text()); });
  connect(save, &QToolButton::clicked, this, &LogPanel::save);
}

void LogPanel::buildTable() {
  pages_ = new FittingPages(this);
  table_ = named(new LogTable(pages_), "logTable", {}, "Log");
  table_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  table_->horizontalHeader()->hide();
  table_->horizontalHeader()->setStretchLastSection(true);
  table_->setModel(filter_);
  empty_ = new EmptyPage("log", pages_);
  pages_->addWidget(table_);
  pages_->addWidget(empty_);
  static_cast<QBoxLayout*>(layout())->addWidget(pages_, 1);
  keepKeys(*table_, QKeySequence::Copy, [this] { QApplication::clipboard()->setText(text()); });
  connect(empty_, &EmptyPage::buttonClicked, this, [this] {
    words_->clear();
    severity_->setCurrentIndex(0);
  });
  // While an older line is shown, new lines don't scroll the table.
  QScrollBar* bar = table_->verticalScrollBar();
  connect(bar, &QScrollBar::valueChanged, this, [this, bar](int value) {
    atEnd_ = value >= bar->maximum();
  });
  connect(bar, &QScrollBar::rangeChanged, this, [this, bar](int, int most) {
    if (atEnd_) bar->setValue(most);
  });
}

void LogPanel::showState() {
  const bool none = filter_->rowCount() == 0;
  if (none && log_.rowCount() > 0)
    empty_->say("No line of the log matches.", "Show everything");
  else if (none)
    empty_->say("No messages yet.");
  pages_->setCurrentIndex(none ? 1 : 0);
}

QString LogPanel::text() const {
  QString text;
  for (const QModelIndex& row : table_->chosenOrAllRows())
    text += log_.lineText(filter_->mapToSource(row).row()) + '\n';
  return text;
}

void LogPanel::save() {
  const QString path = ask_.newFile("Save the log", "palpate-log.txt", "Text (*.txt)");
  if (path.isEmpty()) return;
  try {
    // The dialog has asked before it replaces a file.
    OutputFile file(path.toStdString(), Overwrite::kReplace);
    file.write(text().toStdString());
    file.commit();
    emit saved(path);
  } catch (const Error& error) {
    emit failed(QString::fromUtf8(error.what()));
  }
}

}  // namespace palpate::gui
