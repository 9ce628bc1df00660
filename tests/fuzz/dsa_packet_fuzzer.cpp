// Fuzzes what comes from the tactile port: packets in pieces, frames, the controller's answers.
// Beyond not crashing: every byte is accounted for, splitting makes no difference, a frame that is
// accepted is within 12 bits, and the driver always comes back.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/time.h"
#include "palpate/device/byte_channel.h"
#include "palpate/device/dsa_controller.h"
#include "palpate/device/dsa_frame.h"
#include "palpate/device/dsa_packet.h"
#include "palpate/device/sdh2.h"
#include "palpate/model/hand_description.h"

namespace {

using namespace palpate;

void require(bool condition) {
  if (!condition) std::abort();
}

class Time : public Clock {
 public:
  std::int64_t monotonicUs() const override { return nowUs; }
  std::int64_t wallUs() const override { return nowUs; }
  std::int64_t nowUs = 0;
};

// Hands out the input, a piece per question; then silence.
class Line : public ByteChannel {
 public:
  Line(std::span<const std::byte> bytes, Time& time) : bytes_(bytes), time_(time) {}
  std::size_t read(std::span<std::byte> into, std::chrono::milliseconds timeout) override {
    if (allowed_ == 0 || bytes_.empty()) {
      time_.nowUs += std::max<std::int64_t>(timeout.count(), 1) * 1000;
      return 0;
    }
    const std::size_t n = std::min({into.size(), bytes_.size(), allowed_});
    std::copy_n(bytes_.begin(), n, into.begin());
    bytes_ = bytes_.subspan(n);
    allowed_ -= n;
    time_.nowUs += 100;
    return n;
  }
  void write(std::span<const std::byte>) override { allowed_ = 70; }
  void interrupt() noexcept override {}
  const std::string& name() const noexcept override { return name_; }

 private:
  std::span<const std::byte> bytes_;
  Time& time_;
  std::size_t allowed_ = 0;
  std::string name_ = "line";
};

std::vector<std::vector<std::byte>> packetsIn(std::span<const std::byte> bytes, std::size_t chunk) {
  DsaPacketParser parser;
  std::vector<std::vector<std::byte>> packets;
  const auto sink = [&](const DsaPacket& packet) {
    packets.emplace_back(packet.payload.begin(), packet.payload.end());
  };
  for (std::size_t at = 0; at < bytes.size(); at += chunk)
    parser.push(bytes.subspan(at, std::min(chunk, bytes.size() - at)), sink);
  require(parser.stats().packetBytes + parser.stats().skippedBytes + parser.pendingBytes() ==
          bytes.size());
  parser.flush(sink);
  require(parser.pendingBytes() == 0);
  return packets;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto packets = packetsIn(bytes, 4096);
  require(packets == packetsIn(bytes, 1));
  std::vector<float> counts(sdh2().layout->numCells());
  DsaClock clock;
  const auto frameIn = [&](std::span<const std::byte> payload) {
    const auto frame = decodeDsaFrame(payload, *sdh2().layout, true, counts);
    if (!frame) return;
    for (const float value : counts) require(value >= 0.0F && value <= 4095.0F);
    clock.checkStamp(frame->stampMs, 0);
  };
  for (const auto& payload : packets) frameIn(payload);
  frameIn(bytes);  // without framing: the checksum would keep most inputs away

  Time time;
  Line line(bytes, time);
  DsaControllerOptions options;
  options.openTimeout = std::chrono::milliseconds(3000);
  DsaController controller(
      line, [](std::span<const std::byte>) {}, time, options);
  try {
    controller.open();
    controller.setThreshold(0, 100);
  } catch (const DeviceError&) {
  } catch (const std::invalid_argument&) {
  }
  require(time.nowUs < 3'600'000'000);
  return 0;
}
