// A WebSocket server in Foxglove's protocol: clients see a list of channels, subscribe to some of
// them and receive their messages. It knows neither hands nor the content of messages: those are
// known to foxglove_messages.h and live_stream.h.
//
// Source: Foxglove WebSocket protocol v1 (foxglove/ws-protocol, docs/spec.md), subprotocols
// "foxglove.websocket.v1" and "foxglove.sdk.v1". Text messages are JSON objects with a key "op":
// serverInfo, advertise, status from the server, subscribe and unsubscribe from the client. A
// message of a channel is binary, little-endian:
//   0x01 | subscription id u32 | time u64 [ns since 1970] | payload
//
// The server runs on a thread of its own and never waits for a client: what waits for a slow one is
// bounded, and older messages are then dropped and counted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace palpate {

constexpr std::uint16_t kUsualFoxglovePort = 8765;

// One channel; its messages are JSON objects.
struct FoxgloveChannel {
  std::string topic;       // "/signals"
  std::string schemaName;  // "foxglove.RawImage"
  std::string schema;      // a JSON schema, as text
  // Whether a client that subscribes receives the newest message at once, also an older one: for
  // what is published once.
  bool latched = false;
};

struct FoxgloveServerOptions {
  // Numeric address that the server listens at. Other machines can connect only where it is not a
  // loopback address.
  std::string address = "127.0.0.1";
  std::uint16_t port = kUsualFoxglovePort;  // 0: a free one
  std::string name = "Palpate";             // what clients show
  // Origins of web pages that may connect in addition to https://app.foxglove.dev, for example
  // "http://localhost:8080". Browsers name the origin of the page; other programs name none.
  std::vector<std::string> origins = {};
  // Called with one line for the first refused connection of each other origin, of 16 origins at
  // most: a browser shows its user no reason. From the server's thread; may be empty.
  std::function<void(const std::string& why)> onRefusedOrigin = {};
  std::size_t maxClients = 16;  // 1..1000
  // What may wait for one client [bytes]; beyond it the oldest messages are dropped.
  std::size_t maxWaitingBytes = 4U << 20;
  // Limit for the whole handshake of a client [s].
  double handshakeS = 10.0;
};

struct FoxgloveServerStats {
  std::size_t clients = 0;       // connected now, after their handshake
  std::uint64_t accepted = 0;    // handshakes since the start
  std::uint64_t refused = 0;     // rejected: invalid handshake or client limit
  std::uint64_t published = 0;   // messages of channels that a client had subscribed to
  std::uint64_t sent = 0;        // messages that were passed to the operating system
  std::uint64_t dropped = 0;     // messages dropped because a client was too slow
  std::string lastRefusal = {};  // why the last one was refused; empty: none was
};

// Every function may be called from any thread.
class FoxgloveServer {
 public:
  // Starts listening. Throws Error (the port is in use, the address is none of this machine),
  // std::invalid_argument (an option out of range).
  FoxgloveServer(FoxgloveServerOptions options, std::vector<FoxgloveChannel> channels);
  // Says goodbye to the clients, for at most 0.04 s.
  ~FoxgloveServer();
  FoxgloveServer(const FoxgloveServer&) = delete;
  FoxgloveServer& operator=(const FoxgloveServer&) = delete;

  std::uint16_t port() const noexcept;
  // "ws://127.0.0.1:8765"
  std::string url() const;
  // Whether a client subscribes to the channel: otherwise its message needs not be made.
  bool wanted(std::size_t channel) const;
  // Sends a message to all subscribers of a channel. `timeUs` in us since 1970, not before it.
  void publish(std::size_t channel, std::int64_t timeUs, std::string payload);
  FoxgloveServerStats stats() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
