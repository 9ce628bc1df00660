// Turns the rows of tables into the samples of a recording.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/imports/recording_import.h"
#include "palpate/model/gap_detector.h"
#include "palpate/model/series.h"
#include "palpate/model/tactile_frame.h"

namespace palpate {

// Receives the samples in order; functions may be empty.
struct ImportSink {
  std::function<void(const TactileFrame&)> frame;
  std::function<void(const Sample&)> sample;
};

class ImportRows {
 public:
  ImportRows(const HandDescription& hand,
             const ImportMapping& mapping,
             const ImportPlan& plan,
             bool strict,
             ImportSink sink);
  // Reads the table that was planned and those beside it; at most `mostRows` of each. Throws as
  // importRecording().
  void run(TableSource& source, std::uint64_t mostRows, const Progress& progress);
  const ImportReport& report() const noexcept { return report_; }
  // Whether all rows were read.
  bool atEnd() const noexcept { return atEnd_; }

 private:
  // Series that are read together: of one table, at the same times.
  struct Pass {
    std::vector<const PlannedSeries*> series;
    const PlannedSeries& first() const { return *series.front(); }
  };
  // A row with which a counter may have started again: the next one tells.
  struct WaitingRow {
    TableRow row;
    std::string time;
    std::int64_t whole = 0;
    std::vector<bool> isThere;  // the series
  };
  std::vector<Pass> passes() const;
  void runPass(TableSource& source,
               const Pass& pass,
               std::uint64_t mostRows,
               const Progress& progress);
  void runTaxelList(TableSource& source,
                    const Pass& pass,
                    std::uint64_t mostRows,
                    const Progress& progress);
  bool isOfOther(const TableSource& source, const Pass& pass, const TableRow& row);
  void noteOthers();
  void takeRow(TableSource& source, const Pass& pass, const TableRow& row);
  bool examineAll(const TableSource& source, const Pass& pass, const TableRow& row);
  void addAll(const TableSource& source, const Pass& pass, std::int64_t us, const TableRow& row);
  bool wait(const TableSource& source, const Pass& pass, const TableRow& row);
  void finishWaiting(const TableSource& source, const Pass& pass, const TimeCell* next);
  void noteRows(const TableSource& source, bool areFrames);
  std::shared_ptr<TableSource> orderedTable(const PlannedSeries& series, std::uint64_t mostRows);
  std::int64_t shiftOf(const PlannedSeries& series, std::int64_t firstUs);
  void finishSeries();
  double furtherValue(const TableRow& row, std::size_t at, const PlannedValue& planned) const;
  void addFurther(const TableSource& source,
                  const PlannedSeries& series,
                  std::int64_t us,
                  const TableRow& row,
                  std::size_t begin);
  void countMissing(const TableSource& source, const Pass& pass, const TableRow& row);
  void countFirstGap();
  std::optional<std::int64_t> timeOf(const TableSource& source, const TableRow& row);
  bool examine(const TableSource& source,
               const PlannedSeries& series,
               const TableRow& row,
               std::size_t begin,
               bool& isThere);
  void add(const TableSource& source,
           const PlannedSeries& series,
           std::int64_t us,
           const TableRow& row,
           std::size_t begin);
  float taxelValue(const TableSource& source, const TableRow& row, std::size_t place, double value);
  void addFrame(std::int64_t us);
  void countAbsent(const TableRow& row);
  void takeTaxel(const TableSource& source, const TableRow& row, std::int64_t us);
  void finishListedFrame();
  void refuse(const TableSource& source,
              const TableRow& row,
              std::uint64_t& counter,
              const std::string& what);

  const HandDescription& hand_;
  const ImportMapping& mapping_;
  const ImportPlan& plan_;
  bool strict_;
  ImportSink sink_;
  ImportReport report_;
  bool atEnd_ = true;
  TactileFrame frame_;
  // Of series whose rows say what they are from.
  struct Origin {
    std::string taken;                            // of the first row that has values
    std::map<std::string, std::uint64_t> others;  // rows that are left out
  };
  std::map<const PlannedSeries*, Origin> origins_;
  std::vector<float> maximum_;  // of each reading; below 0: it has no taxel
  std::vector<float> minimum_;  // below 0 where readings have a sign
  std::vector<double> sample_;
  GapDetector gaps_;
  std::vector<std::int64_t> firstStampsUs_;
  std::optional<std::int64_t> firstUs_;  // of the frames
  std::int64_t lastFrameUs_ = 0;
  std::optional<std::int64_t> frameShiftUs_;  // TimeReader::shiftUs() of the frames
  // Of a further series.
  struct Further {
    std::size_t index = 0;  // in report_.series
    GapDetector gaps;
    std::int64_t firstUs = 0;
    std::int64_t lastUs = 0;
  };
  std::map<const PlannedSeries*, Further> further_;
  // Of the pass that runs.
  std::string place_;                    // of its rows, in front of their lines
  std::optional<std::int64_t> shiftUs_;  // of the times of a SeriesFile
  std::optional<double> rateHz_;         // of rows without times, and when they begin
  std::int64_t beginUs_ = 0;
  std::optional<TimeReader> timeReader_;
  std::optional<std::int64_t> lastUs_;
  std::optional<WaitingRow> waiting_;
  std::vector<bool> isThere_;  // the series in the examined row
  std::uint64_t rowIndex_ = 0;
  std::uint64_t skipped_ = 0;  // rows that the file lacks
  TimeUnit timeUnit_ = TimeUnit::kSeconds;
  std::optional<std::int64_t> rowUs_;  // time of the row before, also of a refused one
  std::uint64_t numFalling_ = 0;       // refused rows whose time is before that of the row before
  std::optional<double> lastCount_;    // number of the last row that has one
  std::uint64_t rowsSinceCount_ = 0;
  // Of the frame of a list of taxels that is being read.
  std::optional<std::int64_t> listedFrame_;
  std::int64_t lastNumber_ = -1;  // of a listed frame, also of a refused one
  std::int64_t listedUs_ = 0;
};

}  // namespace palpate
