#include "interop/foxglove_subscriber.h"

#include <algorithm>
#include <utility>

#include "palpate/core/json.h"

#include "interop/foxglove_request.h"

namespace palpate {
namespace {

// What can't be dropped is the greeting and what new subscribers receive at once: more of it waits
// only for a client that subscribes again and again without reading.
constexpr std::size_t kMaxUndroppable = 64;
constexpr std::int64_t kSubscriberNsPerUs = 1000;

void putLittleEndian(unsigned char* at, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) at[i] = static_cast<unsigned char>(value >> (8 * i) & 0xFF);
}

}  // namespace

FoxgloveSubscriber::FoxgloveSubscriber(std::size_t numChannels,
                                       std::size_t maxWaitingBytes,
                                       OnSubscription onSubscription)
    : numChannels_(numChannels),
      maxWaitingBytes_(maxWaitingBytes),
      onSubscription_(std::move(onSubscription)) {}

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
  queue(std::move(out));
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
  queue(std::move(out));
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
  queue(std::move(out));
}

void FoxgloveSubscriber::queue(FoxgloveOutgoing out) {
  const std::size_t bytes = out.size();
  const std::size_t undroppable = out.droppable ? 0 : 1;
  waiting_.push_back(std::move(out));
  waitingBytes_ += bytes;
  undroppable_ += undroppable;
  auto oldest = waiting_.begin();
  while (waitingBytes_ > maxWaitingBytes_ && oldest != waiting_.end()) {
    if (!oldest->droppable) {
      ++oldest;
      continue;
    }
    waitingBytes_ -= oldest->size();
    oldest = waiting_.erase(oldest);
    ++dropped_;
  }
}

std::optional<FoxgloveOutgoing> FoxgloveSubscriber::next() {
  if (waiting_.empty()) return std::nullopt;
  FoxgloveOutgoing out = std::move(waiting_.front());
  waiting_.pop_front();
  waitingBytes_ -= out.size();
  if (!out.droppable) --undroppable_;
  return out;
}

bool FoxgloveSubscriber::isOverrun() const noexcept { return undroppable_ > kMaxUndroppable; }

std::uint64_t FoxgloveSubscriber::takeDropped() noexcept { return std::exchange(dropped_, 0); }

}  // namespace palpate
