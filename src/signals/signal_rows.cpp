#include "palpate/signals/signal_rows.h"

#include <stdexcept>
#include <utility>

#include "palpate/model/matrix_rows.h"
#include "palpate/model/timing.h"
#include "palpate/signals/centre_rows.h"
#include "palpate/signals/characteristic_signals.h"

namespace palpate {
namespace {

using SignalRow = MatrixRow<SignalValues>;

// The signals of the frames of a profile, filtered over time.
class SignalRun {
 public:
  SignalRun(const Profile& profile, const SignalRowsOptions& options, Progress progress)
      : profile_(profile),
        ofHand_(options.ofHand),
        first_(ofHand_ ? profile.layout().numMatrices()
                       : static_cast<std::size_t>(options.matrix.value_or(0))),
        last_(ofHand_ || options.matrix ? first_ + 1 : profile.layout().numMatrices()),
        progress_(std::move(progress)),
        isSmoothed_(!options.smooth.empty()),
        filter_(
            options.smooth,
            profile.layout().numMatrices() + (ofHand_ ? 1 : 0),
            [this](auto timeUs, auto signals) {
              for (std::size_t m = first_; m < last_; ++m) add(timeUs, m, signals[m]);
              ++written_;
            },
            profile.givesReadings()) {}

  // Appends what the next frame gives; false after the last one.
  bool next(std::vector<SignalRow>& rows) {
    rows_ = &rows;
    if (frame_ == profile_.numFrames()) {
      filter_.finish();
      return false;
    }
    reportProgress(progress_, frame_, profile_.numFrames());
    profile_.readFrame(frame_++, values_);
    if (ofHand_)
      allSignals(values_, signals_);
    else
      signals_ = characteristicSignals(values_);
    if (isSmoothed_) {
      filter_.push(values_.hostUs, signals_);
      return true;
    }
    for (std::size_t m = first_; m < last_; ++m) {
      SignalValues row{};
      for (const SignalKind kind : signalKinds(profile_.givesReadings()))
        row[static_cast<std::size_t>(kind)] = valueOf(signals_[m], kind);
      add(values_.hostUs, m, row);
    }
    ++written_;
    return true;
  }

 private:
  void add(std::int64_t timeUs, std::size_t matrix, const SignalValues& values) {
    rows_->push_back({written_, timeUs, matrix, values});
  }

  const Profile profile_;
  const bool ofHand_;
  const std::size_t first_, last_;
  const Progress progress_;
  const bool isSmoothed_;
  SignalFilter filter_;
  TactileFrame values_;
  std::vector<CharacteristicSignals> signals_;
  std::vector<SignalRow>* rows_ = nullptr;
  std::size_t frame_ = 0, written_ = 0;
};

ColumnOf<SignalValues> signal(SignalKind kind, const std::string& unit, const char* meaning) {
  return {{std::string(signalName(kind)), CellKind::kNumber, unit, meaning},
          [at = static_cast<std::size_t>(kind)](const SignalValues& row) { return Cell(row[at]); }};
}

// A whole number, until it is filtered over time.
ColumnOf<SignalValues> activeColumn(bool isSmoothed) {
  ColumnOf<SignalValues> column = signal(SignalKind::kActive, "taxels", "touched taxels");
  if (isSmoothed) return column;
  return columnOf<SignalValues>(
      column.column.name, column.column.unit, column.column.meaning, [](const SignalValues& row) {
        return static_cast<std::int64_t>(row[static_cast<std::size_t>(SignalKind::kActive)]);
      });
}

}  // namespace

std::vector<ColumnOf<SignalValues>> signalColumns(const std::string& unit,
                                                  bool withComponents,
                                                  bool isSmoothed) {
  std::vector<ColumnOf<SignalValues>> columns = {
      signal(SignalKind::kMean, unit, "mean of the touched taxels"),
      signal(SignalKind::kFilteredMean,
             unit,
             "mean of the touched taxels of the matrix after a 3 x 3 Gaussian filter"),
      signal(SignalKind::kMinimum, unit, "minimum of the touched taxels"),
      signal(SignalKind::kMaximum, unit, "maximum"),
      signal(SignalKind::kSum, unit, "sum"),
      activeColumn(isSmoothed),
      signal(SignalKind::kArea, "mm^2", "their area")};
  if (!withComponents) return columns;
  const char* const meaning = "sum of the readings over the baseline, along the surface";
  columns.push_back(signal(SignalKind::kX, unit, meaning));
  columns.push_back(signal(SignalKind::kY, unit, meaning));
  columns.push_back(
      signal(SignalKind::kZ, unit, "sum of the readings over the baseline, into the surface"));
  columns.push_back(signal(SignalKind::kNorm, unit, "length of x, y, z"));
  return columns;
}

std::unique_ptr<ResultTable> signalTable(const Profile& profile,
                                         const SignalRowsOptions& options,
                                         const Progress& progress) {
  const auto numMatrices = static_cast<std::int64_t>(profile.layout().numMatrices());
  if (options.matrix && (*options.matrix < 0 || *options.matrix >= numMatrices))
    throw std::invalid_argument("signalTable: there is no matrix " +
                                std::to_string(*options.matrix) + ", only 0.." +
                                std::to_string(numMatrices - 1));
  if (options.centres) return centreTable(profile, options.matrix, progress);
  if (options.smooth.dependsOnRate()) options.smooth.validateForRate(timingOf(profile).rateHz);
  return std::make_unique<RowTable<SignalRow>>(
      "signals",
      matrixRowColumns(signalColumns(profile.hand().unit,
                                     profile.givesReadings() && !options.ofHand,
                                     !options.smooth.empty())),
      [run = std::make_shared<SignalRun>(profile, options, progress)](
          std::vector<SignalRow>& rows) { return run->next(rows); });
}

}  // namespace palpate
