#include "imports/pad_folder_source.h"

#include <algorithm>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "imports/time_choice.h"

namespace palpate {
namespace {

bool isSameTime(const TimeCell& one, const TimeCell& other) {
  return one.state == other.state && one.text == other.text && one.whole == other.whole &&
         one.number == other.number;
}

}  // namespace

PadFolderSource::PadFolderSource(const std::filesystem::path& path,
                                 const std::vector<std::filesystem::path>& files,
                                 const TableOptions& options)
    : path_(path) {
  for (const std::filesystem::path& each : files) {
    PadFile file;
    file.name = each.filename().string();
    file.table = openTable(each, options);
    const std::vector<TableColumn>& columns = file.table->columns();
    int best = 0;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const int score = timeScore(columns[c], PlannedSeries::Kind::kFrames);
      if (score <= best) continue;
      best = score;
      file.time = c;
    }
    const std::string stem = each.stem().string();
    std::size_t number = 0;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      TableColumn column = columns[c];
      const bool isTime = c == file.time;
      // One time for all files.
      if (isTime && !files_.empty() && files_.front().time) continue;
      if (!isTime) {
        column.name = stem;
        if (column.shape.empty()) column.name += "[" + std::to_string(number++) + "]";
      }
      columns_.push_back(std::move(column));
      places_.push_back({files_.size(), c});
    }
    files_.push_back(std::move(file));
  }
  for (const PadFile& file : files_)
    if (file.time.has_value() != files_.front().time.has_value())
      throw FormatError(path,
                        "has times in some of its files only: save them in all, or in none "
                        "(and give --rate)");
}

std::string PadFolderSource::form() const {
  return "folder of " + counted(files_.size(), "file") + ", one per matrix";
}

void PadFolderSource::start(std::span<const std::size_t> columns, std::optional<std::size_t> time) {
  selected_.assign(columns.begin(), columns.end());
  time_ = time;
  row_ = 0;
  for (PadFile& file : files_) file.selected.clear();
  for (const std::size_t column : selected_)
    files_[places_[column].file].selected.push_back(places_[column].column);
  for (std::size_t f = 0; f < files_.size(); ++f) {
    PadFile& file = files_[f];
    file.isRead = !file.selected.empty() || (time_ && places_[*time_].file == f);
    if (file.isRead) file.table->start(file.selected, time_ ? file.time : std::nullopt);
  }
}

bool PadFolderSource::next(TableRow& row) {
  const PadFile* first = nullptr;
  const PadFile* ended = nullptr;
  const PadFile* goesOn = nullptr;
  row = {};
  row.line = ++row_;
  row.numCells = columns_.size();
  for (PadFile& file : files_) {
    if (!file.isRead) continue;
    (file.table->next(file.row) ? goesOn : ended) = &file;
    if (file.row.complete || !row.complete) continue;
    row.complete = false;
    row.fault = " (" + shortened(file.name) + ", " + file.table->rowWord() + " " +
                std::to_string(file.row.line) + ")" + file.row.fault;
  }
  if (ended && goesOn)
    throw FormatError(path_,
                      shortened(ended->name) + " has " + std::to_string(row_ - 1) + " rows, " +
                          shortened(goesOn->name) + " has more; save a row per frame in each file");
  if (!goesOn) return false;
  for (PadFile& file : files_) {
    if (!file.isRead || !row.complete || !time_) continue;
    if (!first) first = &file;
    if (isSameTime(file.row.time, first->row.time)) continue;
    row.complete = false;
    row.fault =
        " has another time in " + shortened(file.name) + " than in " + shortened(first->name);
  }
  if (!row.complete) return true;
  std::vector<std::size_t> taken(files_.size(), 0);
  for (const std::size_t column : selected_) {
    const std::size_t f = places_[column].file;
    for (std::size_t i = 0; i < columns_[column].width(); ++i, ++taken[f]) {
      row.values.push_back(files_[f].row.values[taken[f]]);
      row.states.push_back(files_[f].row.states[taken[f]]);
    }
  }
  if (time_) row.time = files_[places_[*time_].file].row.time;
  return true;
}

double PadFolderSource::fraction() const noexcept {
  for (const PadFile& file : files_)
    if (file.isRead) return file.table->fraction();
  return 1.0;
}

std::pair<const PadFolderSource::PadFile*, std::size_t> PadFolderSource::originOf(
    std::size_t index) const {
  std::vector<std::size_t> before(files_.size(), 0);
  std::size_t left = index;
  for (const std::size_t column : selected_) {
    const std::size_t f = places_[column].file;
    const std::size_t width = columns_[column].width();
    if (left < width) return {&files_[f], before[f] + left};
    left -= width;
    before[f] += width;
  }
  return {nullptr, 0};
}

std::string PadFolderSource::textOf(std::size_t index) const {
  const auto [file, within] = originOf(index);
  return file ? file->table->textOf(within) : std::string();
}

std::string PadFolderSource::placeOf(std::size_t index) const {
  const auto [file, within] = originOf(index);
  return file ? shortened(file->name) + ", " + file->table->placeOf(within) : "a value";
}

std::string PadFolderSource::endNote() const {
  for (const PadFile& file : files_)
    if (file.isRead && !file.table->endNote().empty())
      return shortened(file.name) + ": " + file.table->endNote();
  return {};
}

}  // namespace palpate
