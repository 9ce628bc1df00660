#include "recording/import/folder_source.h"

#include <algorithm>
#include <limits>
#include <system_error>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "recording/import/cell_text.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr const char* kEndings[] = {".csv", ".txt", ".npy"};

// At the end of the name of a file.
std::optional<std::int64_t> numberInName(const fs::path& file) {
  const std::string stem = file.stem().string();
  const auto digits = stem.find_last_not_of("0123456789") + 1;  // of npos: 0
  return parseInteger(std::string_view(stem).substr(digits));
}

}  // namespace

FolderSource::FolderSource(const fs::path& path, const TableOptions& options)
    : path_(path), options_(options) {
  options_.header = HeaderChoice::kAbsent;
  std::error_code failure;
  for (const char* ending : kEndings) {
    files_.clear();
    for (const fs::directory_entry& entry : fs::directory_iterator(path, failure)) {
      const auto number = numberInName(entry.path());
      if (number && entry.path().extension() == ending) files_.push_back({entry.path(), *number});
    }
    if (files_.size() > 1) break;
  }
  if (files_.size() < 2)
    throw FormatError(
        path,
        "is a folder; name a file in it (the names of a .csv, .txt or .npy per frame end in a "
        "number, those of one per matrix are those of the matrices)");
  std::sort(files_.begin(), files_.end());
  columns_.push_back({.name = "file", .type = "number"});
  const std::size_t count = numbersOf(files_.front().path).size();
  for (std::size_t i = 0; i < count; ++i)
    columns_.push_back({.name = "number " + std::to_string(i + 1), .type = "number"});
}

std::string FolderSource::form() const {
  return "folder of " + counted(files_.size(), "file") + ", one per frame";
}

// All numbers of a file; NaN where there is none.
std::vector<double> FolderSource::numbersOf(const fs::path& file) const {
  const auto source = openTable(file, options_);
  std::vector<std::size_t> all;
  for (std::size_t c = 0; c < source->columns().size(); ++c) all.push_back(c);
  source->start(all, std::nullopt);
  std::vector<double> numbers;
  TableRow row;
  while (source->next(row)) {
    if (!row.complete)
      throw FormatError(file, source->rowWord() + (" " + std::to_string(row.line)) + row.fault);
    for (std::size_t i = 0; i < row.values.size(); ++i)
      numbers.push_back(row.states[i] == CellState::kNumber
                            ? row.values[i]
                            : std::numeric_limits<double>::quiet_NaN());
    if (numbers.size() > kMaxNumbersPerRow)
      throw FormatError(file, "has more than " + std::to_string(kMaxNumbersPerRow) + " numbers");
  }
  return numbers;
}

void FolderSource::start(std::span<const std::size_t> columns, std::optional<std::size_t> time) {
  selected_.assign(columns.begin(), columns.end());
  time_ = time;
  next_ = 0;
}

bool FolderSource::next(TableRow& row) {
  if (next_ == files_.size()) return false;
  const FrameFile& file = files_[next_++];
  row.line = next_;
  row.complete = false;
  try {
    numbers_ = numbersOf(file.path);
    row.numCells = numbers_.size();
    row.complete = numbers_.size() + 1 == columns_.size();
    row.fault = " (" + shortened(file.path.filename().string()) + ") has " +
                counted(numbers_.size(), "number") + " instead of " +
                std::to_string(columns_.size() - 1);
  } catch (const FormatError& error) {
    row.fault = std::string(": ") + error.what();
  }
  if (!row.complete) return true;
  numbers_.insert(numbers_.begin(), static_cast<double>(file.number));
  row.values.clear();
  row.states.clear();
  for (const std::size_t column : selected_) {
    row.values.push_back(numbers_[column]);
    row.states.push_back(fitsFloat(numbers_[column]) || column == 0 ? CellState::kNumber
                                                                    : CellState::kNotFinite);
  }
  row.time = {};
  if (time_ == 0) {
    timeText_ = std::to_string(file.number);
    row.time = {.state = CellState::kText, .text = timeText_, .whole = file.number};
  }
  return true;
}

double FolderSource::fraction() const noexcept {
  return static_cast<double>(next_) / static_cast<double>(files_.size());
}

std::string FolderSource::textOf(std::size_t index) const {
  return numberText(numbers_.at(selected_.at(index)));
}

std::string FolderSource::placeOf(std::size_t index) const {
  return columns_.at(selected_.at(index)).name + ": " + textOf(index);
}

std::vector<fs::path> filesPerMatrix(const fs::path& folder) {
  std::error_code failure;
  for (const char* ending : kEndings) {
    std::vector<fs::path> files;
    std::size_t numNumbered = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
      if (entry.path().extension() != ending) continue;
      files.push_back(entry.path());
      numNumbered += numberInName(entry.path()) ? 1 : 0;
    }
    if (files.size() < 2) continue;
    std::sort(files.begin(), files.end());
    // A single other file lies beside frames.
    const std::size_t numOthers = files.size() - numNumbered;
    return numOthers < 2 || numOthers < numNumbered ? std::vector<fs::path>() : files;
  }
  return {};
}

}  // namespace palpate
