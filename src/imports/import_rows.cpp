#include "imports/import_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/model/timing.h"

#include "imports/cell_text.h"
#include "imports/sorted_source.h"

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
  report_.doubts = plan.doubts;
  for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m) {
    const TouchRule& rule = hand.layout->matrix(m).touch;
    report_.outside.isSigned = report_.outside.isSigned || rule.isSigned;
    for (const std::uint8_t isTaxel : hand.layout->matrix(m).staticMask) {
      const auto components = static_cast<std::size_t>(rule.components);
      maximum_.insert(maximum_.end(), components, isTaxel != 0 ? hand.maximumOf(m) : -1.0F);
      minimum_.insert(minimum_.end(), components, rule.isSigned ? -hand.maximumOf(m) : 0.0F);
    }
  }
  for (const PlannedSeries& series : plan.series) {
    if (series.kind != PlannedSeries::Kind::kFurther) continue;
    further_[&series].index = report_.series.size();
    report_.series.emplace_back().description = series.further;
  }
}

std::vector<ImportRows::Pass> ImportRows::passes() const {
  std::vector<Pass> passes;
  for (const PlannedSeries& series : plan_.series) {
    if (series.table) {  // times of its own
      passes.push_back({{&series}});
      continue;
    }
    const auto same = std::find_if(passes.begin(), passes.end(), [&](const Pass& pass) {
      return !pass.first().table && pass.first().file == series.file &&
             pass.first().time == series.time && pass.first().timeWithin == series.timeWithin &&
             pass.first().timeFile == series.timeFile;
    });
    if (same != passes.end())
      same->series.push_back(&series);
    else
      passes.push_back({{&series}});
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
    rowUs_.reset();
    rowIndex_ = 0;
    skipped_ = 0;
    shiftUs_.reset();
    place_.clear();
    std::shared_ptr<TableSource> own = all[i].first().table;
    if (own) {
      place_ = shortened(own->path().filename().string()) + ", ";
      own = orderedTable(all[i].first(), mostRows);
      runPass(*own, all[i], mostRows, part);
      noteRows(*own, false);
    } else if (all[i].first().file != source.path()) {
      const auto beside = openTable(all[i].first().file, mapping_.text);
      runPass(*beside, all[i], mostRows, part);
    } else if (plan_.isTaxelList) {
      runTaxelList(source, all[i], mostRows, part);
    } else {
      runPass(source, all[i], mostRows, part);
    }
    report_.counterRestarts += timeReader_ ? timeReader_->numRestarts() : 0;
    if (all[i].first().kind != PlannedSeries::Kind::kFrames) continue;
    noteRows(source, true);
    if (timeReader_) frameShiftUs_ = timeReader_->shiftUs();
  }
  if (report_.outside.below > 0 && !report_.outside.isSigned)
    report_.notes.push_back(
        "values below 0: where readings have a sign, the matrix in hand.json needs \"signed\": "
        "true");
  finishSeries();
  noteOthers();
  countFirstGap();
  if (report_.frames > 1) {
    report_.durationS = static_cast<double>(lastFrameUs_ - *firstUs_) / kUsPerS;
    report_.meanRateHz = static_cast<double>(report_.frames - 1) / report_.durationS;
  }
}

void ImportRows::refuse(const TableSource& source,
                        const TableRow& row,
                        std::uint64_t& counter,
                        const std::string& what) {
  const std::string text = place_ + source.rowWord() + " " + std::to_string(row.line) + what;
  if (strict_) throw FormatError(source.path(), text);
  if (report_.refused.first.empty()) report_.refused.first = text;
  ++counter;
}

// What is known of the times and the end of a table when its rows were read.
void ImportRows::noteRows(const TableSource& source, bool areFrames) {
  if (areFrames && report_.frames == 1 && numFalling_ > 1 &&
      numFalling_ == report_.refused.notLater)
    throw FormatError(source.path(), "time: it descends from row to row; sort the file by time");
  if (timeReader_ && timeReader_->assumedUtc())
    report_.notes.push_back("time: " + place_ + "the dates have no offset and are taken as UTC");
  if (const NulBytes found = source.nulBytes(); found.count > 0) {
    if (report_.nulBytes.count == 0) report_.nulBytes.line = found.line;
    report_.nulBytes.count += found.count;
  }
  if (strict_ && report_.nulBytes.count > 0) throw FormatError(source.path(), report_.nulText());
  const std::string end = atEnd_ ? source.endNote() : "";
  if (!end.empty()) report_.notes.push_back(place_ + end);
}

// What was read of the further series, and which of them have other times than the frames.
void ImportRows::finishSeries() {
  for (const auto& [series, further] : further_) {
    ImportedSeries& read = report_.series[further.index];
    if (read.samples > 1)
      read.meanRateHz = static_cast<double>(read.samples - 1) * kUsPerS /
                        static_cast<double>(further.lastUs - further.firstUs);
    if (read.samples == 0 || report_.frames == 0) continue;
    const bool isBefore = further.lastUs < *firstUs_;
    const std::int64_t apart =
        isBefore ? *firstUs_ - further.lastUs : further.firstUs - lastFrameUs_;
    if (apart > 0 && atEnd_)
      report_.doubts.push_back("series " + series->further.name + ": all of it is " +
                               fixedText(static_cast<double>(apart) / kUsPerS, 3) + " s " +
                               (isBefore ? "before the first frame" : "after the last frame"));
  }
}

// The table of a SeriesFile with its rows in order of time, and what has to be added to its times.
std::shared_ptr<TableSource> ImportRows::orderedTable(const PlannedSeries& series,
                                                      std::uint64_t mostRows) {
  if (!series.time) return series.table;
  TimeReader times(series.timeUnit, std::nullopt, mapping_.text.decimal, series.timeFactor);
  const TimesOfRows found = timesOfRows(*series.table, series, times, mostRows);
  if (found.leastUs) shiftUs_ = shiftOf(series, *found.leastUs);
  if (found.ascend) return series.table;
  report_.notes.push_back("series " + series.further.name +
                          ": the rows are not in order of time; they are sorted");
  return std::make_shared<SortedSource>(series.table, series, times, mostRows);
}

// Times since 1970 are taken as they are where those of the frames are, too, and so are times that
// count from a beginning. Of one of each only the beginning can be the same.
std::int64_t ImportRows::shiftOf(const PlannedSeries& series, std::int64_t firstUs) {
  constexpr std::int64_t kYear2000Us = 946'684'800'000'000;
  const std::string name = "series " + series.further.name + ": ";
  const std::int64_t framesUs = firstUs_.value_or(0);
  const std::int64_t ofCount = frameShiftUs_.value_or(mapping_.time.startUs.value_or(0));
  const bool areDates = firstUs >= kYear2000Us;
  const bool wereDates = frameShiftUs_ && framesUs - *frameShiftUs_ >= kYear2000Us;
  if (areDates ? framesUs >= kYear2000Us : !wereDates) {
    report_.notes.push_back(name + (areDates ? "its times are dates, as those of the frames"
                                             : "its times are taken to count from the same "
                                               "beginning as those of the frames"));
    return areDates && !wereDates ? 0 : ofCount;
  }
  report_.doubts.push_back(name +
                           (areDates ? "its times are dates, but those of the frames are not"
                                     : "its times are not dates, but those of the frames are") +
                           ": its first row is taken to be at the first frame");
  return framesUs - firstUs;
}

// The time of a row; nothing when it was refused.
std::optional<std::int64_t> ImportRows::timeOf(const TableSource& source, const TableRow& row) {
  std::optional<std::int64_t> us;
  if (!timeReader_) {
    const double elapsed =
        static_cast<double>(rowIndex_ + skipped_) / rateHz_.value_or(0.0) * kUsPerS;
    us = beginUs_ + std::llround(elapsed);
  } else {
    us = timeReader_->us(row.time);
  }
  if (!us) {
    RefusedRows& refused = report_.refused;
    if (row.time.state == CellState::kEmpty)
      refuse(source, row, refused.missing, ": the time is missing");
    else if (row.time.state == CellState::kNotFinite || notFiniteValue(row.time.text))
      refuse(source, row, refused.notFinite, ": the time is not finite");
    else if (const auto number = row.time.state == CellState::kNumber
                                     ? std::optional(row.time.number)
                                     : cellNumber(row.time.text, mapping_.text.decimal);
             number && !isDateUnit(timeUnit_))
      refuse(source,
             row,
             refused.text,
             ": the time " +
                 (row.time.text.empty() ? numberText(*number) : std::string(row.time.text)) +
                 " is too large for " + std::string(nameOf(timeUnit_)) + "; is it in " +
                 std::string(nameOf(guessTimeUnit(*number, true))) + " (--time-unit)?");
    else
      refuse(source,
             row,
             refused.text,
             ": " + inQuotes(row.time.text) + " is not a time" + commaHint(row.time.text));
    return std::nullopt;
  }
  const bool falls = *us < std::exchange(rowUs_, *us).value_or(*us);
  if (lastUs_ && *us <= *lastUs_) {
    numFalling_ += falls ? 1 : 0;
    const std::string early = row.time.text.empty() ? utcText(*us) : std::string(row.time.text);
    refuse(source,
           row,
           report_.refused.notLater,
           ": the time " + early + " is not later than that of the row before");
    return std::nullopt;
  }
  return us;
}

// Whether the numbers of a series can be used, or it has none in this row (isThere). Places without
// a taxel are not looked at.
bool ImportRows::examine(const TableSource& source,
                         const PlannedSeries& series,
                         const TableRow& row,
                         std::size_t begin,
                         bool& isThere) {
  if (series.kind == PlannedSeries::Kind::kFurther) return true;  // addFurther() looks at it
  const bool areTaxels = series.kind == PlannedSeries::Kind::kFrames && !plan_.isTaxelList;
  std::size_t numbers = 0;
  std::size_t used = 0;
  std::optional<std::size_t> empty;
  std::optional<std::size_t> notANumber;  // the first one
  std::size_t numNotANumber = 0;
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    const auto target = series.values[i].target;
    if (!target || (areTaxels && maximum_[*target] < 0.0F)) continue;
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
        if (!areTaxels || strict_ || !std::isnan(row.values[at]))
          return fail(report_.refused.notFinite, ", not finite or too large");
        ++numbers;
        notANumber = notANumber.value_or(at);
        ++numNotANumber;
        break;
      case CellState::kText:
        return fail(report_.refused.text, " is not a number");
    }
  }
  isThere = numbers > 0;
  if (isThere && numbers == numNotANumber) {
    refuse(source,
           row,
           report_.refused.notFinite,
           ", " + source.placeOf(*notANumber) + ", not finite");
    return false;
  }
  if (numbers == 0 || numbers == used) return true;
  refuse(source, row, report_.refused.missing, ", " + source.placeOf(*empty));
  return false;
}

// GapDetector knows no rate at the second frame: the first interval is judged by the next ones.
void ImportRows::countFirstGap() {
  const TimingReport timing = timingOf(firstStampsUs_);
  if (timing.gaps.empty() || timing.gaps.front().frame != 0) return;
  ++report_.gaps;
  report_.longestGapS = std::max(report_.longestGapS, timing.gaps.front().seconds);
}

void ImportRows::addFrame(std::int64_t us) {
  constexpr std::size_t kFirstStamps = 17;
  if (firstStampsUs_.size() < kFirstStamps) firstStampsUs_.push_back(us);
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

// The value of a taxel in a recording; counts values outside the hand's range.
float ImportRows::taxelValue(const TableSource& source,
                             const TableRow& row,
                             std::size_t place,
                             double value) {
  const auto taken = static_cast<float>(value);
  OutsideValues& outside = report_.outside;
  if (std::isnan(value))
    ++outside.notANumber;
  else if (taken < minimum_[place])
    ++outside.below;
  else if (taken > maximum_[place])
    ++outside.above;
  else
    return taken;
  if (outside.first.empty()) {
    std::size_t m = 0;
    while (place >= hand_.layout->readingOffset(m) + hand_.layout->matrix(m).numReadings()) ++m;
    const auto components = static_cast<std::size_t>(hand_.layout->matrix(m).touch.components);
    const std::size_t within = place - hand_.layout->readingOffset(m);
    const std::size_t cell = within / components;
    const auto width = static_cast<std::size_t>(hand_.layout->matrix(m).columns);
    const std::string component =
        components == 1 ? "" : std::string(", ") + "xyz"[within % components];
    outside.first = source.rowWord() + (" " + std::to_string(row.line)) + ", " +
                    hand_.matrixName(m) + ", row " + std::to_string(cell / width) + ", column " +
                    std::to_string(cell % width) + component + ": " + numberText(value) +
                    ", not in " + numberText(minimum_[place]) + ".." + numberText(maximum_[place]);
  }
  return std::isnan(value) ? 0.0F : taken;
}

void ImportRows::add(const TableSource& source,
                     const PlannedSeries& series,
                     std::int64_t us,
                     const TableRow& row,
                     std::size_t begin) {
  const auto valueAt = [&](std::size_t i) {
    return row.values[begin + i] * series.values[i].scale + series.values[i].offset;
  };
  if (series.kind == PlannedSeries::Kind::kFrames) {
    std::fill(frame_.stored().begin(), frame_.stored().end(), 0.0F);
    for (std::size_t i = 0; i < series.values.size(); ++i)
      if (const auto place = series.values[i].target; place && maximum_[*place] >= 0.0F)
        frame_.stored()[*place] = taxelValue(source, row, *place, valueAt(i));
    return addFrame(us);
  }
  if (series.kind == PlannedSeries::Kind::kFurther)
    return addFurther(source, series, us, row, begin);
  const bool isAngles = series.kind == PlannedSeries::Kind::kAngles;
  sample_.assign(isAngles ? hand_.axes.size() : hand_.temperatureSensors.size(), 0.0);
  for (std::size_t i = 0; i < series.values.size(); ++i)
    if (series.values[i].target) sample_[*series.values[i].target] = valueAt(i);
  ++(isAngles ? report_.angles : report_.temperatures);
  if (sink_.sample) sink_.sample({us, sample_, isAngles ? kAngleSeries : kTemperatureSeries});
}

// A number of a further series; NaN where there is none.
double ImportRows::furtherValue(const TableRow& row,
                                std::size_t at,
                                const PlannedValue& planned) const {
  const CellState state = row.states[at];
  const double value = row.values[at] * planned.scale + planned.offset;
  const bool isNumber = state == CellState::kNumber || state == CellState::kNotFinite;
  return isNumber && std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
}

// Adds a sample, if the row has a number of the series, and counts the cells that are none.
void ImportRows::addFurther(const TableSource& source,
                            const PlannedSeries& series,
                            std::int64_t us,
                            const TableRow& row,
                            std::size_t begin) {
  Further& further = further_.at(&series);
  ImportedSeries& read = report_.series[further.index];
  sample_.assign(series.further.columns.size(), 0.0);
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    if (!series.values[i].target) continue;
    const std::size_t at = begin + i;
    const double value = sample_[*series.values[i].target] =
        furtherValue(row, at, series.values[i]);
    const CellState state = row.states[at];
    if (!std::isnan(value) || state == CellState::kEmpty ||
        (state == CellState::kNotFinite && std::isnan(row.values[at])))
      continue;
    const std::string place =
        place_ + source.rowWord() + " " + std::to_string(row.line) + ", " + source.placeOf(at);
    if (strict_) throw FormatError(source.path(), place + " is not a number");
    if (report_.notNumbers.count++ == 0) report_.notNumbers.first = place;
  }
  if (std::all_of(sample_.begin(), sample_.end(), [](double value) { return std::isnan(value); }))
    return;
  if (read.samples++ == 0) further.firstUs = us;
  if (further.gaps.afterGap(us)) {
    ++read.gaps;
    read.longestGapS =
        std::max(read.longestGapS, static_cast<double>(us - further.lastUs) / kUsPerS);
  }
  further.lastUs = us;
  if (sink_.sample) sink_.sample({us, sample_, kHandSeries + further.index});
}

bool ImportRows::examineAll(const TableSource& source, const Pass& pass, const TableRow& row) {
  std::size_t begin = 0;
  isThere_.clear();
  for (const PlannedSeries* series : pass.series) {
    bool isThere = false;
    if (!examine(source, *series, row, begin, isThere)) return false;
    isThere_.push_back(isThere);
    begin += series->values.size();
  }
  return true;
}

void ImportRows::addAll(const TableSource& source,
                        const Pass& pass,
                        std::int64_t us,
                        const TableRow& row) {
  lastUs_ = us;
  if (timeReader_) timeReader_->keep();
  std::size_t begin = 0;
  for (std::size_t s = 0; s < pass.series.size(); ++s) {
    const bool isFurther = pass.series[s]->kind == PlannedSeries::Kind::kFurther;
    if (isThere_[s] || isFurther) add(source, *pass.series[s], us, row, begin);
    begin += pass.series[s]->values.size();
  }
}

// Whether the row waits for the next one, which tells whether a counter started again.
bool ImportRows::wait(const TableSource& source, const Pass& pass, const TableRow& row) {
  const auto whole = timeReader_ ? timeReader_->wholeOf(row.time) : std::nullopt;
  if (!whole || !timeReader_->mayRestart(*whole)) return false;
  if (examineAll(source, pass, row))
    waiting_ = WaitingRow{row, std::string(row.time.text), *whole, isThere_};
  return true;
}

// Takes or refuses the row that waits, by the time of the next row (null: there is none).
void ImportRows::finishWaiting(const TableSource& source, const Pass& pass, const TimeCell* next) {
  if (!waiting_) return;
  const auto nextWhole = next ? timeReader_->wholeOf(*next) : std::nullopt;
  if (next && !nextWhole) return;
  WaitingRow waited = *std::exchange(waiting_, std::nullopt);
  waited.row.time.text = waited.time;
  isThere_ = waited.isThere;
  if (nextWhole && TimeReader::goesOnFrom(waited.whole, *nextWhole)) timeReader_->restart();
  if (const auto us = timeOf(source, waited.row)) addAll(source, pass, *us, waited.row);
}

// Counts the frames that are missing before this row, by its number. A number that goes back, or
// further on than any loss, is another numbering.
void ImportRows::countMissing(const TableSource& source, const Pass& pass, const TableRow& row) {
  if (!pass.first().number) return;
  ++rowsSinceCount_;
  const std::size_t at = *pass.first().number;
  if (!row.complete || row.states[at] != CellState::kNumber) return;
  const double number = row.values[at];
  const double before = std::exchange(lastCount_, number).value_or(number);
  const double missing = number - before - static_cast<double>(std::exchange(rowsSinceCount_, 0));
  if (before == number || !(missing >= 1.0 && missing < kMaxMissingFrames)) return;
  const auto count = static_cast<std::uint64_t>(missing);
  skipped_ += count;
  report_.missingFrames += count;
  if (report_.firstMissing.empty())
    report_.firstMissing =
        counted(count, "frame") + " before " + source.rowWord() + " " + std::to_string(row.line);
}

// Whether a row is from another sensor or topic than the first one with values of its series.
bool ImportRows::isOfOther(const TableSource& source, const Pass& pass, const TableRow& row) {
  constexpr std::size_t kMaxOthers = 64;
  std::size_t begin = 0;
  for (const PlannedSeries* series : pass.series) {
    bool isThere = false;
    for (std::size_t i = 0; i < series->values.size() && !isThere; ++i)
      isThere = series->values[i].target && row.states[begin + i] != CellState::kEmpty;
    std::string from;
    for (const std::size_t origin : series->origins)
      from += (from.empty() ? "" : ", ") + source.textOf(begin + origin);
    begin += series->values.size();
    if (series->origins.empty() || !isThere) continue;
    const auto [origin, isFirst] = origins_.try_emplace(series, Origin{from, {}});
    if (isFirst || origin->second.taken == from) continue;
    if (strict_)
      throw FormatError(source.path(),
                        source.rowWord() + (" " + std::to_string(row.line)) + " is from " +
                            inQuotes(from) + ", others are from " + inQuotes(origin->second.taken));
    auto& others = origin->second.others;
    ++others[others.size() < kMaxOthers || others.contains(from) ? from : ".."];
    return true;
  }
  return false;
}

void ImportRows::noteOthers() {
  constexpr std::size_t kShown = 8;
  for (const auto& [series, origin] : origins_) {
    std::uint64_t rows = 0;
    std::string names;
    std::size_t shown = 0;
    for (const auto& [name, count] : origin.others) {
      rows += count;
      if (++shown <= kShown) names += (names.empty() ? "" : ", ") + inQuotes(name);
    }
    if (rows == 0) continue;
    report_.doubts.push_back(counted(rows, "row") + " from " + names +
                             (shown > kShown ? ", .." : "") + " left out: only " +
                             inQuotes(origin.taken) +
                             " is imported; save each of them in a separate file");
  }
}

void ImportRows::takeRow(TableSource& source, const Pass& pass, const TableRow& row) {
  if (row.complete && isOfOther(source, pass, row)) return;
  countMissing(source, pass, row);
  if (!row.complete) {
    refuse(source, row, report_.refused.wrongCount, row.fault);
    return;
  }
  finishWaiting(source, pass, &row.time);
  if (wait(source, pass, row)) return;
  const auto us = timeOf(source, row);
  if (us && examineAll(source, pass, row)) addAll(source, pass, *us, row);
}

void ImportRows::runPass(TableSource& source,
                         const Pass& pass,
                         std::uint64_t mostRows,
                         const Progress& progress) {
  std::vector<std::size_t> columns;
  for (const PlannedSeries* series : pass.series)
    columns.insert(columns.end(), series->columns.begin(), series->columns.end());
  timeReader_.reset();
  const PlannedSeries& first = pass.first();
  timeUnit_ = first.timeUnit;
  if (first.time)
    timeReader_.emplace(
        first.timeUnit, mapping_.time.startUs, mapping_.text.decimal, first.timeFactor);
  if (timeReader_ && shiftUs_) timeReader_->setShiftUs(*shiftUs_);
  rateHz_ = first.table ? first.rateHz : plan_.rateHz;
  beginUs_ = first.table ? firstUs_.value_or(0) : mapping_.time.startUs.value_or(0);
  const bool isApart = !first.timeFile.empty();
  const auto times = isApart ? openTable(first.timeFile, mapping_.text) : nullptr;
  if (times) times->start({}, first.time);
  source.start(columns, first.timeWithin || isApart ? std::nullopt : first.time);
  const bool hasFrames = first.kind == PlannedSeries::Kind::kFrames;
  TableRow row;
  TableRow timeRow;
  for (; rowIndex_ < mostRows && source.next(row); ++rowIndex_) {
    if (progress && rowIndex_ % kRowsPerReport == 0 && !progress(source.fraction()))
      throw Cancelled();
    if (hasFrames) ++report_.rows;
    findTimeWithin(first, row);
    if (times) row.time = times->next(timeRow) && timeRow.complete ? timeRow.time : TimeCell{};
    takeRow(source, pass, row);
  }
  finishWaiting(source, pass, nullptr);
  if (times && rowIndex_ < mostRows && times->next(timeRow))
    report_.notes.push_back("time: " + first.timeFile.filename().string() +
                            " has more times than " + source.path().filename().string() +
                            " has rows");
  if (rowIndex_ == mostRows && source.next(row)) atEnd_ = false;
}

void ImportRows::finishListedFrame() {
  if (!listedFrame_) return;
  addFrame(listedUs_);
  std::fill(frame_.stored().begin(), frame_.stored().end(), 0.0F);
}

// Counts the frames that the list leaves out. A row that is refused lists its frame, too.
void ImportRows::countAbsent(const TableRow& row) {
  if (row.states[0] != CellState::kNumber || !(std::abs(row.values[0]) < 1e15)) return;
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
    timeReader_->keep();
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
  const std::size_t place =
      layout.offset(m) + static_cast<std::size_t>(y * layout.matrix(m).columns + x);
  if (maximum_[place] >= 0.0F)
    frame_.stored()[place] = taxelValue(source, row, place, row.values[4]);
}

void ImportRows::runTaxelList(TableSource& source,
                              const Pass& pass,
                              std::uint64_t mostRows,
                              const Progress& progress) {
  timeReader_.emplace(pass.first().timeUnit, mapping_.time.startUs, mapping_.text.decimal);
  source.start(pass.first().columns, pass.first().time);
  PlannedSeries all = pass.first();
  for (PlannedValue& value : all.values) value.target = 0;  // each number is needed
  TableRow row;
  for (; rowIndex_ < mostRows && source.next(row); ++rowIndex_) {
    if (progress && rowIndex_ % kRowsPerReport == 0 && !progress(source.fraction()))
      throw Cancelled();
    ++report_.rows;
    bool isThere = false;
    if (!row.complete) {
      refuse(source, row, report_.refused.wrongCount, row.fault);
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
