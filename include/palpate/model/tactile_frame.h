// A tactile frame: the values of all taxels at one instant. It is the unit of data that all modules
// exchange.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <palpate/model/matrix_layout.h>

namespace palpate {

struct Baseline;  // model/touch.h

// Values of one matrix: rows x columns, stored row by row as the sensor sends them. Row 0 is the
// fingertip.
using MatrixValues = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using MatrixMap = Eigen::Map<MatrixValues>;
using ConstMatrixMap = Eigen::Map<const MatrixValues>;

// Whether a taxel with this value is touched (active): what all code asks. Not a number: it isn't.
constexpr bool isTouched(float value) noexcept { return value > 0.0F; }
constexpr bool isTouched(double value) noexcept { return value > 0.0; }
// The same of each value of an Eigen array.
template <typename Derived>
auto areTouched(const Eigen::ArrayBase<Derived>& values) {
  return values.derived() > 0.0F;
}

// The values of all taxels at one instant, with the time stamps of host and controller.
struct TactileFrame {
  std::shared_ptr<const SensorLayout> layout;
  // Time of the controller's or the sender's clock, unwrapped [us]; empty in recordings from a
  // .dsa.
  std::optional<std::int64_t> deviceUs;
  std::int64_t hostUs = 0;  // host time [us since 1970]
  // layout->numCells() values: counts as recorded, or values that filters computed from them. A
  // taxel is active (touched) exactly when its value is above 0. Filtered values are 0 where the
  // taxel was not active in the recording, because the tail of a filter over time, and what a
  // filter over space gives to neighbours, is no contact. Where the layout decides touch, they are
  // what presses: the difference to the baseline, of three components the one into the surface.
  std::vector<float> values;
  // The output of the filters for every taxel, also for those that were not active in the
  // recording; for drawing, storing and further filtering. Empty when `values` holds everything.
  std::vector<float> filtered;
  // What the sensor sent, layout->numReadings() numbers, where the layout decides touch; then
  // decideTouch() (model/touch.h) gives `values` and `filtered`. Empty where what the sensor sent
  // are the `values`, and in filtered frames.
  std::vector<float> readings;
  // The baseline that was used; null: 0.
  std::shared_ptr<const Baseline> baseline;

  // What a recording stores: `readings`, or `values` when there are none.
  const std::vector<float>& stored() const noexcept { return readings.empty() ? values : readings; }
  std::vector<float>& stored() noexcept { return readings.empty() ? values : readings; }

  TactileFrame() = default;
  // Makes a frame of zeros, with readings where the layout decides touch.
  explicit TactileFrame(std::shared_ptr<const SensorLayout> sensorLayout);

  // Views of one matrix; valid as long as `values`. They throw std::out_of_range for a matrix that
  // does not exist.
  ConstMatrixMap matrix(std::size_t index) const;
  MatrixMap matrix(std::size_t index);
  // Returns `filtered`, or `values` when `filtered` is empty: of all matrices, or a view of one.
  // The view throws std::out_of_range for a matrix that does not exist.
  const std::vector<float>& allValues() const noexcept {
    return filtered.empty() ? values : filtered;
  }
  ConstMatrixMap allValues(std::size_t index) const;
  // Takes the output of filters: `all` goes to `filtered`, and where `active` is set also to
  // `values`; the other `values` become 0. There are no readings any more. `filtered` stays empty
  // when both would be equal. Throws std::invalid_argument when a length differs from the layout's.
  void setFiltered(std::vector<float> all, const std::vector<bool>& active);
  // Returns whether all `values` are whole numbers of counts, 0..maxCounts.
  bool isCounts(float maxCounts = 4095.0F) const noexcept;
};

// The taxel with the largest value in a frame, or in one of its matrices; among equal ones the
// first in protocol order.
struct TaxelPeak {
  std::size_t matrix = 0;
  int row = 0;  // 0 is the fingertip
  int column = 0;
  float counts = 0.0F;  // 0: no taxel is active
};
TaxelPeak taxelPeak(const TactileFrame& frame);
// Throws std::out_of_range for a matrix that does not exist.
TaxelPeak taxelPeak(const TactileFrame& frame, std::size_t matrix);

// Whether something presses on a taxel.
enum class CellTruth : std::uint8_t {
  // Nothing presses on the taxel (less than half a count): when it is active, it is a ghost.
  kNothing,
  // Something presses on the taxel, but too weakly to be reported without noise: neither touched
  // nor untouched.
  kFaint,
  // The taxel is pressed: without noise its reading would exceed the reading at rest.
  kTouched
};
using CellTruthMask = std::vector<CellTruth>;  // one per place of the layout

}  // namespace palpate
