#include "gui/window_state/activity_log.h"

#include <QDateTime>

#include <palpate/core/time.h>

namespace palpate::gui {
namespace {

constexpr int kDroppedAtOnce = 500;

QString timeText(qint64 ms, const char* format) {
  return QDateTime::fromMSecsSinceEpoch(ms).toString(format);
}

QString activityLogTextOf(const LogLine& line) {
  return line.count == 1 ? line.text : QString("%1 (%2 times)").arg(line.text).arg(line.count);
}

}  // namespace

QString nameOf(LogLine::Severity severity) {
  switch (severity) {
    case LogLine::Severity::kWarning:
      return "warning";
    case LogLine::Severity::kError:
      return "error";
    case LogLine::Severity::kInfo:
      break;
  }
  return "info";
}

ActivityLog::ActivityLog(const Clock& clock, QObject* parent)
    : QAbstractTableModel(parent), clock_(clock) {}

void ActivityLog::add(LogLine::Severity severity, const QString& text) {
  const QString said = text.simplified().left(kMaxTextLength);
  if (said.isEmpty()) return;
  const qint64 nowMs = clock_.wallUs() / kUsPerMs;
  const int last = static_cast<int>(lines_.size()) - 1;
  if (last >= 0 && lines_.back().severity == severity && lines_.back().text == said) {
    lines_.back().timeMs = nowMs;
    ++lines_.back().count;
    emit dataChanged(index(last, 0), index(last, kNumColumns - 1));
    return;
  }
  if (static_cast<int>(lines_.size()) >= kMaxLines) {
    beginRemoveRows({}, 0, kDroppedAtOnce - 1);
    lines_.erase(lines_.begin(), lines_.begin() + kDroppedAtOnce);
    endRemoveRows();
  }
  const int row = static_cast<int>(lines_.size());
  beginInsertRows({}, row, row);
  lines_.push_back({nowMs, severity, said, 1});
  endInsertRows();
}

QString ActivityLog::lineText(int row) const {
  const LogLine& at = line(row);
  return timeText(at.timeMs, "yyyy-MM-dd HH:mm:ss.zzz") + "  " +
         nameOf(at.severity).leftJustified(7) + "  " + activityLogTextOf(at);
}

int ActivityLog::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(lines_.size());
}

int ActivityLog::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : kNumColumns;
}

QVariant ActivityLog::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const LogLine& at = line(index.row());
  const ThemeColors& colors = colorsOf();
  switch (role) {
    case Qt::DisplayRole:
      if (index.column() == kTime) return timeText(at.timeMs, "HH:mm:ss");
      return index.column() == kSeverity ? nameOf(at.severity) : activityLogTextOf(at);
    case Qt::ToolTipRole:
      // HTML, so that the tool tip wraps its lines.
      return lineText(index.row()).toHtmlEscaped();
    case Qt::TextAlignmentRole:
      return QVariant::fromValue(Qt::Alignment(Qt::AlignLeft | Qt::AlignTop));
    case Qt::ForegroundRole:
      if (at.severity == LogLine::Severity::kError) return colors.danger;
      if (at.severity == LogLine::Severity::kWarning) return colors.warning;
      return index.column() == kText ? colors.text : colors.muted;
    default:
      return {};
  }
}

}  // namespace palpate::gui
