#include "palpate/signals/characteristic_signals.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"
#include "palpate/filter/gaussian.h"

namespace palpate {
namespace {

// Sums over the active taxels; several matrices can be added before the means are computed.
struct ActiveTaxels {
  double sum = 0.0;
  double minimum = 0.0;
  double maximum = 0.0;
  int count = 0;

  void add(const Eigen::Ref<const MatrixValues>& values) {
    for (Eigen::Index y = 0; y < values.rows(); ++y) {
      for (Eigen::Index x = 0; x < values.cols(); ++x) {
        const double value = static_cast<double>(values(y, x));
        if (!(value > 0.0)) continue;
        minimum = count == 0 ? value : std::min(minimum, value);
        maximum = std::max(maximum, value);
        sum += value;
        ++count;
      }
    }
  }
  void add(const ActiveTaxels& other) {
    if (other.count == 0) return;
    minimum = count == 0 ? other.minimum : std::min(minimum, other.minimum);
    maximum = std::max(maximum, other.maximum);
    sum += other.sum;
    count += other.count;
  }
  double mean() const { return count == 0 ? 0.0 : sum / count; }
};

CharacteristicSignals signalsFrom(const ActiveTaxels& raw,
                                  const ActiveTaxels& filtered,
                                  double areaMm2) {
  return {raw.mean(), filtered.mean(), raw.minimum, raw.maximum, raw.sum, raw.count, areaMm2};
}

// Adds the Gaussian-filtered matrix. An unloaded matrix stays unloaded and is skipped, which saves
// most of the work.
void addFiltered(ActiveTaxels& filtered,
                 const Eigen::Ref<const MatrixValues>& values,
                 const MatrixLayout& layout,
                 int active) {
  if (active > 0) filtered.add(gaussianFiltered(values, layout));
}

}  // namespace

CharacteristicSignals characteristicSignals(const Eigen::Ref<const MatrixValues>& values,
                                            const MatrixLayout& layout) {
  ActiveTaxels raw;
  ActiveTaxels filtered;
  raw.add(values);
  addFiltered(filtered, values, layout, raw.count);
  return signalsFrom(raw, filtered, raw.count * layout.taxelAreaMm2());
}

std::vector<CharacteristicSignals> characteristicSignals(const TactileFrame& frame) {
  std::vector<CharacteristicSignals> signals;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m)
    signals.push_back(characteristicSignals(frame.matrix(m), frame.layout->matrix(m)));
  return signals;
}

CharacteristicSignals wholeFrameSignals(const TactileFrame& frame) {
  ActiveTaxels raw;
  ActiveTaxels filtered;
  double areaMm2 = 0.0;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m) {
    const MatrixLayout& layout = frame.layout->matrix(m);
    const int before = raw.count;
    raw.add(frame.matrix(m));
    const int active = raw.count - before;
    addFiltered(filtered, frame.matrix(m), layout, active);
    areaMm2 += active * layout.taxelAreaMm2();
  }
  return signalsFrom(raw, filtered, areaMm2);
}

bool isSaturated(std::span<const CharacteristicSignals> rows, const HandDescription& hand) {
  const std::size_t matrices = std::min(rows.size(), hand.layout->numMatrices());
  for (std::size_t m = 0; m < matrices; ++m)
    if (rows[m].maximum >= static_cast<double>(hand.saturationOf(m))) return true;
  return false;
}

void allSignals(const TactileFrame& frame, std::vector<CharacteristicSignals>& rows) {
  rows.clear();
  ActiveTaxels wholeRaw;
  ActiveTaxels wholeFiltered;
  double wholeAreaMm2 = 0.0;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m) {
    const MatrixLayout& layout = frame.layout->matrix(m);
    ActiveTaxels raw;
    ActiveTaxels filtered;
    raw.add(frame.matrix(m));
    addFiltered(filtered, frame.matrix(m), layout, raw.count);
    rows.push_back(signalsFrom(raw, filtered, raw.count * layout.taxelAreaMm2()));
    wholeRaw.add(raw);
    wholeFiltered.add(filtered);
    wholeAreaMm2 += rows.back().areaMm2;
  }
  rows.push_back(signalsFrom(wholeRaw, wholeFiltered, wholeAreaMm2));
}

double valueOf(const CharacteristicSignals& values, SignalKind which) {
  switch (which) {
    case SignalKind::kFilteredMean:
      return values.filteredMean;
    case SignalKind::kMaximum:
      return values.maximum;
    case SignalKind::kMinimum:
      return values.minimum;
    case SignalKind::kSum:
      return values.sum;
    case SignalKind::kActive:
      return values.active;
    case SignalKind::kArea:
      return values.areaMm2;
    case SignalKind::kMean:
      break;
  }
  return values.mean;
}

std::string_view signalName(SignalKind kind) {
  switch (kind) {
    case SignalKind::kFilteredMean:
      return "filtered_mean";
    case SignalKind::kMaximum:
      return "max";
    case SignalKind::kMinimum:
      return "min";
    case SignalKind::kSum:
      return "sum";
    case SignalKind::kActive:
      return "active";
    case SignalKind::kArea:
      return "area_mm2";
    case SignalKind::kMean:
      break;
  }
  return "mean";
}

std::optional<SignalKind> signalKindNamed(std::string_view name) {
  for (const SignalKind kind : kAllSignalKinds)
    if (name == signalName(kind)) return kind;
  return std::nullopt;
}

SignalTable::SignalTable(std::size_t numMatrices, std::vector<CharacteristicSignals> rows)
    : numMatrices_(numMatrices), rows_(std::move(rows)) {
  if (numMatrices_ == 0 ? !rows_.empty() : rows_.size() % numMatrices_ != 0)
    throw std::invalid_argument("SignalTable: " + std::to_string(rows_.size()) + " rows of " +
                                std::to_string(numMatrices_) + " matrices");
  numFrames_ = numMatrices_ == 0 ? 0 : rows_.size() / numMatrices_;
}

SignalTable SignalTable::of(const Profile& profile, const Progress& progress) {
  constexpr std::size_t kFramesPerReport = 256;
  SignalTable table;
  table.numFrames_ = profile.numFrames();
  table.numMatrices_ = profile.layout().numMatrices();
  table.rows_.reserve(table.numFrames_ * table.numMatrices_);
  TactileFrame frame;
  for (std::size_t i = 0; i < table.numFrames_; ++i) {
    reportProgress(progress, i, table.numFrames_, kFramesPerReport);
    profile.readFrame(i, frame);
    for (std::size_t m = 0; m < table.numMatrices_; ++m)
      table.rows_.push_back(characteristicSignals(frame.matrix(m), profile.layout().matrix(m)));
  }
  return table;
}

const CharacteristicSignals& SignalTable::at(std::size_t frame, std::size_t matrix) const {
  if (frame >= numFrames_ || matrix >= numMatrices_)
    throw std::out_of_range("SignalTable: no frame " + std::to_string(frame) + ", matrix " +
                            std::to_string(matrix));
  return rows_[frame * numMatrices_ + matrix];
}

std::size_t SignalTable::frameOfLargestSum() const {
  std::size_t best = 0;
  double largest = -1.0;
  for (std::size_t i = 0; i < numFrames_; ++i) {
    double sum = 0.0;
    for (std::size_t m = 0; m < numMatrices_; ++m) sum += rows_[i * numMatrices_ + m].sum;
    if (sum > largest) {
      largest = sum;
      best = i;
    }
  }
  return best;
}

TextTable signalTextTable(const TactileFrame& frame, const HandDescription& hand) {
  std::vector<CharacteristicSignals> rows = characteristicSignals(frame);
  rows.push_back(wholeFrameSignals(frame));
  std::vector<std::string> names;
  for (std::size_t m = 0; m + 1 < rows.size(); ++m) names.push_back(hand.matrixName(m));
  names.emplace_back("all");
  const std::size_t numRows = rows.size();
  return {.header = {"matrix",
                     "active",
                     "mean [counts]",
                     "filtered mean [counts]",
                     "max [counts]",
                     "min [counts]",
                     "sum [counts]",
                     "area [mm^2]"},
          .numRows = numRows,
          .row = [rows = std::move(rows), names = std::move(names)](std::size_t row) {
            const CharacteristicSignals& values = rows[row];
            return std::vector<std::string>{names[row],
                                            std::to_string(values.active),
                                            numberText(values.mean),
                                            numberText(values.filteredMean),
                                            numberText(values.maximum),
                                            numberText(values.minimum),
                                            numberText(values.sum),
                                            numberText(values.areaMm2)};
          }};
}

}  // namespace palpate
