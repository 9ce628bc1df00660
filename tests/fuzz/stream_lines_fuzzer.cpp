// Fuzzes lines of text from a stream. Beyond not crashing: every byte is accounted for, splitting
// makes no difference, memory is bounded, and every value that is accepted is finite.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "palpate/device/stream_lines.h"

namespace {

using namespace palpate;

void require(bool condition) {
  if (!condition) std::abort();
}

// Six places, one of them masked; two axes, one temperature sensor.
HandDescription streamLinesHand() {
  HandDescription hand;
  MatrixLayout masked = MatrixLayout::full(2, 2, 2.0);
  masked.staticMask[1] = masked.dynamicMask[1] = 0;
  hand.layout =
      std::make_shared<const SensorLayout>(std::vector{masked, MatrixLayout::full(1, 2, 2.0)});
  hand.matrices.resize(2);
  hand.axes.resize(2);
  hand.temperatureSensors.resize(1);
  return hand;
}

std::vector<double> itemsIn(std::span<const std::byte> bytes,
                            std::size_t chunk,
                            const StreamLineOptions& options) {
  const StreamShape shape(streamLinesHand());
  StreamLineParser parser(shape, options);
  std::vector<double> all;
  const auto sink = [&](const StreamItem& item) {
    all.push_back(static_cast<double>(item.kind));
    all.push_back(item.sequence ? *item.sequence : -1.0);
    all.push_back(item.deviceUs ? static_cast<double>(*item.deviceUs) : -1.0);
    if (item.kind == StreamItemKind::kFrame) require(item.values.size() == 6);
    for (const float value : item.values) {
      require(std::isfinite(value));
      all.push_back(static_cast<double>(value));
    }
    if (!item.values.empty()) require(item.values[1] == 0.0F);
    for (const double value : item.numbers) {
      require(std::isfinite(value));
      all.push_back(value);
    }
  };
  for (std::size_t at = 0; at < bytes.size(); at += chunk) {
    parser.push(bytes.subspan(at, std::min(chunk, bytes.size() - at)), sink);
    require(parser.pendingBytes() <= parser.longestLine());
  }
  const StreamLineStats& stats = parser.stats();
  require(stats.lineBytes + stats.skippedBytes + parser.pendingBytes() == bytes.size());
  require((stats.refused == 0) == parser.lastFault().empty());
  parser.endLine(sink);
  require(parser.pendingBytes() == 0);
  return all;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  for (const StreamLineOptions& options :
       {StreamLineOptions{}, StreamLineOptions{.time = StreamTime::kMicroseconds}})
    require(itemsIn(bytes, 4096, options) == itemsIn(bytes, 1, options));
  return 0;
}
