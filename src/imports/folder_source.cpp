#include "imports/folder_source.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <map>
#include <system_error>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"

#include "imports/cell_text.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

constexpr const char* kEndings[] = {".csv", ".txt", ".npy"};
constexpr std::size_t kShownFiles = 3;

// "3 x 2", "6".
std::string fileShapeText(const std::vector<std::size_t>& shape) {
  std::string text;
  for (const std::size_t size : shape) text += (text.empty() ? "" : " x ") + std::to_string(size);
  return text.empty() ? "1" : text;
}

// "FRAME_1.CSV" of an SD card is a .csv.
std::string endingOf(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& letter : ending)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return ending;
}

// The first names of some files.
std::string firstOf(std::vector<std::string> files) {
  std::sort(files.begin(), files.end());
  std::string names;
  for (std::size_t i = 0; i < std::min(kShownFiles, files.size()); ++i)
    names += (i > 0 ? ", " : "") + shortened(files[i]);
  if (files.size() > kShownFiles)
    names += " and " + std::to_string(files.size() - kShownFiles) + " more";
  return names;
}

bool isDigitAt(const std::string& text, std::size_t at) {
  return at < text.size() && text[at] >= '0' && text[at] <= '9';
}

}  // namespace

// The name of a file without its ending, with # in the places of its numbers: "t_0.95" and "t_-3"
// are "t_#", "10-00-55" is "#-#-#".
std::string FolderSource::patternOf(const std::string& stem, std::vector<NameNumber>& numbers) {
  std::string pattern;
  for (std::size_t at = 0; at < stem.size();) {
    const bool isSign = stem[at] == '-' && isDigitAt(stem, at + 1) &&
                        (at == 0 || stem[at - 1] == '_' || stem[at - 1] == ' ');
    const std::size_t begin = at + (isSign ? 1 : 0);
    std::size_t end = begin;
    while (isDigitAt(stem, end)) ++end;
    const auto whole = parseInteger(std::string_view(stem).substr(begin, end - begin));
    if (!whole) {
      pattern += stem[at++];
      while (end > at && isDigitAt(stem, at)) pattern += stem[at++];  // too many digits
      continue;
    }
    NameNumber number{*whole, 0.0};
    std::size_t fractionEnd = end;
    if (end < stem.size() && stem[end] == '.') {
      ++fractionEnd;
      while (isDigitAt(stem, fractionEnd)) ++fractionEnd;
      const bool isDate = (begin > 0 && stem[begin - 1] == '.') ||
                          (fractionEnd < stem.size() && stem[fractionEnd] == '.');
      if (fractionEnd == end + 1 || isDate)
        fractionEnd = end;
      else
        number.second = parseDouble("0" + stem.substr(end, fractionEnd - end)).value_or(0.0);
    }
    if (isSign)
      number = number.second > 0.0 ? NameNumber{-number.first - 1, 1.0 - number.second}
                                   : NameNumber{-number.first, 0.0};
    numbers.push_back(number);
    pattern += '#';
    at = fractionEnd;
  }
  return pattern;
}

// The frames are the most files whose names differ by numbers only.
void FolderSource::findFiles() {
  std::map<std::string, std::vector<FrameFile>> byPattern;
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_, failure)) {
    const std::string ending = endingOf(entry.path());
    if (std::find(std::begin(kEndings), std::end(kEndings), ending) == std::end(kEndings)) continue;
    FrameFile file{entry.path(), {}};
    const std::string pattern = patternOf(entry.path().stem().string(), file.numbers);
    byPattern[pattern + ending].push_back(std::move(file));
  }
  const auto best = std::max_element(
      byPattern.begin(), byPattern.end(), [](const auto& first, const auto& second) {
        return first.second.size() < second.second.size();
      });
  if (best == byPattern.end() || best->second.size() < 2 || best->second.front().numbers.empty())
    throw FormatError(path_,
                      "is a folder; name a file in it (the names of a .csv, .txt or .npy per frame "
                      "have a number, those of one per matrix are those of the matrices)");
  files_ = std::move(best->second);
  std::sort(files_.begin(), files_.end());
  std::vector<std::string> others;
  std::vector<std::string> numbered;
  for (const auto& [pattern, files] : byPattern)
    for (const FrameFile& file : files)
      if (pattern != best->first)
        (file.numbers.empty() ? others : numbered).push_back(file.path.filename().string());
  if (others.size() + numbered.size() >= files_.size()) {
    others.insert(others.end(), numbered.begin(), numbered.end());
    throw FormatError(path_,
                      "is a folder with " + counted(files_.size(), "file") + " " +
                          shortened(best->first) + " and " + counted(others.size(), "other") +
                          " (" + firstOf(others) +
                          "): which ones are the frames is unclear; leave only those in it");
  }
  if (!others.empty()) note_ = "files that are not used: " + firstOf(others);
  if (!numbered.empty())
    leftOut_ = counted(numbered.size(), "file") + " of another name left out, which may be " +
               (numbered.size() == 1 ? "a frame" : "frames") + ": " + firstOf(numbered);
  const auto same = std::adjacent_find(
      files_.begin(), files_.end(), [](const FrameFile& first, const FrameFile& second) {
        return first.numbers == second.numbers;
      });
  if (same != files_.end())
    throw FormatError(
        path_,
        "has two files of the same number, " + shortened(same->path.filename().string()) + " and " +
            shortened((same + 1)->path.filename().string()) + ": their order is unclear");
}

// Whether one number tells the files apart: it may be the time, or count the frames.
void FolderSource::findVarying() {
  const std::vector<NameNumber>& first = files_.front().numbers;
  for (std::size_t n = 0; n < first.size(); ++n) {
    const bool differs = std::any_of(files_.begin(), files_.end(), [&](const FrameFile& file) {
      return file.numbers[n] != first[n];
    });
    if (differs && varying_) {
      note_ += std::string(note_.empty() ? "" : "; ") +
               "several numbers in the names differ: missing files can't be detected from them";
      return varying_.reset();
    }
    if (differs) varying_ = n;
  }
}

FolderSource::FolderSource(const fs::path& path, const TableOptions& options)
    : path_(path), options_(options) {
  if (options_.header == HeaderChoice::kDetect) options_.header = HeaderChoice::kAbsent;
  findFiles();
  findVarying();
  columns_.push_back({.name = "file", .type = "number"});
  columns_.push_back({.name = "numbers", .shape = usualShape(), .type = "number"});
}

// The first file may be the one that is cut off: the shape that most of the first ones have.
std::vector<std::size_t> FolderSource::usualShape() const {
  constexpr std::size_t kTried = 8;
  std::vector<std::vector<std::size_t>> shapes;
  std::exception_ptr fault;
  for (std::size_t i = 0; i < std::min(kTried, files_.size()); ++i) {
    try {
      shapes.push_back(numbersOf(files_[i].path).shape);
    } catch (const FormatError&) {
      if (!fault) fault = std::current_exception();
    }
  }
  if (shapes.empty()) std::rethrow_exception(fault);
  return *std::max_element(
      shapes.begin(), shapes.end(), [&](const auto& first, const auto& second) {
        return std::count(shapes.begin(), shapes.end(), first) <
               std::count(shapes.begin(), shapes.end(), second);
      });
}

// Holes in the numbers of the names, where times don't show them.
std::vector<std::string> FolderSource::doubts(double mostCounted) const {
  std::vector<std::string> doubts;
  if (!leftOut_.empty()) doubts.push_back(leftOut_);
  if (!varying_) return doubts;
  std::vector<double> steps;
  for (std::size_t i = 1; i < files_.size(); ++i) {
    const NameNumber& before = files_[i - 1].numbers[*varying_];
    const NameNumber& number = files_[i].numbers[*varying_];
    steps.push_back(static_cast<double>(number.first) - static_cast<double>(before.first) +
                    number.second - before.second);
  }
  std::vector<double> sorted = steps;
  std::nth_element(sorted.begin(), sorted.begin() + (sorted.size() - 1) / 2, sorted.end());
  const double usual = sorted[(sorted.size() - 1) / 2];
  constexpr double kHole = 1.5;  // usual steps; times jitter
  const auto isHole = [&](double step) { return step > kHole * usual && step > mostCounted; };
  const auto first = std::find_if(steps.begin(), steps.end(), isHole);
  if (first != steps.end())
    doubts.push_back(
        "the numbers in the names ascend by " + numberText(usual) + ", but " +
        counted(static_cast<std::size_t>(std::count_if(first, steps.end(), isHole)), "time") +
        " by more, first by " + numberText(*first) + " before " +
        shortened(
            files_[static_cast<std::size_t>(first - steps.begin()) + 1].path.filename().string()) +
        ": files may be missing, and the times don't show it");
  return doubts;
}

std::string FolderSource::endNote() const {
  if (numOpenEnded_ == 0) return {};
  return counted(numOpenEnded_, "file") +
         (numOpenEnded_ == 1 ? " has no line end" : " have no line end") + " at the end, first " +
         firstOpenEnded_ + ": a last number may be cut off";
}

std::string FolderSource::form() const {
  return "folder of " + counted(files_.size(), "file") + ", one per frame";
}

FolderSource::FileNumbers FolderSource::numbersOf(const fs::path& file) const {
  const auto source = openTable(file, options_);
  std::vector<std::size_t> all;
  for (std::size_t c = 0; c < source->columns().size(); ++c) all.push_back(c);
  source->start(all, std::nullopt);
  FileNumbers numbers;
  std::size_t numRows = 0;
  TableRow row;
  while (source->next(row)) {
    ++numRows;
    if (!row.complete)
      throw FormatError(file, source->rowWord() + (" " + std::to_string(row.line)) + row.fault);
    for (std::size_t i = 0; i < row.values.size(); ++i) {
      if (row.states[i] == CellState::kText)
        numbers.texts[numbers.values.size()] = shortened(source->textOf(i));
      numbers.states.push_back(row.states[i]);
      numbers.values.push_back(row.states[i] == CellState::kNumber
                                   ? row.values[i]
                                   : std::numeric_limits<double>::quiet_NaN());
    }
    if (numbers.values.size() > kMaxNumbersPerRow)
      throw FormatError(file, "has more than " + std::to_string(kMaxNumbersPerRow) + " numbers");
  }
  if (source->nulBytes().count > 0) throw FormatError(file, "holds bytes 0 (a power cut?)");
  numbers.isOpenEnded = !source->endNote().empty();
  numbers.shape = {numRows};
  if (all.size() == 1) {
    const auto& shape = source->columns().front().shape;
    numbers.shape.insert(numbers.shape.end(), shape.begin(), shape.end());
  } else {
    numbers.shape.push_back(numRows == 0 ? 0 : numbers.values.size() / numRows);
  }
  std::erase(numbers.shape, 1u);
  return numbers;
}

void FolderSource::start(std::span<const std::size_t> columns, std::optional<std::size_t> time) {
  selected_.assign(columns.begin(), columns.end());
  time_ = time;
  next_ = 0;
  numOpenEnded_ = 0;
  if (time_ == 0u && !varying_)
    throw FormatError(path_,
                      "has names with several numbers that differ, which are not times; give the "
                      "rate of the files (--rate)");
}

bool FolderSource::next(TableRow& row) {
  if (next_ == files_.size()) return false;
  const FrameFile& file = files_[next_++];
  row.line = next_;
  row.complete = false;
  FileNumbers numbers;
  try {
    numbers = numbersOf(file.path);
    row.numCells = numbers.values.size();
    row.complete = numbers.shape == columns_[1].shape;
    row.fault = " (" + shortened(file.path.filename().string()) + ") has " +
                fileShapeText(numbers.shape) + (row.numCells == 1 ? " number" : " numbers") +
                " instead of " + fileShapeText(columns_[1].shape);
  } catch (const FormatError& error) {
    row.fault = std::string(": ") + error.what();
  }
  if (!row.complete) return true;
  if (numbers.isOpenEnded && numOpenEnded_++ == 0)
    firstOpenEnded_ = shortened(file.path.filename().string());
  const NameNumber number = file.numbers[varying_.value_or(0)];
  lastValues_.clear();
  lastTexts_.clear();
  row.states.clear();
  for (const std::size_t column : selected_) {
    if (column == 0) {
      lastValues_.push_back(static_cast<double>(number.first) + number.second);
      row.states.push_back(CellState::kNumber);
      continue;
    }
    for (const auto& [place, text] : numbers.texts) lastTexts_[lastValues_.size() + place] = text;
    lastValues_.insert(lastValues_.end(), numbers.values.begin(), numbers.values.end());
    row.states.insert(row.states.end(), numbers.states.begin(), numbers.states.end());
  }
  for (std::size_t i = 0; i < lastValues_.size(); ++i)
    if (row.states[i] == CellState::kNumber && !fitsFloat(lastValues_[i]))
      row.states[i] = CellState::kNotFinite;
  row.values = lastValues_;
  row.time = {};
  if (time_ == 0u) {
    row.time = {.state = CellState::kNumber,
                .number = static_cast<double>(number.first) + number.second};
    if (number.second == 0.0) row.time.whole = number.first;
  }
  return true;
}

double FolderSource::fraction() const noexcept {
  return static_cast<double>(next_) / static_cast<double>(files_.size());
}

std::string FolderSource::textOf(std::size_t index) const {
  const auto text = lastTexts_.find(index);
  return text != lastTexts_.end() ? text->second : numberText(lastValues_.at(index));
}

// The values of the array are numbered as in the file, from 1.
std::string FolderSource::placeOf(std::size_t index) const {
  std::size_t within = index;
  for (const std::size_t column : selected_) {
    if (within < columns_[column].width())
      return (column == 0 ? "file" : "number " + std::to_string(within + 1)) + ": " + textOf(index);
    within -= columns_[column].width();
  }
  return "a value";
}

std::vector<fs::path> filesPerMatrix(const fs::path& folder) {
  std::error_code failure;
  for (const char* ending : kEndings) {
    std::vector<fs::path> files;
    std::size_t numNumbered = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
      if (endingOf(entry.path()) != ending) continue;
      files.push_back(entry.path());
      const std::string stem = entry.path().stem().string();
      numNumbered += stem.find_first_of("0123456789") != std::string::npos ? 1 : 0;
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
