// Streams the results of live processing to other programs on this machine: off by default, to
// 127.0.0.1 only. What is sent for a frame is divided into datagrams of at most 1400 bytes
// (datagrams.h). Sending never waits for a receiver.
//
//   ProcessingChain --results--> LiveStream --UDP--> PlotJuggler (signals),
//                                                    readers of TactileSensor (taxels)
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <palpate/interop/datagram_sender.h>
#include <palpate/interop/recent_link.h>
#include <palpate/live/live_results.h>

namespace palpate {

enum class StreamKind {
  kSignals,  // signal_json.h, to PlotJuggler's port
  kTactile,  // recording/tactile_sensor_json.h
};
inline constexpr std::array kAllStreamKinds = {StreamKind::kSignals, StreamKind::kTactile};
constexpr std::uint16_t usualPort(StreamKind kind) {
  return kind == StreamKind::kSignals ? 9870 : 9871;
}

// A stream is these two encoders. Appends its content for one frame, without a line end.
void appendStreamed(std::string& out,
                    StreamKind kind,
                    const LiveResults& results,
                    std::uint64_t sequence,
                    const LinkHealth* link);
// The same content as datagrams (datagrams.h).
std::vector<std::string> streamedDatagrams(StreamKind kind,
                                           const LiveResults& results,
                                           std::uint64_t sequence,
                                           const LinkHealth* link);

// Every function may be called from any thread.
class LiveStream {
 public:
  // `askLink` is called on the processing thread while signals are sent.
  explicit LiveStream(LinkHealthQuery askLink = {}) : link_(std::move(askLink)) {}

  // Takes effect with the next frame; counters restart. Throws std::invalid_argument (port 0),
  // DeviceError.
  void switchOn(StreamKind kind, std::uint16_t port);
  void switchOff(StreamKind kind);
  bool on(StreamKind kind) const;
  // Empty while the stream is off.
  std::optional<DatagramStats> stats(StreamKind kind) const;

  // Sends a frame's results on all streams that are on.
  void send(const LiveResults& results);

 private:
  struct Stream {
    std::unique_ptr<DatagramSender> sender;  // null when off
    std::uint64_t sequence = 0;
  };

  mutable std::mutex mutex_;
  std::array<Stream, kAllStreamKinds.size()> streams_;
  RecentLink link_;
};

}  // namespace palpate
