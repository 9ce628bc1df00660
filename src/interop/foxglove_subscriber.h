// One client of the Foxglove server without its connection: what it subscribes to, and what waits
// to be sent to it. Whatever the client sends, and however slowly it reads, the work for a message
// and the memory are bounded.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "interop/outlet_queue.h"

namespace palpate {

using FoxgloveText = std::shared_ptr<const std::string>;

// A message of a channel, the same for all its subscribers.
struct FoxgloveMessage {
  std::size_t channel = 0;
  std::int64_t timeUs = 0;  // since 1970
  FoxgloveText payload;     // null: there is no message yet
  bool droppable = true;

  std::size_t size() const { return payload->size(); }
};

// A WebSocket message to one client: `head` (of binary messages only), then `content`.
struct FoxgloveOutgoing {
  static constexpr std::size_t kHeadBytes = 13;

  std::array<unsigned char, kHeadBytes> head{};
  bool binary = false;
  bool droppable = false;
  FoxgloveText content;

  std::size_t size() const { return content->size() + (binary ? kHeadBytes : 0); }
};

class FoxgloveSubscriber {
 public:
  using OnSubscription = std::function<void(std::size_t channel, int change)>;

  // Beyond `maxWaitingBytes` the oldest messages of channels are dropped. `onSubscription` is told
  // each subscription that begins (+1) or ends (-1).
  FoxgloveSubscriber(std::size_t numChannels,
                     std::size_t maxWaitingBytes,
                     OnSubscription onSubscription);
  // Ends all subscriptions.
  ~FoxgloveSubscriber();
  FoxgloveSubscriber(const FoxgloveSubscriber&) = delete;
  FoxgloveSubscriber& operator=(const FoxgloveSubscriber&) = delete;

  // Carries out a message of the client; one that can't be carried out is answered with a status.
  // `latest`: per channel, the message that a new subscriber receives at once.
  void take(bool isText, std::string_view message, const std::vector<FoxgloveMessage>& latest);
  // Queues a message if the client subscribes to its channel.
  void publish(const FoxgloveMessage& message);
  // Queues a text that is never dropped.
  void queueText(std::string text);

  // What waits for the client. What can't be dropped is the greeting and what new subscribers
  // receive at once: it overruns only where a client subscribes again and again without reading.
  OutletQueue<FoxgloveOutgoing>& waiting() noexcept { return waiting_; }

 private:
  // Returns why there is no such subscription now; empty: there is.
  std::string subscribe(std::uint32_t id,
                        std::size_t channel,
                        const std::vector<FoxgloveMessage>& latest);
  void queueMessage(std::uint32_t id, const FoxgloveMessage& message, bool droppable);

  const std::size_t numChannels_;
  const OnSubscription onSubscription_;
  // Each the inverse of the other: a channel has at most one subscription.
  std::map<std::uint32_t, std::size_t> channelOfId_;
  std::map<std::size_t, std::uint32_t> idOfChannel_;
  OutletQueue<FoxgloveOutgoing> waiting_;
};

}  // namespace palpate
