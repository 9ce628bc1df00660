// Emulated hand that sends its frames as a stream: for hands without the SDH-2's protocols. It
// listens at a TCP port and sends packets or lines (docs/manual/stream_protocol.md) to whoever
// connects, one client at a time; a StreamDevice with the source tcp:HOST:PORT receives them.
//
// The hand's time advances while a client is connected: frame n is measured at n / rate. Without a
// client the hand rests.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include <palpate/core/option_check.h>
#include <palpate/emulator/faults.h>
#include <palpate/emulator/physical_hand.h>

namespace palpate {

enum class EmulatedStreamFormat {
  kBinary,  // packets
  kLines,   // lines of numbers
  kJson,    // JSON objects, one per line
};
inline constexpr std::array<OptionWord<EmulatedStreamFormat>, 3> kEmulatedStreamWords{
    {{"binary", EmulatedStreamFormat::kBinary},
     {"lines", EmulatedStreamFormat::kLines},
     {"json", EmulatedStreamFormat::kJson}}};

struct EmulatedStreamOptions {
  // [ADDRESS:]PORT, where clients connect. Without an ADDRESS (numeric; IPv6 in brackets) only
  // programs of this machine can; PORT 0 takes a free one.
  std::string where = "0";
  EmulatedStreamFormat format = EmulatedStreamFormat::kBinary;
  static constexpr OptionRange kRateHz{0.1, 5000.0, "Hz"};
  double rateHz = 100.0;
  // Frames follow as fast as the client reads, without loss; `rateHz` is that of the hand's time.
  bool asFastAsRead = false;
  // Faults of the connection; times are the hand's, and frames of a stall are lost. An unplug ends
  // the connection and refuses others for its time. With `bootS` nothing is sent before this time.
  Faults faults = {};
  std::uint64_t seed = 1;  // of the faults

  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// A frame as it was measured, before it is sent. Valid inside the call.
struct EmulatedStreamFrame {
  std::uint64_t number = 0;
  double timeS = 0.0;             // of the hand
  std::int64_t hostUs = 0;        // host time [us since 1970]
  std::span<const float> values;  // readings [unit of the hand]
  const PhysicalHand& model;      // its truth() belongs to this frame
};
using EmulatedStreamObserver = std::function<void(const EmulatedStreamFrame&)>;

struct EmulatedStreamCounts {
  std::uint64_t clients = 0;  // that have connected
  std::uint64_t frames = 0;   // given to the connection
  // Frames that were left out: the client did not read, or during a stall or an unplug. Their
  // numbers are missing in the stream.
  std::uint64_t lost = 0;
  FaultCounts faults;
  // Reason why the hand stopped because of an error; empty while it runs.
  std::string failure;
};

// Every function may be called from any thread.
class EmulatedStream {
 public:
  // Listens and starts. `observer` is called from the hand's thread for each frame that is sent.
  // Throws std::invalid_argument (options), DeviceError (the port).
  explicit EmulatedStream(std::unique_ptr<PhysicalHand> model,
                          EmulatedStreamOptions options = {},
                          EmulatedStreamObserver observer = {});
  ~EmulatedStream();
  EmulatedStream(const EmulatedStream&) = delete;
  EmulatedStream& operator=(const EmulatedStream&) = delete;

  // Where a client connects: "tcp:127.0.0.1:9871".
  std::string name() const;
  // True when other machines can connect, because an address was given.
  bool isOpenToOthers() const;
  EmulatedStreamCounts counts() const;

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace palpate
