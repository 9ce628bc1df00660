// Keeps the log of the window, in order of time: messages, files opened and written, what happened
// on the connection. When it holds kMaxLines, the oldest lines are removed.
#pragma once

#include <QAbstractTableModel>
#include <QString>
#include <deque>

#include <palpate/core/time.h>

#include "gui/appearance/theme.h"

namespace palpate::gui {

struct LogLine {
  enum class Severity { kInfo, kWarning, kError };
  // Time of the message [ms since 1970]; of the last one where it was repeated.
  qint64 timeMs = 0;
  Severity severity = Severity::kInfo;
  QString text;
  // How many times the message came in a row.
  int count = 1;
};

// "info", "warning", "error".
QString nameOf(LogLine::Severity severity);

class ActivityLog : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { kTime, kSeverity, kText, kNumColumns };
  static constexpr int kMaxLines = 10'000;
  // Longest text of one line [letters]; longer texts are cut.
  static constexpr int kMaxTextLength = 4000;

  // The clock must outlive this object.
  explicit ActivityLog(const Clock& clock, QObject* parent = nullptr);

  void add(LogLine::Severity severity, const QString& text);
  const LogLine& line(int row) const { return lines_[static_cast<std::size_t>(row)]; }
  // "2026-11-21 14:03:07.123  warning  text (3 times)"
  QString lineText(int row) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;

 private:
  const Clock& clock_;
  std::deque<LogLine> lines_;
};

}  // namespace palpate::gui
