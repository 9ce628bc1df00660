#include "palpate/model/hand_description.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "palpate/core/number_text.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/tactile_frame.h"

namespace palpate {

bool sameSizes(const SensorLayout& a, const SensorLayout& b) {
  if (a.numMatrices() != b.numMatrices()) return false;
  for (std::size_t i = 0; i < a.numMatrices(); ++i)
    if (a.matrix(i).rows != b.matrix(i).rows || a.matrix(i).columns != b.matrix(i).columns)
      return false;
  return true;
}

std::string HandDescription::matrixName(std::size_t matrix) const {
  return matrix < matrices.size() ? matrices[matrix].name : "matrix " + std::to_string(matrix);
}

float HandDescription::maximumOf(std::size_t matrix) const {
  return matrix < matrices.size() ? matrices[matrix].maximumCounts.value_or(maximumCounts)
                                  : maximumCounts;
}

float HandDescription::saturationOf(std::size_t matrix) const {
  return matrix < matrices.size() ? matrices[matrix].saturationCounts.value_or(saturationCounts)
                                  : saturationCounts;
}

std::string HandDescription::saturationText() const {
  std::set<float> limits;
  for (std::size_t m = 0; m < layout->numMatrices(); ++m) limits.insert(saturationOf(m));
  std::string text;
  for (const float limit : limits) text += (text.empty() ? "" : " or ") + numberText(limit);
  return text;
}

std::size_t numSaturated(const HandDescription& hand, const TactileFrame& frame) noexcept {
  if (frame.values.size() != hand.layout->numCells()) return 0;
  std::size_t count = 0;
  auto values = frame.values.begin();
  const std::vector<MatrixLayout>& matrices = hand.layout->matrices();
  for (std::size_t m = 0; m < matrices.size(); ++m) {
    const auto end = values + static_cast<std::ptrdiff_t>(matrices[m].numCells());
    const float limit = hand.saturationOf(m);
    count += static_cast<std::size_t>(
        std::count_if(values, end, [limit](float value) { return value >= limit; }));
    values = end;
  }
  return count;
}

std::vector<SeriesDescription> seriesOf(const HandDescription& hand) {
  SeriesDescription angles{"angles", "joint_angles", {}, {}};
  for (const AxisDescription& axis : hand.axes) angles.columns.push_back({axis.name, axis.unit()});
  SeriesDescription temperatures{"temperatures", "temperatures", {}, {}};
  for (const auto& sensor : hand.temperatureSensors)
    temperatures.columns.push_back({sensor.name, "degC"});
  return {std::move(angles), std::move(temperatures)};
}

HandDescription withSeriesOf(HandDescription hand,
                             std::size_t numAxes,
                             std::size_t numTemperatureSensors) {
  if (numAxes != 0 && numAxes != hand.axes.size()) {
    hand.axes.clear();
    for (std::size_t i = 0; i < numAxes; ++i)
      hand.axes.push_back({"axis " + std::to_string(i), -180.0, 180.0});
  }
  if (numTemperatureSensors != 0 && numTemperatureSensors != hand.temperatureSensors.size()) {
    hand.temperatureSensors.clear();
    for (MatrixDescription& matrix : hand.matrices) matrix.temperatureSensor.reset();
    for (std::size_t i = 0; i < numTemperatureSensors; ++i)
      hand.temperatureSensors.push_back({"sensor " + std::to_string(i)});
  }
  return hand;
}

std::string sizesText(const SensorLayout& layout) {
  // Equal sizes are counted: "3 x 14x6, 3 x 13x6".
  std::vector<std::pair<std::string, int>> sizes;
  for (const MatrixLayout& matrix : layout.matrices()) {
    const std::string size = std::to_string(matrix.rows) + "x" + std::to_string(matrix.columns);
    const auto known = std::find_if(
        sizes.begin(), sizes.end(), [&](const auto& each) { return each.first == size; });
    if (known == sizes.end())
      sizes.emplace_back(size, 1);
    else
      ++known->second;
  }
  std::string text;
  for (const auto& [size, count] : sizes)
    text += (text.empty() ? "" : ", ") +
            (count == 1 ? std::string() : std::to_string(count) + " x ") + size;
  return text;
}

HandDescription describeHand(const SensorLayout& layout,
                             std::size_t numAxes,
                             std::size_t numTemperatureSensors) {
  HandDescription hand;
  const std::vector<BuiltInHand>& known = builtInHands();
  const auto same = std::find_if(known.begin(), known.end(), [&](const BuiltInHand& each) {
    return !each.hand->file->controller.empty() && sameSizes(layout, *each.hand->layout);
  });
  if (same != known.end()) {
    hand = *same->hand;
  } else {
    hand.name = "unknown sensor";
    // Use a grid that is as square as possible, filled row by row.
    const auto count = static_cast<int>(layout.numMatrices());
    const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
    for (int i = 0; i < count; ++i) {
      const std::string number = std::to_string(i);
      hand.matrices.push_back({"matrix " + number, number, i, "", i % columns, i / columns});
    }
  }
  hand.layout = std::make_shared<SensorLayout>(layout);
  return withSeriesOf(std::move(hand), numAxes, numTemperatureSensors);
}

}  // namespace palpate
