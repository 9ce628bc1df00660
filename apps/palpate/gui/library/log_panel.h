// The dock Log: what the window said, newest last; by severity and by words, to be copied and
// saved.
#pragma once

#include <QSortFilterProxyModel>
#include <QTableView>
#include <QWidget>
#include <functional>

#include "gui/appearance/theme.h"
#include "gui/window_state/activity_log.h"

class QComboBox;
class QLineEdit;
class QStackedWidget;

namespace palpate::gui {

class EmptyPage;

class LogFilter : public QSortFilterProxyModel {
  Q_OBJECT
 public:
  explicit LogFilter(ActivityLog& log, QObject* parent = nullptr);
  void setLeast(LogLine::Severity least);
  void setWords(const QString& words);  // all of them must be in a line

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

 private:
  ActivityLog& log_;
  LogLine::Severity least_ = LogLine::Severity::kInfo;
  QStringList words_;
};

// The lines: keys that move in it don't move something else in the window.
class LogTable : public QTableView {
  Q_OBJECT
 public:
  using QTableView::QTableView;

 signals:
  void copyAsked();

 protected:
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
};

class LogPanel : public QWidget {
  Q_OBJECT
 public:
  // The log must outlive it.
  explicit LogPanel(ActivityLog& log, QWidget* parent = nullptr);
  void setTheme(Theme theme);
  // The lines that are shown, or those chosen among them, one below the other.
  QString text() const;

  // Where the log shall be saved; an empty answer means cancelled.
  std::function<QString(const QString& suggestion)> askForFile;
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
  LogFilter* filter_;
  QComboBox* severity_ = nullptr;
  QLineEdit* words_ = nullptr;
  QStackedWidget* pages_ = nullptr;
  LogTable* table_ = nullptr;
  EmptyPage* empty_ = nullptr;
  bool atEnd_ = true;  // the newest line is in sight, and shall stay so
};

}  // namespace palpate::gui
