#include "palpate/signals/characteristic_signals.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"
#include "palpate/filter/gaussian.h"
#include "palpate/model/touch.h"

namespace palpate {
namespace {

// Part of the largest filtered value of a matrix from which on a taxel holds a value: what a Kalman
// filter leaves of a load after a second is less.
constexpr float kHeldPart = 0.01F;

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
        if (!isTouched(value)) continue;
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

// The taxels of one or several matrices, from which the signals are computed.
struct SignalTaxels {
  ActiveTaxels active;
  ActiveTaxels averaged;  // those of the mean
  ActiveTaxels filtered;  // after the Gaussian filter
  double areaMm2 = 0.0;

  void add(const SignalTaxels& other) {
    active.add(other.active);
    averaged.add(other.averaged);
    filtered.add(other.filtered);
    areaMm2 += other.areaMm2;
  }
  CharacteristicSignals signals() const {
    return {averaged.mean(),
            filtered.mean(),
            active.minimum,
            active.maximum,
            active.sum,
            active.count,
            areaMm2,
            {}};
  }
};

// `averaged`: the values of the mean and the filtered mean. An unloaded matrix stays unloaded and
// is skipped, which saves most of the work.
SignalTaxels taxelsOf(const Eigen::Ref<const MatrixValues>& values,
                      const Eigen::Ref<const MatrixValues>& averaged,
                      const MatrixLayout& layout) {
  SignalTaxels taxels;
  taxels.active.add(values);
  taxels.areaMm2 = taxels.active.count * layout.taxelAreaMm2();
  if (taxels.active.count == 0) return taxels;
  taxels.averaged.add(averaged);
  taxels.filtered.add(gaussianFiltered(averaged, layout));
  return taxels;
}

// The values of filters over time lag: when a contact ends, its taxels leave one after the other
// and still hold values. A mean over those that are left, the strong ones, would exceed everything
// that was measured; so the others count as long as they hold a part of the largest value.
SignalTaxels taxelsOf(const TactileFrame& frame, std::size_t matrix) {
  const MatrixLayout& layout = frame.layout->matrix(matrix);
  const ConstMatrixMap values = frame.matrix(matrix);
  if (frame.filtered.empty()) return taxelsOf(values, values, layout);
  const ConstMatrixMap all = frame.allValues(matrix);
  const float held = kHeldPart * all.maxCoeff();
  const MatrixValues averaged =
      (areTouched(values.array()) || all.array() > held).select(all, 0.0F);
  return taxelsOf(values, averaged, layout);
}

std::array<double, 3> forceNotKnown() {
  constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
  return {kNotKnown, kNotKnown, kNotKnown};
}

std::array<double, 3> forceOn(const TactileFrame& frame, std::size_t matrix) {
  if (!frame.layout->decidesTouch()) return {};
  if (frame.readings.empty()) return forceNotKnown();
  std::array<double, 3> sum = {};
  const MatrixLayout& layout = frame.layout->matrix(matrix);
  for (int y = 0; y < layout.rows; ++y)
    for (int x = 0; x < layout.columns; ++x) {
      if (!layout.enabled(y, x)) continue;
      const std::array<float, 3> force = forceAt(frame, {matrix, y, x});
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += static_cast<double>(force[i]);
    }
  return sum;
}

CharacteristicSignals signalsOf(const SignalTaxels& taxels,
                                const TactileFrame& frame,
                                std::size_t matrix) {
  CharacteristicSignals signals = taxels.signals();
  signals.force = forceOn(frame, matrix);
  return signals;
}

CharacteristicSignals signalsOfWhole(const SignalTaxels& taxels, const TactileFrame& frame) {
  CharacteristicSignals signals = taxels.signals();
  if (frame.layout->decidesTouch()) signals.force = forceNotKnown();
  return signals;
}

}  // namespace

std::span<const SignalKind> signalKinds(bool withComponents) noexcept {
  static constexpr auto kKinds = [] {
    std::array<SignalKind, static_cast<std::size_t>(SignalKind::kNorm) + 1> kinds{};
    for (std::size_t i = 0; i < kinds.size(); ++i) kinds[i] = static_cast<SignalKind>(i);
    return kinds;
  }();
  return std::span(kKinds).first(withComponents ? kKinds.size() : kAllSignalKinds.size());
}

CharacteristicSignals characteristicSignals(const Eigen::Ref<const MatrixValues>& values,
                                            const MatrixLayout& layout) {
  return taxelsOf(values, values, layout).signals();
}

CharacteristicSignals characteristicSignals(const TactileFrame& frame, std::size_t matrix) {
  return signalsOf(taxelsOf(frame, matrix), frame, matrix);
}

std::vector<CharacteristicSignals> characteristicSignals(const TactileFrame& frame) {
  std::vector<CharacteristicSignals> signals;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m)
    signals.push_back(characteristicSignals(frame, m));
  return signals;
}

CharacteristicSignals wholeFrameSignals(const TactileFrame& frame) {
  SignalTaxels whole;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m) whole.add(taxelsOf(frame, m));
  return signalsOfWhole(whole, frame);
}

bool isSaturated(std::span<const CharacteristicSignals> rows, const HandDescription& hand) {
  const std::size_t matrices = std::min(rows.size(), hand.layout->numMatrices());
  for (std::size_t m = 0; m < matrices; ++m)
    if (rows[m].maximum >= static_cast<double>(hand.saturationOf(m))) return true;
  return false;
}

void allSignals(const TactileFrame& frame, std::vector<CharacteristicSignals>& rows) {
  rows.clear();
  SignalTaxels whole;
  for (std::size_t m = 0; m < frame.layout->numMatrices(); ++m) {
    const SignalTaxels taxels = taxelsOf(frame, m);
    rows.push_back(signalsOf(taxels, frame, m));
    whole.add(taxels);
  }
  rows.push_back(signalsOfWhole(whole, frame));
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
    case SignalKind::kX:
      return values.force[0];
    case SignalKind::kY:
      return values.force[1];
    case SignalKind::kZ:
      return values.force[2];
    case SignalKind::kNorm:
      return Eigen::Map<const Eigen::Vector3d>(values.force.data()).norm();
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
    case SignalKind::kX:
      return "x";
    case SignalKind::kY:
      return "y";
    case SignalKind::kZ:
      return "z";
    case SignalKind::kNorm:
      return "norm";
    case SignalKind::kMean:
      break;
  }
  return "mean";
}

std::optional<SignalKind> signalKindNamed(std::string_view name) {
  for (const SignalKind kind : signalKinds(true))
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
      table.rows_.push_back(characteristicSignals(frame, m));
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
