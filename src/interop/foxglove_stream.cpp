#include "palpate/interop/foxglove_stream.h"

#include <utility>

#include "palpate/core/number_text.h"
#include "palpate/interop/signal_json.h"
#include "palpate/model/gap_detector.h"

namespace palpate {

struct FoxgloveStream::Open {
  Open(const HandDescription& hand, FoxgloveOptions options, LinkHealthQuery askLink)
      : messages(hand, options.image),
        server(std::move(options.server), messages.channels()),
        link(std::move(askLink)) {}

  FoxgloveMessages messages;
  FoxgloveServer server;
  std::uint64_t sequence = 0;
  bool shapesSent = false;
  RecentLink link;
  std::int64_t anglesUs = -1;  // stamp of the angles that were sent last
  GapDetector gaps;
  std::optional<std::int64_t> frameUs;  // stamp of the last frame
};

FoxgloveStream::FoxgloveStream(HandDescription hand, LinkHealthQuery askLink)
    : hand_(std::move(hand)), askLink_(std::move(askLink)) {}

FoxgloveStream::~FoxgloveStream() = default;

// The old server ends before the new one listens, because both may have the same port.
void FoxgloveStream::switchOn(FoxgloveOptions options) {
  switchOff();
  auto open = std::make_unique<Open>(hand_, std::move(options), askLink_);
  const std::lock_guard lock(mutex_);
  open_ = std::move(open);
}

// The goodbye does not make senders wait.
void FoxgloveStream::switchOff() {
  std::unique_ptr<Open> old;
  {
    const std::lock_guard lock(mutex_);
    old = std::exchange(open_, nullptr);
  }
}

bool FoxgloveStream::on() const {
  const std::lock_guard lock(mutex_);
  return open_ != nullptr;
}

std::optional<FoxgloveServerStats> FoxgloveStream::stats() const {
  const std::lock_guard lock(mutex_);
  if (!open_) return {};
  return open_->server.stats();
}

std::string FoxgloveStream::url() const {
  const std::lock_guard lock(mutex_);
  return open_ ? open_->server.url() : std::string();
}

std::uint16_t FoxgloveStream::port() const {
  const std::lock_guard lock(mutex_);
  return open_ ? open_->server.port() : 0;
}

std::string FoxgloveStream::geometryProblem() const {
  const std::lock_guard lock(mutex_);
  return open_ ? open_->messages.geometryProblem() : std::string();
}

void FoxgloveStream::send(const LiveResults& results) {
  const std::lock_guard lock(mutex_);
  if (!open_) return;
  FoxgloveMessages& messages = open_->messages;
  FoxgloveServer& server = open_->server;
  const TactileFrame& frame = *results.frame;
  const std::int64_t nowUs = frame.hostUs;
  const std::uint64_t sequence = open_->sequence++;
  const auto beforeUs = std::exchange(open_->frameUs, nowUs);
  if (beforeUs && nowUs <= *beforeUs)  // a recording that is played again
    open_->gaps.reset();
  // Makes only messages that a client wants. Returns whether there was one.
  const auto publish = [&](std::optional<std::size_t> channel, std::int64_t us, const auto& make) {
    if (!channel || !server.wanted(*channel)) return false;
    server.publish(*channel, us, make());
    return true;
  };
  if (open_->gaps.afterGap(nowUs))
    publish(messages.eventsChannel(), nowUs, [&] {
      const std::string text =
          "no frame for " + fixedText(1e-6 * static_cast<double>(nowUs - *beforeUs), 1) + " s";
      return messages.event({*beforeUs, nowUs, "gap", std::nullopt, text, ""});
    });
  for (std::size_t m = 0; m < messages.numImages(); ++m)
    publish(m, nowUs, [&] { return messages.image(frame, m); });
  publish(messages.signalsChannel(), nowUs, [&] {
    std::string object;
    appendSignalJson(object, results, sequence, open_->link.at(nowUs));
    return object;
  });
  // Angles come less often than frames, or more often: each sample is sent once.
  if (const auto& angles = results.angles;
      angles && angles->hostUs != open_->anglesUs &&
      publish(messages.jointsChannel(), angles->hostUs, [&] { return messages.joints(*angles); }))
    open_->anglesUs = angles->hostUs;
  if (!std::exchange(open_->shapesSent, true))
    publish(messages.shapesChannel(), nowUs, [&] { return messages.shapes(nowUs); });
  const auto wanted = [&](std::optional<std::size_t> channel) {
    return channel && server.wanted(*channel);
  };
  if (!(wanted(messages.transformsChannel()) || wanted(messages.taxelsChannel())) ||
      !messages.setPose(results))
    return;
  publish(messages.transformsChannel(), nowUs, [&] { return messages.transforms(nowUs); });
  publish(messages.taxelsChannel(), nowUs, [&] { return messages.taxels(frame); });
}

void FoxgloveStream::send(const Event& event) {
  const std::lock_guard lock(mutex_);
  if (!open_) return;
  const std::size_t channel = open_->messages.eventsChannel();
  if (open_->server.wanted(channel))
    open_->server.publish(channel, event.tUs, open_->messages.event(event));
}

}  // namespace palpate
