// Fuzzes packets of a binary stream. Beyond not crashing: every byte is accounted for, splitting
// makes no difference, every value that is accepted is finite, and a good packet
// behind any input is found. Descriptions are read, too.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/device/stream_packets.h"

namespace {

using namespace palpate;

void require(bool condition) {
  if (!condition) std::abort();
}

HandDescription streamPacketsHand() {
  HandDescription hand;
  hand.layout = std::make_shared<const SensorLayout>(std::vector{MatrixLayout::full(1, 3, 2.0)});
  hand.matrices.resize(1);
  hand.axes.resize(2);
  hand.temperatureSensors.resize(1);
  return hand;
}

std::vector<double> itemsIn(const StreamShape& shape,
                            std::span<const std::byte> bytes,
                            std::size_t chunk) {
  StreamPacketParser parser(shape);
  std::vector<double> all;
  const auto sink = [&](const StreamItem& item) {
    all.push_back(static_cast<double>(item.kind));
    all.push_back(item.sequence.value());
    all.push_back(static_cast<double>(item.deviceUs.value()));
    for (const float value : item.values) {
      require(std::isfinite(value));
      all.push_back(static_cast<double>(value));
    }
    for (const double value : item.numbers) require(std::isfinite(value));
    if (item.kind != StreamItemKind::kDescription) return;
    try {
      readStreamDescription(item.text, shape);
    } catch (const Error&) {
    }
  };
  for (std::size_t at = 0; at < bytes.size(); at += chunk)
    parser.push(bytes.subspan(at, std::min(chunk, bytes.size() - at)), sink);
  require(parser.stats().packetBytes + parser.stats().skippedBytes + parser.pendingBytes() ==
          bytes.size());
  parser.flush(sink);
  require(parser.pendingBytes() == 0);
  return all;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const StreamShape shape(streamPacketsHand());
  const auto bytes = std::as_bytes(std::span(data, size));
  const std::vector<double> items = itemsIn(shape, bytes, 4096);
  require(items == itemsIn(shape, bytes, 1));
  // Without a checksum most inputs would stay outside: the input is the payload of good packets.
  for (int type = 1; type <= 5; ++type) {
    std::vector<std::byte> packet;
    appendStreamPacket(packet, static_cast<StreamPacketType>(type), 1, 2, bytes);
    itemsIn(shape, packet, 4096);
  }
  std::vector<std::byte> followed(bytes.begin(), bytes.end());
  appendStreamFrame(followed, 77, 1, std::vector<float>{1, 2, 3});
  const std::vector<double> more = itemsIn(shape, followed, 4096);
  const std::vector<double> last{0, 77, 1, 1, 2, 3};
  require(
      more.size() >= last.size() &&
      std::equal(last.begin(), last.end(), more.end() - static_cast<std::ptrdiff_t>(last.size())));
  return 0;
}
