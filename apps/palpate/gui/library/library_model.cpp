#include "gui/library/library_model.h"

#include <QDateTime>
#include <QMimeData>
#include <QUrl>
#include <algorithm>
#include <cmath>

#include <palpate/core/file_name.h>
#include <palpate/core/time.h>

#include "gui/appearance/captions.h"

namespace palpate::gui {
namespace {

using LibraryModelState = RecordingDetails::State;

QString libraryModelWide(const std::string& text) { return QString::fromStdString(text); }

QString dateText(std::int64_t us, const char* format) {
  return QDateTime::fromMSecsSinceEpoch(us / kUsPerMs).toString(format);
}

QString joined(const std::vector<std::string>& labels) {
  QStringList texts;
  for (const std::string& label : labels) texts.append(libraryModelWide(label));
  return texts.join(", ");
}

// The sort key of a text column.
SearchKey searchKeyOf(int column) {
  switch (column) {
    case LibraryModel::kObject:
      return SearchKey::kObject;
    case LibraryModel::kOperator:
      return SearchKey::kOperator;
    case LibraryModel::kRun:
      return SearchKey::kRun;
    case LibraryModel::kLabels:
      return SearchKey::kLabel;
    case LibraryModel::kNotes:
      return SearchKey::kNotes;
    case LibraryModel::kFolder:
      return SearchKey::kPath;
    default:
      return SearchKey::kName;
  }
}

bool isBad(const RecordingDetails& details) {
  return details.state == LibraryModelState::kDamaged ||
         details.state == LibraryModelState::kUnreadable;
}

}  // namespace

QString lengthText(double seconds) {
  constexpr double kMinute = 60.0;
  constexpr int kMinutesPerHour = 60;
  const QChar zero('0');
  if (seconds < kMinute - 0.05) return QString::number(seconds, 'f', 1) + " s";
  const auto whole = static_cast<qint64>(std::llround(seconds));
  const qint64 minutes = whole / 60;
  if (minutes < kMinutesPerHour)
    return QString("%1 min %2 s").arg(minutes).arg(whole % 60, 2, 10, zero);
  return QString("%1 h %2 min")
      .arg(minutes / kMinutesPerHour)
      .arg(minutes % kMinutesPerHour, 2, 10, zero);
}

void LibraryModel::setFolder(const QString& folder) {
  beginResetModel();
  folder_ = folder.toStdString();
  rows_.clear();
  rowOf_.clear();
  endResetModel();
}

void LibraryModel::beginScan() {
  for (Row& row : rows_) row.seen = false;
}

void LibraryModel::take(const std::vector<LibraryEntry>& entries) {
  std::vector<const LibraryEntry*> fresh;
  for (const LibraryEntry& entry : entries) {
    const auto known = rowOf_.find(entry.details.path);
    if (known == rowOf_.end()) {
      fresh.push_back(&entry);
      continue;
    }
    Row& row = rows_[static_cast<std::size_t>(known->second)];
    row.seen = true;
    LibraryEntry taken = entry;
    applyDamage(taken);
    if (row.entry.details == taken.details) continue;
    row.entry = std::move(taken);
    emit dataChanged(index(known->second, 0), index(known->second, kNumColumns - 1));
  }
  if (fresh.empty()) return;
  const int first = static_cast<int>(rows_.size());
  beginInsertRows({}, first, first + static_cast<int>(fresh.size()) - 1);
  for (const LibraryEntry* entry : fresh) {
    rowOf_[entry->details.path] = static_cast<int>(rows_.size());
    rows_.push_back({*entry, true});
    applyDamage(rows_.back().entry);
  }
  endInsertRows();
}

void LibraryModel::endScan() {
  if (std::all_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.seen; })) return;
  for (int row = static_cast<int>(rows_.size()) - 1; row >= 0; --row) {
    if (rows_[static_cast<std::size_t>(row)].seen) continue;
    // Consecutive rows are removed together.
    int first = row;
    while (first > 0 && !rows_[static_cast<std::size_t>(first - 1)].seen) --first;
    beginRemoveRows({}, first, row);
    rows_.erase(rows_.begin() + first, rows_.begin() + row + 1);
    endRemoveRows();
    row = first;
  }
  rowOf_.clear();
  for (std::size_t row = 0; row < rows_.size(); ++row)
    rowOf_[rows_[row].entry.details.path] = static_cast<int>(row);
}

void LibraryModel::setDamaged(const std::filesystem::path& path, const std::string& message) {
  std::error_code failure;
  damaged_[std::filesystem::weakly_canonical(path, failure)] = {message, std::nullopt};
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (applyDamage(rows_[i].entry)) {
      const int row = static_cast<int>(i);
      emit dataChanged(index(row, 0), index(row, kNumColumns - 1));
    }
}

bool LibraryModel::applyDamage(LibraryEntry& entry) {
  if (damaged_.empty()) return false;
  std::error_code failure;
  RecordingDetails& details = entry.details;
  const auto known = damaged_.find(std::filesystem::weakly_canonical(details.path, failure));
  if (known == damaged_.end()) return false;
  Damage& damage = known->second;
  if (!damage.changedUs) damage.changedUs = details.changedUs;
  if (*damage.changedUs != details.changedUs) return false;
  if (details.state != LibraryModelState::kFinished) return false;
  details.state = LibraryModelState::kDamaged;
  details.message = damage.message;
  return true;
}

QString LibraryModel::path(int row) const {
  return libraryModelWide(entry(row).details.path.string());
}

double LibraryModel::totalS() const {
  double total = 0.0;
  for (const Row& row : rows_)
    total += static_cast<double>(row.entry.details.durationUs.value_or(0)) / kUsPerS;
  return total;
}

int LibraryModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int LibraryModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : kNumColumns;
}

QString LibraryModel::text(const RecordingDetails& details, int column) const {
  switch (column) {
    case kName:
      return libraryModelWide(details.path.filename().string());
    case kLength:
      if (details.durationUs) return lengthText(static_cast<double>(*details.durationUs) / kUsPerS);
      if (details.numFrames) return "empty";
      return libraryModelWide(nameOf(details.state));
    case kDate:
      return details.startUs ? dateText(*details.startUs, "yyyy-MM-dd HH:mm") : QString();
    case kObject:
      return libraryModelWide(details.object);
    case kOperator:
      return libraryModelWide(details.operatorName);
    case kRun:
      return libraryModelWide(details.run);
    case kLabels:
      return joined(details.labels);
    case kNotes:
      return libraryModelWide(details.notes).simplified();
    case kFolder: {
      std::string folder = details.path.parent_path().string();
      if (folder.starts_with(folder_)) folder.erase(0, folder_.size());
      return libraryModelWide(folder.starts_with('/') ? folder.substr(1) : folder);
    }
    default:
      return {};
  }
}

QString LibraryModel::tip(const RecordingDetails& details) const {
  QStringList lines{libraryModelWide(details.path.string())};
  if (details.startUs) lines.append("begins " + dateText(*details.startUs, "yyyy-MM-dd HH:mm:ss"));
  QStringList facts;
  if (details.numFrames) facts.append(numberOf(*details.numFrames, "frame"));
  facts.append(QString::number(static_cast<double>(details.sizeBytes) / 1e6, 'f', 1) + " MB");
  lines.append(facts.join(", "));
  if (details.state != LibraryModelState::kFinished)
    lines.append(libraryModelWide(nameOf(details.state)));
  if (!details.message.empty()) lines.append(libraryModelWide(details.message));
  for (const SeriesDetails& series : details.series)
    lines.append("series " + libraryModelWide(series.text()));
  if (!details.labels.empty()) lines.append("labels: " + joined(details.labels));
  if (!details.notes.empty()) lines.append(libraryModelWide(details.notes));
  // HTML makes the tool tip wrap; the text is escaped.
  return lines.join('\n').toHtmlEscaped().replace('\n', "<br>");
}

QVariant LibraryModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const RecordingDetails& details = entry(index.row()).details;
  switch (role) {
    case Qt::DisplayRole:
      return text(details, index.column());
    case Qt::ToolTipRole:
      return tip(details);
    case Qt::TextAlignmentRole:
      return QVariant::fromValue(Qt::Alignment(
          Qt::AlignVCenter | (index.column() == kLength ? Qt::AlignRight : Qt::AlignLeft)));
    case Qt::ForegroundRole:
      if (isBad(details)) return colorsOf().danger;
      if (details.state != LibraryModelState::kFinished) return colorsOf().warning;
      return index.column() == kName || index.column() == kLength ? colorsOf().text
                                                                  : colorsOf().muted;
    default:
      return {};
  }
}

QVariant LibraryModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || section < 0 || section >= kNumColumns) return {};
  static const char* const names[] = {
      "name", "length", "date", "object", "operator", "run", "labels", "notes", "folder"};
  if (role == Qt::DisplayRole) return names[section];
  if (role == Qt::TextAlignmentRole)
    return QVariant::fromValue(
        Qt::Alignment(Qt::AlignVCenter | (section == kLength ? Qt::AlignRight : Qt::AlignLeft)));
  return {};
}

Qt::ItemFlags LibraryModel::flags(const QModelIndex& index) const {
  if (!index.isValid()) return {};
  return Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsDragEnabled |
         Qt::ItemNeverHasChildren;
}

QStringList LibraryModel::mimeTypes() const { return {"text/uri-list"}; }

QMimeData* LibraryModel::mimeData(const QModelIndexList& indexes) const {
  QList<QUrl> urls;
  for (const QModelIndex& index : indexes)
    if (index.column() == kName) urls.append(QUrl::fromLocalFile(path(index.row())));
  // Owned by Qt's drag.
  auto* data = new QMimeData;
  data->setUrls(urls);
  return data;
}

LibraryFilter::LibraryFilter(LibraryModel& model, QObject* parent)
    : QSortFilterProxyModel(parent), model_(model) {
  setSourceModel(&model);
}

void LibraryFilter::setSearch(const QString& text) {
  search_ = RecordingSearch(text.toStdString(), caseFolded);
  invalidateRowsFilter();
}

bool LibraryFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
  return !parent.isValid() && search_.matches(model_.entry(row).text);
}

bool LibraryFilter::lessThan(const QModelIndex& left, const QModelIndex& right) const {
  const LibraryEntry& x = model_.entry(left.row());
  const LibraryEntry& y = model_.entry(right.row());
  const RecordingDetails& a = x.details;
  const RecordingDetails& b = y.details;
  switch (left.column()) {
    case LibraryModel::kLength:
      if (a.durationUs != b.durationUs) return a.durationUs < b.durationUs;
      break;
    case LibraryModel::kDate:
      if (a.startUs != b.startUs) return a.startUs < b.startUs;
      break;
    default: {
      const auto key = static_cast<std::size_t>(searchKeyOf(left.column()));
      const auto order = naturalOrder(x.text[key], y.text[key]);
      if (order != 0) return order < 0;
    }
  }
  // The path makes the order unique.
  return a.path < b.path;
}

}  // namespace palpate::gui
