#include "palpate/interop/live_stream.h"

#include <cstdlib>

#include "palpate/interop/datagrams.h"
#include "palpate/interop/signal_json.h"
#include "palpate/recording/tactile_sensor_json.h"

namespace palpate {
namespace {

constexpr std::int64_t kLinkIntervalUs = 250'000;

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

// Uses the stamps of the frames, which may jump in either direction when a new source starts.
const LinkHealth* LiveStream::linkAt(std::int64_t hostUs) {
  if (!askLink_) return nullptr;
  if (!link_ || std::abs(hostUs - askedUs_) >= kLinkIntervalUs) {
    link_ = askLink_();
    askedUs_ = hostUs;
  }
  return &*link_;
}

void LiveStream::send(const LiveResults& results) {
  const std::lock_guard lock(mutex_);
  for (const StreamKind kind : kAllStreamKinds) {
    Stream& stream = streams_.at(placeOf(kind));
    if (!stream.sender) continue;
    const std::uint64_t sequence = stream.sequence++;
    if (kind == StreamKind::kTactile) {
      for (const std::string& part : tactileDatagrams(*results.frame, sequence))
        stream.sender->send(part);
      continue;
    }
    text_.clear();
    appendStreamed(text_, kind, results, sequence, linkAt(results.frame->hostUs));
    if (text_.size() <= kMaxDatagramBytes) {
      stream.sender->send(text_);
      continue;
    }
    for (const std::string& part : signalDatagrams(text_)) stream.sender->send(part);
  }
}

}  // namespace palpate
