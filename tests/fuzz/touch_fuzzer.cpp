// Fuzzes the rules of touch of a recording's meta data, behind a zero byte the JSON of an event
// "baseline", behind another one the readings (f32). What is taken reads back as it was written,
// and what is seen of the readings is finite.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/model/touch.h"

namespace {

using namespace palpate;

void require(bool condition) {
  if (!condition) std::abort();
}

// Five places, one of them masked.
SensorLayout plainLayout() {
  MatrixLayout masked = MatrixLayout::full(1, 3, 2.0);
  masked.staticMask[1] = masked.dynamicMask[1] = 0;
  return SensorLayout({masked, MatrixLayout::full(2, 1, 2.0)});
}

std::string_view takePart(std::string_view& text) {
  const std::size_t end = text.find('\0');
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

void look(const std::shared_ptr<const SensorLayout>& layout,
          const Baselines& baselines,
          std::string_view bytes) {
  TactileFrame frame(layout);
  frame.readings.assign(layout->numReadings(), 0.0F);
  for (std::size_t i = 0; i < frame.readings.size() && bytes.size() >= (i + 1) * sizeof(float); ++i)
    std::memcpy(&frame.readings[i], bytes.data() + i * sizeof(float), sizeof(float));
  for (float& reading : frame.readings)
    if (!std::isfinite(reading)) reading = 0.0F;
  decideTouch(frame, baselineAt(baselines, 0));
  require(frame.values.size() == layout->numCells());
  for (const float value : frame.values) require(std::isfinite(value) && value >= 0.0F);
  for (const float value : frame.allValues()) require(std::isfinite(value));
  require(frame.values[1] == 0.0F);
  for (int x = 0; x < 3; ++x)
    for (const float part : forceAt(frame, {0, 0, x})) require(std::isfinite(part));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  const std::string_view rules = takePart(rest);
  const std::string_view json = takePart(rest);
  std::optional<SensorLayout> layout;
  try {
    layout = withTouchRules(plainLayout(), rules);
    require(withTouchRules(plainLayout(), touchRulesText(*layout)) == *layout);
    require(withoutTouchRules(*layout) == plainLayout());
  } catch (const Error&) {
    layout = plainLayout();
  }
  const std::vector<Event> events{{0, 0, "baseline", {}, "", std::string(json)}};
  std::size_t wrong = 0;
  const Baselines baselines = baselinesOf(events, *layout, &wrong);
  require(baselines.size() + wrong == 1);
  const Baselines again = baselinesOf(baselineEvents(baselines), *layout);
  require(again.size() == baselines.size());
  if (!baselines.empty()) require(*again[0].second == *baselines[0].second);
  look(std::make_shared<const SensorLayout>(*layout), baselines, rest);
  return 0;
}
