#include "recording/import/import_rows.h"

#include <algorithm>
#include <cmath>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"

#include "recording/import/cell_text.h"

namespace palpate {
namespace {

constexpr std::uint64_t kRowsPerReport = 256;

}  // namespace

ImportRows::ImportRows(const HandDescription& hand,
                       const ImportMapping& mapping,
                       const ImportPlan& plan,
                       bool strict,
                       ImportSink sink)
    : hand_(hand),
      mapping_(mapping),
      plan_(plan),
      strict_(strict),
      sink_(std::move(sink)),
      frame_(hand.layout) {
  report_.notes = plan.notes;
}

std::vector<ImportRows::Pass> ImportRows::passes() const {
  std::vector<Pass> passes;
  for (const PlannedSeries& series : plan_.series) {
    const auto same = std::find_if(passes.begin(), passes.end(), [&](const Pass& pass) {
      return pass.series.front()->file == series.file && pass.time == series.time;
    });
    if (same != passes.end())
      same->series.push_back(&series);
    else
      passes.push_back({{&series}, series.time, series.timeUnit});
  }
  return passes;
}

void ImportRows::run(TableSource& source, std::uint64_t mostRows, const Progress& progress) {
  const std::vector<Pass> all = passes();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto part = [&](double fraction) {
      return !progress ||
             progress((static_cast<double>(i) + fraction) / static_cast<double>(all.size()));
    };
    lastUs_.reset();
    rowIndex_ = 0;
    if (all[i].series.front()->file != source.path()) {
      const auto beside = openTable(all[i].series.front()->file, mapping_.text);
      runPass(*beside, all[i], mostRows, part);
    } else if (plan_.isTaxelList) {
      runTaxelList(source, all[i], mostRows, part);
    } else {
      runPass(source, all[i], mostRows, part);
    }
    report_.counterRestarts += timeReader_ ? timeReader_->numRestarts() : 0;
  }
  if (report_.frames > 1) {
    report_.durationS = static_cast<double>(lastFrameUs_ - *firstUs_) / kUsPerS;
    report_.meanRateHz = static_cast<double>(report_.frames - 1) / report_.durationS;
  }
}

void ImportRows::refuse(const TableSource& source,
                        const TableRow& row,
                        std::uint64_t& counter,
                        const std::string& what) {
  const std::string text = source.rowWord() + (" " + std::to_string(row.line)) + what;
  if (strict_) throw FormatError(source.path(), text);
  if (report_.refused.first.empty()) report_.refused.first = text;
  ++counter;
}

// The time of a row; nothing when it was refused.
std::optional<std::int64_t> ImportRows::timeOf(const TableSource& source, const TableRow& row) {
  std::optional<std::int64_t> us;
  if (!timeReader_) {
    const double elapsed = static_cast<double>(rowIndex_) / *mapping_.time.rateHz * kUsPerS;
    us = mapping_.time.startUs.value_or(0) + std::llround(elapsed);
  } else {
    us = timeReader_->us(row.time);
  }
  if (!us) {
    RefusedRows& refused = report_.refused;
    if (row.time.state == CellState::kEmpty)
      refuse(source, row, refused.missing, ": the time is missing");
    else if (row.time.state == CellState::kNotFinite || isNotFiniteWord(row.time.text))
      refuse(source, row, refused.notFinite, ": the time is not finite");
    else
      refuse(source,
             row,
             refused.text,
             ": " + inQuotes(row.time.text) + " is not a time" +
                 (cellNumber(row.time.text, ',') ? " (a decimal comma?)" : ""));
    return std::nullopt;
  }
  if (lastUs_ && *us <= *lastUs_) {
    const std::string early = row.time.text.empty() ? utcText(*us) : std::string(row.time.text);
    refuse(source,
           row,
           report_.refused.notLater,
           ": the time " + early + " is not later than that of the row before");
    return std::nullopt;
  }
  return us;
}

// Whether the numbers of a series can be used, or it has none in this row (isThere).
bool ImportRows::examine(const TableSource& source,
                         const PlannedSeries& series,
                         const TableRow& row,
                         std::size_t begin,
                         bool& isThere) {
  std::size_t numbers = 0;
  std::size_t used = 0;
  std::optional<std::size_t> empty;
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    if (!series.values[i].target) continue;
    ++used;
    const std::size_t at = begin + i;
    const auto fail = [&](std::uint64_t& counter, const char* what) {
      refuse(source, row, counter, ", " + source.placeOf(at) + what);
      return false;
    };
    switch (row.states[at]) {
      case CellState::kNumber:
        ++numbers;
        if (!fitsFloat(row.values[at] * series.values[i].scale + series.values[i].offset))
          return fail(report_.refused.notFinite, ", too large");
        break;
      case CellState::kEmpty:
        if (!empty) empty = at;
        break;
      case CellState::kNotFinite:
        return fail(report_.refused.notFinite, ", not finite or too large");
      case CellState::kText:
        return fail(report_.refused.text, " is not a number");
    }
  }
  isThere = numbers > 0;
  if (numbers == 0 || numbers == used) return true;
  refuse(source, row, report_.refused.missing, ", " + source.placeOf(*empty));
  return false;
}

void ImportRows::addFrame(std::int64_t us) {
  frame_.hostUs = us;
  if (gaps_.afterGap(us)) {
    ++report_.gaps;
    report_.longestGapS =
        std::max(report_.longestGapS, static_cast<double>(us - lastFrameUs_) / kUsPerS);
  }
  if (!firstUs_) firstUs_ = us;
  lastFrameUs_ = us;
  ++report_.frames;
  if (sink_.frame) sink_.frame(frame_);
}

void ImportRows::add(const PlannedSeries& series,
                     std::int64_t us,
                     const TableRow& row,
                     std::size_t begin) {
  const auto valueAt = [&](std::size_t i) {
    return row.values[begin + i] * series.values[i].scale + series.values[i].offset;
  };
  if (series.kind == PlannedSeries::Kind::kFrames) {
    const SensorLayout& layout = *hand_.layout;
    std::fill(frame_.values.begin(), frame_.values.end(), 0.0F);
    for (std::size_t i = 0; i < series.values.size(); ++i)
      if (series.values[i].target)
        frame_.values[*series.values[i].target] = static_cast<float>(valueAt(i));
    // Places without a taxel hold 0.
    for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
      const Mask& mask = layout.matrix(m).staticMask;
      for (std::size_t k = 0; k < mask.size(); ++k)
        if (mask[k] == 0) frame_.values[layout.offset(m) + k] = 0.0F;
    }
    return addFrame(us);
  }
  const bool isAngles = series.kind == PlannedSeries::Kind::kAngles;
  sample_.assign(isAngles ? hand_.axes.size() : hand_.temperatureSensors.size(), 0.0);
  for (std::size_t i = 0; i < series.values.size(); ++i)
    if (series.values[i].target) sample_[*series.values[i].target] = valueAt(i);
  ++(isAngles ? report_.angles : report_.temperatures);
  if (isAngles && sink_.angles) sink_.angles({us, sample_});
  if (!isAngles && sink_.temperatures) sink_.temperatures({us, sample_});
}

// False when the row was refused.
bool ImportRows::takeRow(TableSource& source, const Pass& pass, const TableRow& row) {
  if (!row.complete) {
    refuse(source,
           row,
           report_.refused.wrongCount,
           " has " + counted(row.numCells, "cell") + " instead of " +
               std::to_string(source.columns().size()));
    return false;
  }
  const auto us = timeOf(source, row);
  if (!us) return false;
  std::vector<std::size_t> there;
  std::vector<std::size_t> begins;
  std::size_t begin = 0;
  for (std::size_t s = 0; s < pass.series.size(); ++s) {
    bool isThere = false;
    if (!examine(source, *pass.series[s], row, begin, isThere)) return false;
    if (isThere) there.push_back(s);
    begins.push_back(begin);
    begin += pass.series[s]->values.size();
  }
  lastUs_ = us;
  for (const std::size_t s : there) add(*pass.series[s], *us, row, begins[s]);
  return true;
}

void ImportRows::runPass(TableSource& source,
                         const Pass& pass,
                         std::uint64_t mostRows,
                         const Progress& progress) {
  std::vector<std::size_t> columns;
  for (const PlannedSeries* series : pass.series)
    columns.insert(columns.end(), series->columns.begin(), series->columns.end());
  timeReader_.reset();
  if (pass.time) timeReader_.emplace(pass.timeUnit, mapping_.time.startUs, mapping_.text.decimal);
  source.start(columns, pass.time);
  const bool hasFrames = pass.series.front()->kind == PlannedSeries::Kind::kFrames;
  TableRow row;
  for (; rowIndex_ < mostRows && source.next(row); ++rowIndex_) {
    if (progress && rowIndex_ % kRowsPerReport == 0 && !progress(source.fraction()))
      throw Cancelled();
    if (hasFrames) ++report_.rows;
    takeRow(source, pass, row);
  }
  if (rowIndex_ == mostRows && source.next(row)) atEnd_ = false;
}

void ImportRows::finishListedFrame() {
  if (!listedFrame_) return;
  addFrame(listedUs_);
  std::fill(frame_.values.begin(), frame_.values.end(), 0.0F);
}

// Counts the frames that the list leaves out. A row that is refused lists its frame, too.
void ImportRows::countAbsent(const TableRow& row) {
  if (row.states[0] != CellState::kNumber || !(row.values[0] < 1e15)) return;
  const auto number = static_cast<std::int64_t>(std::floor(row.values[0]));
  if (number <= lastNumber_) return;
  report_.absentFrames += static_cast<std::uint64_t>(number - lastNumber_ - 1);
  lastNumber_ = number;
}

// A row `frame,time_ms,matrix,y,x,value`.
void ImportRows::takeTaxel(const TableSource& source, const TableRow& row, std::int64_t us) {
  const auto whole = [&](std::size_t at) {
    const double value = row.values[at];
    if (value != std::floor(value) || value < 0.0 || value > 1e15)
      throw FormatError(source.path(),
                        "line " + std::to_string(row.line) + ", " + source.placeOf(at) +
                            " is not a whole number");
    return static_cast<std::int64_t>(value);
  };
  const std::int64_t frame = whole(0);
  if (frame != listedFrame_) {
    finishListedFrame();
    listedFrame_ = frame;
    listedUs_ = us;
    lastUs_ = us;
  }
  const SensorLayout& layout = *hand_.layout;
  const auto m = static_cast<std::size_t>(whole(1));
  const std::int64_t y = whole(2);
  const std::int64_t x = whole(3);
  if (m >= layout.numMatrices() || y >= layout.matrix(m).rows || x >= layout.matrix(m).columns)
    throw FormatError(source.path(),
                      "line " + std::to_string(row.line) + ": matrix " + std::to_string(m) +
                          ", row " + std::to_string(y) + ", column " + std::to_string(x) +
                          " is outside of the hand, which has " + shapeText(layout));
  frame_.values[layout.offset(m) + static_cast<std::size_t>(y * layout.matrix(m).columns + x)] =
      static_cast<float>(row.values[4]);
}

void ImportRows::runTaxelList(TableSource& source,
                              const Pass& pass,
                              std::uint64_t mostRows,
                              const Progress& progress) {
  timeReader_.emplace(pass.timeUnit, mapping_.time.startUs, mapping_.text.decimal);
  source.start(pass.series.front()->columns, pass.time);
  PlannedSeries all = *pass.series.front();
  for (PlannedValue& value : all.values) value.target = 0;  // each number is needed
  TableRow row;
  for (; rowIndex_ < mostRows && source.next(row); ++rowIndex_) {
    if (progress && rowIndex_ % kRowsPerReport == 0 && !progress(source.fraction()))
      throw Cancelled();
    ++report_.rows;
    bool isThere = false;
    if (!row.complete) {
      refuse(source,
             row,
             report_.refused.wrongCount,
             " has " + counted(row.numCells, "cell") + " instead of " +
                 std::to_string(source.columns().size()));
      continue;
    }
    countAbsent(row);
    if (!examine(source, all, row, 0, isThere) || !isThere) continue;
    // The rows of one frame have one time.
    const bool sameFrame = listedFrame_ && row.values[0] == static_cast<double>(*listedFrame_);
    std::optional<std::int64_t> us = listedUs_;
    if (listedFrame_ && row.values[0] < static_cast<double>(*listedFrame_)) {
      refuse(source, row, report_.refused.notLater, ": the number of the frame falls");
      continue;
    }
    if (!sameFrame) us = timeOf(source, row);
    if (us) takeTaxel(source, row, *us);
  }
  finishListedFrame();
  if (rowIndex_ == mostRows && source.next(row)) atEnd_ = false;
}

}  // namespace palpate
