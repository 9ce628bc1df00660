// What the window said, in order: messages, what was opened and written, what happened on the link.
// The oldest lines go when there are too many.
#pragma once

#include <QAbstractTableModel>
#include <QString>
#include <deque>

#include <palpate/core/time.h>

#include "gui/appearance/theme.h"

namespace palpate::gui {

struct LogLine {
  enum class Severity { kInfo, kWarning, kError };
  qint64 timeMs = 0;  // [ms since 1970]; of the last one, where it came several times
  Severity severity = Severity::kInfo;
  QString text;
  int count = 1;  // one after the other
};

// "info", "warning", "error".
QString nameOf(LogLine::Severity severity);

class ActivityLog : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { kTime, kSeverity, kText, kNumColumns };
  static constexpr int kMaxLines = 10'000;
  static constexpr int kMaxTextLength = 4000;  // of one line; longer ones are cut

  // The clock must outlive it.
  explicit ActivityLog(const Clock& clock, QObject* parent = nullptr);

  void add(LogLine::Severity severity, const QString& text);
  void clear();
  const LogLine& line(int row) const { return lines_[static_cast<std::size_t>(row)]; }
  // "2026-11-21 14:03:07.123  warning  text (3 times)"
  QString lineText(int row) const;
  void setTheme(Theme theme);

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;

 private:
  const Clock& clock_;
  std::deque<LogLine> lines_;
  Theme theme_ = Theme::kDark;
};

}  // namespace palpate::gui
