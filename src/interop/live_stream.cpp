#include "palpate/interop/live_stream.h"

#include <utility>

#include "palpate/core/number_text.h"
#include "palpate/interop/datagrams.h"
#include "palpate/interop/signal_json.h"
#include "palpate/model/gap_detector.h"
#include "palpate/recording/tactile_sensor_json.h"

namespace palpate {
namespace {

std::size_t placeOf(StreamKind kind) { return static_cast<std::size_t>(kind); }

}  // namespace

void appendStreamed(std::string& out,
                    StreamKind kind,
                    const LiveResults& results,
                    std::uint64_t sequence,
                    const LinkHealth* link) {
  if (kind == StreamKind::kSignals)
    appendSignalJson(out, results, sequence, link);
  else
    appendTactileSensorJson(out, *results.frame, sequence);
}

std::vector<std::string> streamedDatagrams(StreamKind kind,
                                           const LiveResults& results,
                                           std::uint64_t sequence,
                                           const LinkHealth* link) {
  if (kind == StreamKind::kTactile)
    return tactileSensorMessages(*results.frame, sequence, kMaxDatagramBytes);
  std::string object;
  std::vector<JsonMember> members;
  appendSignalJson(object, results, sequence, link, &members);
  return signalDatagrams(object, members);
}

struct LiveStream::Foxglove {
  Foxglove(const HandDescription& hand, FoxgloveOptions options)
      : messages(hand, options.image), server(std::move(options.server), messages.channels()) {}

  void send(const LiveResults& results, RecentLink& link) {
    const TactileFrame& frame = *results.frame;
    const std::int64_t nowUs = frame.hostUs;
    const std::uint64_t number = sequence++;
    const auto beforeUs = std::exchange(frameUs, nowUs);
    if (beforeUs && nowUs <= *beforeUs)  // a recording that is played again
      gaps.reset();
    // Makes only messages that a client wants. Returns whether there was one.
    const auto publish =
        [&](std::optional<std::size_t> channel, std::int64_t us, const auto& make) {
          if (!channel || !server.wanted(*channel)) return false;
          server.publish(*channel, us, make());
          return true;
        };
    if (gaps.afterGap(nowUs))
      publish(messages.eventsChannel(), nowUs, [&] {
        const std::string text =
            "no frame for " + fixedText(1e-6 * static_cast<double>(nowUs - *beforeUs), 1) + " s";
        return messages.event({*beforeUs, nowUs, "gap", std::nullopt, text, ""});
      });
    for (std::size_t m = 0; m < messages.numImages(); ++m)
      publish(m, nowUs, [&] { return messages.image(frame, m); });
    publish(messages.signalsChannel(), nowUs, [&] {
      std::string object;
      appendSignalJson(object, results, number, link.at(nowUs));
      return object;
    });
    // Angles come less often than frames, or more often: each sample is sent once.
    if (const auto& angles = results.angles;
        angles && angles->hostUs != anglesUs &&
        publish(messages.jointsChannel(), angles->hostUs, [&] { return messages.joints(*angles); }))
      anglesUs = angles->hostUs;
    if (!std::exchange(shapesSent, true))
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

  void send(const Event& event) {
    const std::size_t channel = messages.eventsChannel();
    if (server.wanted(channel)) server.publish(channel, event.tUs, messages.event(event));
  }

  FoxgloveMessages messages;
  FoxgloveServer server;
  std::uint64_t sequence = 0;
  bool shapesSent = false;
  std::int64_t anglesUs = -1;  // stamp of the angles that were sent last
  GapDetector gaps;
  std::optional<std::int64_t> frameUs;  // stamp of the last frame
};

LiveStream::LiveStream(HandDescription hand, LinkHealthQuery askLink)
    : hand_(std::move(hand)), link_(std::move(askLink)) {}

LiveStream::~LiveStream() = default;

void LiveStream::switchOn(StreamKind kind, std::uint16_t port) {
  auto sender = std::make_unique<DatagramSender>(port);
  const std::lock_guard lock(mutex_);
  streams_.at(placeOf(kind)) = {std::move(sender), 0};
}

void LiveStream::switchOff(StreamKind kind) {
  const std::lock_guard lock(mutex_);
  streams_.at(placeOf(kind)).sender.reset();
}

bool LiveStream::on(StreamKind kind) const { return stats(kind).has_value(); }

std::optional<DatagramStats> LiveStream::stats(StreamKind kind) const {
  const std::lock_guard lock(mutex_);
  const Stream& stream = streams_.at(placeOf(kind));
  if (!stream.sender) return {};
  return stream.sender->stats();
}

// The old server ends before the new one listens, because both may have the same port.
void LiveStream::switchOn(FoxgloveOptions options) {
  switchOffFoxglove();
  auto foxglove = std::make_unique<Foxglove>(hand_, std::move(options));
  const std::lock_guard lock(mutex_);
  foxglove_ = std::move(foxglove);
}

// The goodbye does not make senders wait.
void LiveStream::switchOffFoxglove() {
  std::unique_ptr<Foxglove> old;
  const std::lock_guard lock(mutex_);
  old.swap(foxglove_);
}

std::optional<FoxgloveServerStats> LiveStream::foxgloveStats() const {
  const std::lock_guard lock(mutex_);
  if (!foxglove_) return {};
  return foxglove_->server.stats();
}

std::string LiveStream::foxgloveUrl() const {
  const std::lock_guard lock(mutex_);
  return foxglove_ ? foxglove_->server.url() : std::string();
}

std::string LiveStream::geometryProblem() const {
  const std::lock_guard lock(mutex_);
  return foxglove_ ? foxglove_->messages.geometryProblem() : std::string();
}

void LiveStream::send(const LiveResults& results) {
  const std::lock_guard lock(mutex_);
  for (const StreamKind kind : kAllStreamKinds) {
    Stream& stream = streams_.at(placeOf(kind));
    if (!stream.sender) continue;
    const LinkHealth* link =
        kind == StreamKind::kSignals ? link_.at(results.frame->hostUs) : nullptr;
    for (const std::string& part : streamedDatagrams(kind, results, stream.sequence++, link))
      stream.sender->send(part);
  }
  if (foxglove_) foxglove_->send(results, link_);
}

void LiveStream::send(const Event& event) {
  const std::lock_guard lock(mutex_);
  if (foxglove_) foxglove_->send(event);
}

}  // namespace palpate
