// What tests of the Foxglove server send and read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "palpate/interop/foxglove_server.h"

#include "interop/web_socket_client.h"

namespace palpate::testing {

inline FoxgloveServerOptions freePort() {
  FoxgloveServerOptions options;
  options.port = 0;
  return options;
}

inline std::uint64_t littleEndian(const std::string& bytes, std::size_t at, int count) {
  std::uint64_t value = 0;
  for (int i = count - 1; i >= 0; --i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
  return value;
}

// Skips the two messages that every client receives first.
inline void skipGreeting(WebSocketClient& client) {
  client.frame();
  client.frame();
}

// Answers come after all that was sent before: whatever the client said is done then.
inline void awaitServer(WebSocketClient& client) {
  client.say(R"({"op":"x"})");
  while (const auto frame = client.frame())
    if (frame->opcode == 1) return;
}

// A message of 40 bytes that contains its number.
inline std::string numberedPayload(std::uint64_t number) {
  std::string text = std::to_string(number);
  return "\"" + std::string(38 - text.size(), '0') + text + "\"";
}

// The number of a message that is whole: the subscription, the time and the payload belong
// together.
inline std::optional<std::uint64_t> numberOfWhole(const WebSocketFrame& frame, std::uint64_t id) {
  if (frame.opcode != 2 || frame.payload.size() != 13 + 40 || frame.payload[0] != 1) return {};
  const std::uint64_t number = littleEndian(frame.payload, 5, 8) / 1000;
  if (littleEndian(frame.payload, 1, 4) != id) return {};
  if (frame.payload.substr(13) != numberedPayload(number)) return {};
  return number;
}

}  // namespace palpate::testing
