// Sends a hand live to Foxglove: heat maps, the hand in 3-D, joints, signals and events over a
// WebSocket (foxglove_server.h). Off by default; loopback unless another address is asked for.
//
//   ProcessingChain --results--> FoxgloveStream --messages--> FoxgloveServer --> Foxglove
//
// A message is made only when a client has subscribed to its channel. Sending never waits.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <palpate/interop/foxglove_messages.h>
#include <palpate/interop/foxglove_server.h>
#include <palpate/interop/recent_link.h>
#include <palpate/live/live_results.h>
#include <palpate/model/event.h>
#include <palpate/model/hand_description.h>

namespace palpate {

struct FoxgloveOptions {
  FoxgloveServerOptions server = {};
  FoxgloveImage image = FoxgloveImage::kValues;
};

// Every function may be called from any thread.
class FoxgloveStream {
 public:
  // `askLink` is called by send() while a client reads the signals.
  explicit FoxgloveStream(HandDescription hand, LinkHealthQuery askLink = {});
  ~FoxgloveStream();

  // Listens from now on; counters restart. Throws Error (the port is in use, and so on),
  // std::invalid_argument.
  void switchOn(FoxgloveOptions options);
  // Says goodbye to clients, for at most 0.04 s.
  void switchOff();
  bool on() const;
  // Empty while it is off.
  std::optional<FoxgloveServerStats> stats() const;
  std::string url() const;  // "ws://127.0.0.1:8765"; empty while it is off
  std::uint16_t port() const;
  // Why the hand is not shown in space though it is described; empty otherwise.
  std::string geometryProblem() const;

  // Sends the results of a frame, and an event. No effect while it is off.
  void send(const LiveResults& results);
  void send(const Event& event);

 private:
  struct Open;

  const HandDescription hand_;
  const LinkHealthQuery askLink_;
  mutable std::mutex mutex_;
  std::unique_ptr<Open> open_;  // null: off
};

}  // namespace palpate
