// What a client of the Foxglove WebSocket sends: its handshake and its requests, without a network.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace palpate {

constexpr int kSwitchingProtocols = 101;
constexpr int kForbidden = 403;  // the origin may not connect
inline constexpr const char* kNothingIsTaken =
    "Palpate only sends: it takes no data, parameters or calls";

// What a handshake says, already divided into header fields.
struct FoxgloveHandshake {
  bool isUpgrade = false;      // a complete WebSocket upgrade
  bool hasOneOrigin = true;    // at most one field Origin
  std::string origin = {};     // empty: none
  std::string protocols = {};  // Sec-WebSocket-Protocol, separated by commas
  std::size_t clients = 0;     // connected now
  std::size_t maxClients = 1;
};

struct FoxgloveReply {
  int status = kSwitchingProtocols;  // of HTTP
  std::string protocol;              // the chosen subprotocol
  std::string text;                  // why it is refused: a sentence for users
};
FoxgloveReply replyTo(const FoxgloveHandshake& handshake, const std::vector<std::string>& origins);

// One text message of a client.
struct FoxgloveRequest {
  std::vector<std::pair<std::uint32_t, std::size_t>> subscribe = {};  // id, channel
  std::vector<std::uint32_t> unsubscribe = {};
  std::string problem = {};  // what could not be done; empty: nothing
};
// Never throws for bad text: it is told in `problem`.
FoxgloveRequest readFoxgloveRequest(std::string_view text, std::size_t numChannels);

}  // namespace palpate
