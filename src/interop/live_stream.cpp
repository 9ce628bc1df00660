#include "palpate/interop/live_stream.h"

#include "palpate/interop/datagrams.h"
#include "palpate/interop/signal_json.h"
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
}

}  // namespace palpate
