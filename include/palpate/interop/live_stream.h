// Publishes the results of live processing to other programs, off by default: as datagrams to
// 127.0.0.1, of at most 1400 bytes each (datagrams.h), and to Foxglove, as heat maps, the hand in
// 3-D, joints, signals and events over a WebSocket (foxglove_server.h), on this machine unless
// another address is asked for. Sending never waits for a receiver.
//
//   ProcessingChain --results--> LiveStream --UDP--> PlotJuggler (signals),
//                                    |               readers of TactileSensor (taxels)
//                                    '--messages--> FoxgloveServer --> Foxglove
//
// A message for Foxglove is made only when a client has subscribed to its channel.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <palpate/interop/datagram_sender.h>
#include <palpate/interop/foxglove_messages.h>
#include <palpate/interop/foxglove_server.h>
#include <palpate/interop/recent_link.h>
#include <palpate/live/live_results.h>
#include <palpate/model/event.h>
#include <palpate/model/hand_description.h>

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

struct FoxgloveOptions {
  FoxgloveServerOptions server = {};
  FoxgloveImage image = FoxgloveImage::kValues;
};

// Every function may be called from any thread.
class LiveStream {
 public:
  // `askLink` is called by send() while a program receives the signals.
  explicit LiveStream(HandDescription hand, LinkHealthQuery askLink = {});
  ~LiveStream();

  // Takes effect with the next frame; counters restart. Throws std::invalid_argument (port 0),
  // DeviceError.
  void switchOn(StreamKind kind, std::uint16_t port);
  void switchOff(StreamKind kind);
  bool on(StreamKind kind) const;
  // Empty while the stream is off.
  std::optional<DatagramStats> stats(StreamKind kind) const;

  // Foxglove listens from now on; counters restart. Throws Error (the port is in use, and so on),
  // std::invalid_argument.
  void switchOn(FoxgloveOptions options);
  // Says goodbye to clients, for at most 0.04 s.
  void switchOffFoxglove();
  // Empty while it is off.
  std::optional<FoxgloveServerStats> foxgloveStats() const;
  std::string foxgloveUrl() const;  // "ws://127.0.0.1:8765"; empty while it is off
  // Why Foxglove does not show the hand in space though it is described; empty otherwise.
  std::string geometryProblem() const;

  // Sends a frame's results, and an event, to all that are on.
  void send(const LiveResults& results);
  void send(const Event& event);

 private:
  struct Stream {
    std::unique_ptr<DatagramSender> sender;  // null when off
    std::uint64_t sequence = 0;
  };
  struct Foxglove;

  const HandDescription hand_;
  mutable std::mutex mutex_;
  std::array<Stream, kAllStreamKinds.size()> streams_;
  std::unique_ptr<Foxglove> foxglove_;  // null: off
  RecentLink link_;
};

}  // namespace palpate
