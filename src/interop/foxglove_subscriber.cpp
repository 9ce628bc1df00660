#include "interop/foxglove_subscriber.h"

#include <algorithm>
#include <utility>

#include "palpate/core/json.h"

#include "interop/foxglove_request.h"

namespace palpate {
namespace {

constexpr std::int64_t kSubscriberNsPerUs = 1000;

void putLittleEndian(unsigned char* at, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) at[i] = static_cast<unsigned char>(value >> (8 * i) & 0xFF);
}

}  // namespace

FoxgloveSubscriber::FoxgloveSubscriber(std::size_t numChannels,
                                       std::size_t maxWaitingBytes,
                                       OnSubscription onSubscription)
    : numChannels_(numChannels),
      onSubscription_(std::move(onSubscription)),
      waiting_(maxWaitingBytes) {}

FoxgloveSubscriber::~FoxgloveSubscriber() {
  for (const auto& [id, channel] : channelOfId_) onSubscription_(channel, -1);
}

void FoxgloveSubscriber::take(bool isText,
                              std::string_view message,
                              const std::vector<FoxgloveMessage>& latest) {
  FoxgloveRequest request = isText ? readFoxgloveRequest(message, numChannels_)
                                   : FoxgloveRequest{.problem = kNothingIsTaken};
  for (const auto& [id, channel] : request.subscribe)
    if (std::string problem = subscribe(id, channel, latest); !problem.empty())
      request.problem = std::move(problem);
  for (const std::uint32_t id : request.unsubscribe) {
    const auto found = channelOfId_.find(id);
    if (found == channelOfId_.end()) continue;
    onSubscription_(found->second, -1);
    idOfChannel_.erase(found->second);
    channelOfId_.erase(found);
  }
  if (request.problem.empty()) return;
  // Level 1: a warning, shown among the problems of the connection.
  const Json status =
      Json::object().set("op", "status").set("level", 1).set("message", request.problem);
  FoxgloveOutgoing out;
  out.droppable = true;
  out.content = std::make_shared<const std::string>(status.text(-1));
  waiting_.push(std::move(out));
}

std::string FoxgloveSubscriber::subscribe(std::uint32_t id,
                                          std::size_t channel,
                                          const std::vector<FoxgloveMessage>& latest) {
  if (channelOfId_.contains(id)) return "subscription " + std::to_string(id) + " exists already";
  if (const auto same = idOfChannel_.find(channel); same != idOfChannel_.end())
    return "channel " + std::to_string(channel) + " has the subscription " +
           std::to_string(same->second) + " already";
  channelOfId_.emplace(id, channel);
  idOfChannel_.emplace(channel, id);
  onSubscription_(channel, 1);
  if (latest[channel].payload) queueMessage(id, latest[channel], /*droppable=*/false);
  return {};
}

void FoxgloveSubscriber::publish(const FoxgloveMessage& message) {
  const auto found = idOfChannel_.find(message.channel);
  if (found != idOfChannel_.end()) queueMessage(found->second, message, /*droppable=*/true);
}

void FoxgloveSubscriber::queueText(std::string text) {
  FoxgloveOutgoing out;
  out.content = std::make_shared<const std::string>(std::move(text));
  waiting_.push(std::move(out));
}

void FoxgloveSubscriber::queueMessage(std::uint32_t id,
                                      const FoxgloveMessage& message,
                                      bool droppable) {
  FoxgloveOutgoing out;
  out.binary = true;
  out.droppable = droppable;
  out.content = message.payload;
  out.head[0] = 1;
  putLittleEndian(out.head.data() + 1, id, 4);
  putLittleEndian(
      out.head.data() + 5,
      static_cast<std::uint64_t>(std::max<std::int64_t>(message.timeUs, 0) * kSubscriberNsPerUs),
      8);
  waiting_.push(std::move(out));
}

}  // namespace palpate
