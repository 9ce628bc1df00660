#include "interop/foxglove_request.h"

#include <algorithm>
#include <array>
#include <optional>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr std::array<std::string_view, 2> kSubprotocols = {"foxglove.sdk.v1",
                                                           "foxglove.websocket.v1"};
constexpr const char* kFoxgloveWebApp = "https://app.foxglove.dev";
constexpr std::size_t kMaxShownBytes = 100;

std::string shown(std::string_view text) {
  return "'" + escapedLine(std::string(text.substr(0, kMaxShownBytes))) + "'";
}

// The first of our subprotocols that the client offers; empty: none.
std::string chosenProtocol(std::string_view offered) {
  std::vector<std::string_view> names;
  while (!offered.empty()) {
    const std::size_t comma = std::min(offered.find(','), offered.size());
    names.push_back(trimmed(offered.substr(0, comma)));
    offered.remove_prefix(std::min(comma + 1, offered.size()));
  }
  for (const std::string_view ours : kSubprotocols)
    if (std::find(names.begin(), names.end(), ours) != names.end()) return std::string(ours);
  return {};
}

std::optional<std::uint32_t> idOf(const Json& number) {
  if (!number.isNumber()) return std::nullopt;
  const double value = number.asDouble();
  if (!(value >= 0.0 && value <= static_cast<double>(UINT32_MAX))) return std::nullopt;
  const auto id = static_cast<std::uint32_t>(value);
  if (static_cast<double>(id) != value) return std::nullopt;
  return id;
}

void readSubscriptions(const Json& list, std::size_t numChannels, FoxgloveRequest& request) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json item = list.at(i);
    const auto id = idOf(item.at("id"));
    const auto channel = idOf(item.at("channelId"));
    if (!id || !channel)
      request.problem = "a subscription needs the numbers id and channelId";
    else if (*channel >= numChannels)
      request.problem = "there is no channel " + std::to_string(*channel);
    else
      request.subscribe.emplace_back(*id, *channel);
  }
}

void readUnsubscriptions(const Json& list, FoxgloveRequest& request) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto id = idOf(list.at(i));
    if (id)
      request.unsubscribe.push_back(*id);
    else
      request.problem = "subscriptionIds must be whole numbers";
  }
}

}  // namespace

FoxgloveReply replyTo(const FoxgloveHandshake& handshake, const std::vector<std::string>& origins) {
  const std::string& origin = handshake.origin;  // empty: no web page
  const bool mayConnect = origin.empty() || origin == kFoxgloveWebApp ||
                          std::find(origins.begin(), origins.end(), origin) != origins.end();
  if (!handshake.hasOneOrigin || !mayConnect)
    return {
        kForbidden,
        "",
        "The web page " + shown(origin) +
            " may not read the hand: allow it with the option --origin (in the window: the setting "
            "streams/foxglove_origins)."};
  if (!handshake.isUpgrade)
    return {426,
            "",
            "This port is a WebSocket for Foxglove: choose Open connection > Foxglove WebSocket "
            "there, and this address with ws:// before it."};
  FoxgloveReply reply;
  reply.protocol = chosenProtocol(handshake.protocols);
  if (reply.protocol.empty())
    return {400,
            "",
            "A client must offer the subprotocol foxglove.sdk.v1 or foxglove.websocket.v1; this "
            "one offers " +
                (handshake.protocols.empty() ? std::string("none") : shown(handshake.protocols)) +
                "."};
  if (handshake.clients >= handshake.maxClients)
    return {503,
            "",
            "There are " + counted(handshake.clients, "client") +
                " already, which is the limit: close one of them."};
  return reply;
}

FoxgloveRequest readFoxgloveRequest(std::string_view text, std::size_t numChannels) {
  FoxgloveRequest request;
  try {
    const Json message = Json::parse(text);
    const std::string op = message.at("op").isString() ? message.at("op").asString() : "";
    const bool subscribes = op == "subscribe";
    if (!subscribes && op != "unsubscribe") {
      request.problem = op.empty() ? "a message needs the text op" : kNothingIsTaken;
      return request;
    }
    const char* const key = subscribes ? "subscriptions" : "subscriptionIds";
    const Json list = message.at(key);
    if (!list.isArray())
      request.problem = op + " needs the list " + key;
    else if (subscribes)
      readSubscriptions(list, numChannels, request);
    else
      readUnsubscriptions(list, request);
  } catch (const Error& error) {
    request.problem = std::string("a message is not JSON: ") + error.what();
  }
  return request;
}

}  // namespace palpate
