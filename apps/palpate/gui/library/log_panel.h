// The content of the dock Log: the messages of the window, newest last; they can be filtered by
// severity and words, copied and saved.
#pragma once

#include <QSortFilterProxyModel>
#include <QWidget>

#include "gui/appearance/theme.h"
#include "gui/widgets/rows_table.h"
#include "gui/window_state/activity_log.h"

class QComboBox;
class QLineEdit;
class QStackedWidget;

namespace palpate::gui {

class Ask;
class EmptyPage;

// The lines of the log that match severity and words.
class LogFilter : public QSortFilterProxyModel {
  Q_OBJECT
 public:
  explicit LogFilter(ActivityLog& log, QObject* parent = nullptr);
  void setLeast(LogLine::Severity least);
  // A line is shown when it contains all of these words.
  void setWords(const QString& words);

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

 private:
  ActivityLog& log_;
  LogLine::Severity least_ = LogLine::Severity::kInfo;
  QStringList words_;
};

// The table of messages; a long one has several rows of text.
class LogTable : public RowsTable {
  Q_OBJECT
 public:
  using RowsTable::RowsTable;
  // Called once.
  void setModel(QAbstractItemModel* model) override;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  // Widths of the columns and heights of the rows for the present size of text.
  void fitToFont();
  // Each row is as high as its text needs.
  void fitAllRows();
  void fitRows(int first, int last);
};

class LogPanel : public QWidget {
  Q_OBJECT
 public:
  // `log` must outlive this.
  LogPanel(ActivityLog& log, Ask& ask, QWidget* parent = nullptr);
  // The chosen lines, else all shown lines, one below the other.
  QString text() const;

  QSize sizeHint() const override { return {420, 300}; }

 signals:
  void saved(const QString& path);
  void failed(const QString& message);

 private:
  void buildTop();
  void buildTable();
  void save();
  void showState();

  ActivityLog& log_;
  Ask& ask_;
  LogFilter* filter_;
  QComboBox* severity_ = nullptr;
  QLineEdit* words_ = nullptr;
  QStackedWidget* pages_ = nullptr;
  LogTable* table_ = nullptr;
  EmptyPage* empty_ = nullptr;
  // The newest line is visible and is kept visible when lines are added.
  bool atEnd_ = true;
};

}  // namespace palpate::gui
