#include "device/stream_link.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"

namespace palpate {
namespace {

constexpr std::chrono::milliseconds kReadWait{50};
constexpr std::size_t kReadBytes = 1U << 16;  // the largest datagram fits
constexpr std::int64_t kStreamSilentUs =
    500'000;                                  // without a frame for this time, the stream is silent
constexpr double kStreamSilentPeriods = 3.0;  // or for three periods if that is longer
constexpr std::int64_t kFaultShownUs = 2'000'000;
constexpr std::int64_t kFaultAlarmEveryUs = 10'000'000;
constexpr std::int64_t kStreamOffsetWindowUs = 30'000'000;
// Of two senders nearly each frame is another numbering: it is one event until this time passes
// without any.
constexpr std::int64_t kRenumberedAgainUs = 10'000'000;
constexpr double kImplausibleSpeed = 10.0;
constexpr double kSecondUs = 1e6;
constexpr double kRateWeight = 0.05;

StreamLineOptions lineOptionsOf(const StreamDeviceOptions& device,
                                const StreamLinkOptions& options) {
  return {.time = device.time,
          .acceptNumbers = device.format != StreamFormat::kJson,
          .acceptJson = device.format != StreamFormat::kLines,
          .startsInside = options.startsInside};
}

std::string secondsText(std::int64_t us) {
  return numberText(std::round(static_cast<double>(us) / 1e5) / 10.0) + " s";
}

}  // namespace

StreamLink::StreamLink(const StreamDeviceOptions& device,
                       Open open,
                       const StreamLinkOptions& options,
                       const HostTime& time,
                       const Clock& clock)
    : PortLink(device.source, "stream", std::move(open), time, clock),
      hand_(device.hand),
      format_(device.format),
      lineOptions_(lineOptionsOf(device, options)),
      options_(options),
      shape_(device.hand),
      buffer_(kReadBytes) {}

StreamDescription StreamLink::description() const {
  std::lock_guard lock(mutex_);
  return description_;
}

std::string StreamLink::lastFault() const {
  std::lock_guard lock(mutex_);
  return lastFault_;
}

// --- The connection

void StreamLink::forget() {
  session_ = {};
  std::lock_guard lock(mutex_);
  description_ = {};
  lastFault_.clear();
}

void StreamLink::connect(ByteChannel& channel) {
  channel_ = &channel;
  formatFound_ = format_ != StreamFormat::kAuto;
  lines_.reset();
  packets_.reset();
  if (format_ != StreamFormat::kBinary)
    lines_ = std::make_unique<StreamLineParser>(shape_, lineOptions_);
  if (format_ == StreamFormat::kAuto || format_ == StreamFormat::kBinary)
    packets_ = std::make_unique<StreamPacketParser>(shape_);
  session_.lastFrameUs = clock_.monotonicUs();
  session_.frameSinceConnect = false;
  session_.silent = false;
  std::lock_guard lock(mutex_);
  description_ = {};
}

void StreamLink::disconnected() {
  endOfBytes();
  updateCounts();
  watchFaults();
  const Counts now = countsOfConnection();
  session_.before.badChecksums += now.badChecksums;
  session_.before.refused += now.refused;
  session_.before.skippedBytes += now.skippedBytes;
  lines_.reset();
  packets_.reset();
  channel_ = nullptr;
  if (!session_.gapFromUs && session_.lastStampUs != 0) session_.gapFromUs = session_.lastStampUs;
}

void StreamLink::ended() {
  if (session_.gapFromUs) endGap(time_.nowUs(), std::nullopt, /*frameReceived=*/false);
}

void StreamLink::work() {
  const std::size_t got = channel_->read(buffer_, kReadWait);
  if (stopping()) return;
  if (got > 0) {
    session_.bytes += got;
    parse(std::span(buffer_).first(got), channel_->isDatagrams());
    updateCounts();
    watchFaults();
  }
  watchSilence();
}

void StreamLink::parse(std::span<const std::byte> bytes, bool isDatagram) {
  // The first item decides the form; a parser is dropped only between two calls.
  if (lines_) {
    const auto sink = [this](const StreamItem& item) { take(item); };
    lines_->push(bytes, sink);
    if (isDatagram) lines_->endLine(sink);
    if (!formatFound_ && lines_->stats().items > 0) {
      formatFound_ = true;
      packets_.reset();
    }
  }
  if (packets_) {
    const auto sink = [this](const StreamItem& item) { take(item); };
    packets_->push(bytes, sink);
    if (isDatagram) packets_->flush(sink);
    if (!formatFound_ && packets_->stats().items > 0) {
      formatFound_ = true;
      lines_.reset();
    }
  }
}

void StreamLink::endOfBytes() {
  const auto sink = [this](const StreamItem& item) { take(item); };
  // Half a line of a broken connection may lack the last digits of a number, but the last line of
  // an input has none behind it.
  if (lines_ && options_.isInput) lines_->endLine(sink);
  if (packets_) packets_->flush(sink);
}

// --- Items

void StreamLink::take(const StreamItem& item) {
  switch (item.kind) {
    case StreamItemKind::kFrame:
      return takeFrame(item);
    case StreamItemKind::kAngles:
      return sink_->onAngles(
          {stampAfter(session_.lastAnglesUs), {item.numbers.begin(), item.numbers.end()}});
    case StreamItemKind::kTemperatures:
      return sink_->onTemperatures(
          {stampAfter(session_.lastTemperaturesUs), {item.numbers.begin(), item.numbers.end()}});
    case StreamItemKind::kDescription:
      return takeDescription(item.text);
  }
}

void StreamLink::takeDescription(std::string_view text) {
  try {
    StreamDescription described = readStreamDescription(text, shape_);
    if (!described.mismatch.empty()) {
      ++session_.refused;
      session_.refusedWhy = described.mismatch;
    }
    std::lock_guard lock(mutex_);
    description_ = std::move(described);
  } catch (const Error& error) {
    ++session_.refused;
    session_.refusedWhy = std::string("the description can't be read: ") + error.what();
  }
}

void StreamLink::takeFrame(const StreamItem& item) {
  // Only this thread writes description_.
  if (!description_.mismatch.empty()) {
    ++session_.refused;
    return;
  }
  const std::int64_t nowUs = clock_.monotonicUs();
  const auto [missing, isLate, renumbered] = stepOf(item, nowUs);
  if (isLate) {
    ++session_.refused;
    session_.refusedWhy = "frame " + std::to_string(item.sequence.value_or(0)) +
                          " arrived after later ones: it was left out";
    return;
  }
  TactileFrame frame;
  frame.layout = hand_.layout;
  frame.values.assign(item.values.begin(), item.values.end());
  frame.hostUs = stampAfter(session_.lastStampUs);
  const std::int64_t hostUs = frame.hostUs;
  const auto deviceUs = deviceTime(item, nowUs);
  if (deviceUs) {
    frame.deviceMs = floorMs(*deviceUs);
    measureAge(hostUs, *deviceUs);
  }
  if (session_.gapFromUs)
    endGap(hostUs, missing, /*frameReceived=*/true);
  else
    measureRate(nowUs);
  session_.lastFrameUs = nowUs;
  session_.frameSinceConnect = true;
  session_.silent = false;
  ++session_.frames;
  const bool showsFault = session_.faultUs != 0 && nowUs - session_.faultUs < kFaultShownUs;
  updateStatus([&, missing = missing](PortStatus& status) {
    if (missing) status.lost += *missing;
    status.items = session_.frames;
    status.lastItemUs = hostUs;
    status.state = PortState::kStreaming;
    if (!showsFault) status.message.clear();
  });
  sink_->onFrame(std::move(frame));
}

FrameNumbers::Step StreamLink::stepOf(const StreamItem& item, std::int64_t monotonicUs) {
  if (!item.sequence) return {};
  // An input may come faster than it was measured: then only the sender's clock says how much time
  // passed.
  const auto timeUs = options_.isInput ? item.deviceUs : std::optional<std::int64_t>(monotonicUs);
  const FrameNumbers::Step step =
      session_.numbers.next(*item.sequence, timeUs, channel_->isDatagrams());
  if (!step.renumbered) return step;
  const auto before = std::exchange(session_.renumberedUs, monotonicUs);
  if (!before || monotonicUs - *before >= kRenumberedAgainUs)
    eventNow("link",
             "the numbers of the frames started anew: the sender was restarted, or a second one "
             "sends");
  return step;
}

std::optional<std::int64_t> StreamLink::deviceTime(const StreamItem& item,
                                                   std::int64_t monotonicUs) {
  if (!item.deviceUs) return std::nullopt;
  const std::int64_t deviceUs = session_.clock.next(*item.deviceUs, monotonicUs);
  if (session_.clock.restarted() && !session_.speedReported) {
    eventNow("link", "the sender's clock jumped or started anew");
    session_.minOffsetUs = {};
  }
  if (!options_.isInput && !session_.speedReported) {
    const auto speed = session_.clock.speed();
    const bool implausible =
        (speed && (*speed > kImplausibleSpeed || *speed < 1.0 / kImplausibleSpeed));
    if (implausible) {
      session_.speedReported = true;
      eventNow("alarm",
               "the sender's clock runs " + fixedText(*speed, *speed < 1.0 ? 4 : 0) +
                   " times as fast as this machine's: is the unit of its times right?");
    }
  }
  return deviceUs;
}

void StreamLink::measureRate(std::int64_t monotonicUs) {
  if (session_.frames == 0 || !session_.frameSinceConnect) return;
  const auto intervalUs = static_cast<double>(monotonicUs - session_.lastFrameUs);
  session_.periodUs = session_.frames == 1
                          ? intervalUs
                          : session_.periodUs + kRateWeight * (intervalUs - session_.periodUs);
}

void StreamLink::measureAge(std::int64_t hostUs, std::int64_t deviceUs) {
  const std::int64_t offsetUs = hostUs - deviceUs;
  if (hostUs - session_.offsetWindowUs > kStreamOffsetWindowUs) {
    session_.offsetWindowUs = hostUs;
    session_.minOffsetUs[1] = std::exchange(session_.minOffsetUs[0], std::nullopt);
  }
  session_.minOffsetUs[0] = std::min(session_.minOffsetUs[0].value_or(offsetUs), offsetUs);
  const std::int64_t least = std::min(*session_.minOffsetUs[0],
                                      session_.minOffsetUs[1].value_or(*session_.minOffsetUs[0]));
  updateStatus(
      [&](PortStatus& status) { status.ageMs = static_cast<double>(offsetUs - least) / 1000.0; });
}

// --- Faults and silence

StreamLink::Counts StreamLink::countsOfConnection() const {
  Counts counts;
  if (lines_) {
    counts.refused += lines_->stats().refused;
    counts.skippedBytes += lines_->stats().skippedBytes;
  }
  // While the form is not known, every line would also be bytes outside of packets.
  if (packets_ && formatFound_) {
    counts.badChecksums += packets_->stats().badChecksums;
    counts.refused += packets_->stats().refused + packets_->stats().badLengths;
    counts.skippedBytes += packets_->stats().skippedBytes;
  }
  return counts;
}

std::string StreamLink::faultOfConnection() const {
  if (packets_ && !packets_->lastFault().empty()) return packets_->lastFault();
  return lines_ ? lines_->lastFault() : std::string();
}

void StreamLink::updateCounts() {
  const Counts now = countsOfConnection();
  updateStatus([&](PortStatus& status) {
    status.bytes = session_.bytes;
    status.badChecksums = session_.before.badChecksums + now.badChecksums;
    status.suspect = session_.before.refused + now.refused + session_.refused;
    status.skippedBytes = session_.before.skippedBytes + now.skippedBytes;
  });
}

// A refused line or packet is shown for two seconds, and reported at most every ten.
void StreamLink::watchFaults() {
  const Counts counts = countsOfConnection();
  const std::uint64_t refused = session_.before.refused + counts.refused + session_.refused +
                                session_.before.badChecksums + counts.badChecksums;
  if (refused <= session_.reportedRefused) {
    session_.reportedRefused = refused;  // less, when another form was found
    return;
  }
  const std::uint64_t more = refused - std::exchange(session_.reportedRefused, refused);
  std::string fault = std::exchange(session_.refusedWhy, "");
  if (fault.empty()) fault = faultOfConnection();
  if (fault.empty()) return;
  session_.faultUs = clock_.monotonicUs();
  {
    std::lock_guard lock(mutex_);
    lastFault_ = fault;
  }
  updateStatus([&](PortStatus& status) { status.message = escapedLine(port_ + ": " + fault); });
  if (session_.alarmUs && session_.faultUs - *session_.alarmUs < kFaultAlarmEveryUs) return;
  session_.alarmUs = session_.faultUs;
  eventNow("alarm", fault + (more > 1 ? " (and " + std::to_string(more - 1) + " before it)" : ""));
}

void StreamLink::watchSilence() {
  const std::int64_t nowUs = clock_.monotonicUs();
  const auto limitUs = std::max(
      kStreamSilentUs, static_cast<std::int64_t>(kStreamSilentPeriods * session_.periodUs));
  if (session_.silent || nowUs - session_.lastFrameUs < limitUs) return;
  if (packets_) packets_->flush([this](const StreamItem& item) { take(item); });
  if (nowUs - session_.lastFrameUs < limitUs) return;
  session_.silent = true;
  if (!session_.gapFromUs && session_.lastStampUs != 0) session_.gapFromUs = session_.lastStampUs;
  const std::string fault = lastFault();
  const bool isFaulty = session_.faultUs != 0 && nowUs - session_.faultUs < kFaultShownUs;
  setState(PortState::kSilent,
           port_ + ": no frames for " + secondsText(nowUs - session_.lastFrameUs) +
               (isFaulty ? "; " + fault : "; is the sender running?"));
  eventNow("alarm", "no frames from the stream");
}

void StreamLink::endGap(std::int64_t nowUs,
                        std::optional<std::uint64_t> missing,
                        bool frameReceived) {
  const std::int64_t fromUs = *std::exchange(session_.gapFromUs, std::nullopt);
  const std::int64_t gapUs = nowUs - fromUs;
  const bool estimated = !missing;
  if (estimated && session_.periodUs > 0.0) {
    const double periods = std::round(static_cast<double>(gapUs) / session_.periodUs);
    missing = static_cast<std::uint64_t>(std::max(periods - (frameReceived ? 1.0 : 0.0), 0.0));
    updateStatus([&](PortStatus& status) {
      status.lost += *missing;
      status.estimatedLost += *missing;
    });
  }
  const double seconds = static_cast<double>(gapUs) / kSecondUs;
  Json json = Json::object().set("seconds", seconds);
  std::string text = "no frames for " + numberText(std::round(seconds * 1000.0) / 1000.0) + " s";
  if (missing) {
    json.set("lost", static_cast<std::int64_t>(*missing)).set("estimated", estimated);
    text += std::string(estimated ? ", about " : ", ") + std::to_string(*missing) +
            " frames are missing";
  }
  event("gap", text, fromUs, nowUs, {}, json.text(-1));
}

}  // namespace palpate
