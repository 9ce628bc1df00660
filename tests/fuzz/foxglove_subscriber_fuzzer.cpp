// Fuzzes what a client of the Foxglove server sends after its handshake, between messages of the
// channels and a connection that takes what waits, or does not. A line is a text message of the
// client; "b" begins a binary one, "p2" publishes a message of channel 2, "n" takes one message.
// Beyond not crashing: what waits is bounded, each request gets at most one status, a channel has
// at most one subscription, and every message is whole, in order, and counted.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "palpate/core/json.h"

#include "interop/foxglove_subscriber.h"

namespace {

using namespace palpate;

constexpr std::size_t kNumChannels = 3;  // the last one is latched
constexpr std::size_t kMaxWaitingBytes = 400;

void require(bool condition) {
  if (!condition) std::abort();
}

class FoxgloveSession {
 public:
  ~FoxgloveSession() {
    while (takeOne()) {
    }
    require(subscriber_->waiting().bytes() == 0);
    // Status messages may have been dropped, too.
    const std::uint64_t gone = taken_ + subscriber_->waiting().takeDropped();
    require(gone >= queued_ && gone <= queued_ + numStatus_);
    subscriber_.reset();
    for (const int each : subscribers_) require(each == 0);
  }
  // Returns false when the server would disconnect the client.
  bool step(std::string_view line) {
    if (line.starts_with('p') && line.size() == 2) {
      publish(static_cast<unsigned char>(line[1]) % kNumChannels);
    } else if (line == "n") {
      takeOne();
    } else {
      subscriber_->take(!line.starts_with('b'), line, latest_);
      ++numStatus_;
    }
    for (const int each : subscribers_) require(each == 0 || each == 1);
    require(subscriber_->waiting().bytes() <= kMaxWaitingBytes || numUndroppable_ > 0);
    return !subscriber_->waiting().isOverrun();
  }

 private:
  void onSubscription(std::size_t channel, int change) {
    subscribers_.at(channel) += change;
    if (change > 0 && latest_[channel].payload) {
      ++queued_;
      ++numUndroppable_;
    }
  }
  void publish(std::size_t channel) {
    ++number_;
    const FoxgloveMessage message{channel,
                                  number_,
                                  std::make_shared<const std::string>(
                                      std::to_string(channel) + " " + std::to_string(number_))};
    if (channel == kNumChannels - 1) latest_[channel] = message;
    if (subscribers_[channel] > 0) ++queued_;
    subscriber_->publish(message);
  }
  bool takeOne() {
    const auto out = subscriber_->waiting().pop();
    if (!out) return false;
    if (!out->binary) {
      const Json status = Json::parse(*out->content);
      require(status.at("op").asString() == "status" && !status.at("message").asString().empty());
      require(numStatus_-- > 0);
      return true;
    }
    ++taken_;
    if (!out->droppable) --numUndroppable_;
    require(out->head[0] == 1);
    std::uint64_t id = 0, ns = 0;
    for (int i = 3; i >= 0; --i) id = id << 8 | out->head[static_cast<std::size_t>(1 + i)];
    for (int i = 7; i >= 0; --i) ns = ns << 8 | out->head[static_cast<std::size_t>(5 + i)];
    const std::string& payload = *out->content;
    require(payload.substr(2) == std::to_string(ns / 1000) && ns % 1000 == 0);
    std::uint64_t& last = lastNs_[{id, payload[0]}];
    require(ns >= last);
    last = ns;
    return true;
  }

  std::array<int, kNumChannels> subscribers_{};
  std::vector<FoxgloveMessage> latest_ = std::vector<FoxgloveMessage>(kNumChannels);
  std::int64_t number_ = 0;
  std::size_t numStatus_ = 0;  // that the client may still receive
  std::size_t numUndroppable_ = 0;
  std::uint64_t queued_ = 0, taken_ = 0;
  std::map<std::pair<std::uint64_t, char>, std::uint64_t> lastNs_;
  std::optional<FoxgloveSubscriber> subscriber_{
      std::in_place, kNumChannels, kMaxWaitingBytes, [this](std::size_t channel, int change) {
        onSubscription(channel, change);
      }};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  FoxgloveSession session;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (!session.step(text.substr(0, end))) break;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return 0;
}
