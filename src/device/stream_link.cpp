#include "device/stream_link.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"

#include "device/silence.h"
#include "device/stream_source.h"

namespace palpate {
namespace {

constexpr std::chrono::milliseconds kReadWait{50};
constexpr std::size_t kReadBytes = 1U << 16;  // the largest datagram fits
constexpr std::int64_t kStreamSilentUs =
    500'000;                                  // without a frame for this time, the stream is silent
constexpr double kStreamSilentPeriods = 3.0;  // or for three periods if that is longer
constexpr std::int64_t kFaultShownUs = 2'000'000;
constexpr std::int64_t kFaultAlarmEveryUs = 10'000'000;
// Of two senders nearly each frame is another numbering: it is one event until this time passes
// without any.
constexpr std::int64_t kRenumberedAgainUs = 10'000'000;
// A clock that jumps again and again is one event until this time passes without any jump.
constexpr std::int64_t kClockAgainUs = 10'000'000;
// Losses that follow each other faster are one event.
constexpr std::int64_t kLossEveryUs = 100'000;
// Frames that waited longer than this in a connection are told.
constexpr std::int64_t kPileUs = 300'000;
constexpr std::size_t kMaxRemarks = 100;
constexpr double kImplausibleSpeed = 10.0;
constexpr double kRateWeight = 0.05;

StreamLineOptions lineOptionsOf(const StreamDeviceOptions& device,
                                const StreamLinkOptions& options) {
  return {.time = device.time,
          .acceptNumbers = device.format != StreamFormat::kJson,
          .acceptJson = device.format != StreamFormat::kLines,
          .startsInside = options.startsInside,
          .placesOfLabels = device.placesOfLabels};
}

std::string secondsText(std::int64_t us) {
  return numberText(std::round(static_cast<double>(us) / 1e5) / 10.0) + " s";
}

Event frameGap(std::int64_t fromUs,
               std::int64_t toUs,
               std::optional<std::uint64_t> missing,
               bool estimated) {
  return gapEventOf({fromUs, toUs, missing, estimated}, "frames", "frame");
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

std::string StreamLink::lastOutOfRange() const {
  std::lock_guard lock(mutex_);
  return lastOutOfRange_;
}

std::vector<std::string> StreamLink::remarks() const {
  std::lock_guard lock(mutex_);
  return remarks_;
}

std::optional<Event> StreamLink::openGap(std::int64_t untilUs) const {
  std::lock_guard lock(mutex_);
  if (!openGap_) return std::nullopt;
  const std::int64_t toUs = std::min(untilUs, openGap_->closedUs.value_or(untilUs));
  const std::int64_t gapUs = toUs - openGap_->fromUs;
  if (gapUs < kStreamSilentUs) return std::nullopt;
  std::optional<std::uint64_t> missing;
  if (openGap_->periodUs > 0.0) missing = missingIn(gapUs, openGap_->periodUs, false);
  return frameGap(openGap_->fromUs, toUs, missing, /*estimated=*/true);
}

// --- The connection

void StreamLink::forget() {
  session_ = {};
  earlierLines_.reset();
  std::lock_guard lock(mutex_);
  description_ = {};
  lastFault_.clear();
  lastOutOfRange_.clear();
  remarks_.clear();
  openGap_.reset();
}

void StreamLink::connect(ByteChannel& channel) {
  channel_ = &channel;
  formatFound_ = format_ != StreamFormat::kAuto;
  lines_.reset();
  packets_.reset();
  if (format_ != StreamFormat::kBinary)
    lines_ = std::make_unique<StreamLineParser>(shape_, lineOptions_);
  if (lines_ && earlierLines_) lines_->knowLabelsOf(*earlierLines_);
  if (format_ == StreamFormat::kAuto || format_ == StreamFormat::kBinary)
    packets_ = std::make_unique<StreamPacketParser>(shape_);
  session_.lastFrameUs = clock_.monotonicUs();
  session_.connectedUs = time_.nowUs();
  session_.frameSinceConnect = false;
  session_.silent = false;
  session_.notesReported = 0;
  session_.closedUs.reset();
  session_.readsPile = options_.source != nullptr && options_.source->waitedUs() > kPileUs;
  session_.framesBeforePile = session_.frames;
  publishGap();
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
  session_.before.outOfRange += now.outOfRange;
  session_.before.skippedBytes += now.skippedBytes;
  watchRemarks();
  if (lines_) earlierLines_ = std::move(lines_);
  packets_.reset();
  reportLoss(/*atOnce=*/true);
  const bool isClosed = channel_->atEnd();
  if (isClosed) session_.closedUs = time_.nowUs();
  channel_ = nullptr;
  beginGap(isClosed);
}

void StreamLink::ended() {
  reportLoss(/*atOnce=*/true);
  if (session_.gapFromUs && !session_.gapIsEnd)
    endGap(session_.closedUs.value_or(time_.nowUs()), std::nullopt, /*frameReceived=*/false);
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
  endPile(got);
  watchRemarks();
  reportLoss(/*atOnce=*/false);
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
  // What came last is half a line or packet, unless it was this program that ended.
  if (lines_ && !stopping()) lines_->cutOff(sink);
  if (packets_) packets_->flush(sink);
}

// --- Items

void StreamLink::take(const StreamItem& item) {
  switch (item.kind) {
    case StreamItemKind::kFrame:
      return takeFrame(item);
    case StreamItemKind::kAngles:
      return sink_->onSample(
          {stampAfter(session_.lastAnglesUs), {item.numbers.begin(), item.numbers.end()}});
    case StreamItemKind::kTemperatures:
      return sink_->onSample({stampAfter(session_.lastTemperaturesUs),
                              {item.numbers.begin(), item.numbers.end()},
                              kTemperatureSeries});
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
  const FrameNumbers::Step step = stepOf(item, nowUs);
  if (step.late || step.repeated) {
    ++session_.refused;
    session_.refusedWhy = "frame " + std::to_string(item.sequence.value_or(0)) +
                          (step.late ? " arrived after later ones: it was left out"
                                     : " arrived again: the second one was left out");
    return;
  }
  const std::int64_t beforeUs = session_.lastStampUs;
  TactileFrame frame(hand_.layout);
  frame.stored().assign(item.values.begin(), item.values.end());
  frame.hostUs = stampAfter(session_.lastStampUs);
  const std::int64_t hostUs = frame.hostUs;
  const auto deviceUs = deviceTime(item, nowUs);
  frame.deviceUs = deviceUs;
  if (deviceUs) measureAge(hostUs, *deviceUs);
  if (session_.gapFromUs) {
    endGap(hostUs, step.missing, /*frameReceived=*/true);
  } else {
    measureRate(nowUs);
    noteLoss(beforeUs, hostUs, step.missing.value_or(0));
  }
  session_.lastFrameUs = nowUs;
  session_.frameSinceConnect = true;
  session_.silent = false;
  ++session_.frames;
  const bool showsFault = session_.faultUs != 0 && nowUs - session_.faultUs < kFaultShownUs;
  updateStatus([&](PortStatus& status) {
    status.lost += step.missing.value_or(0);
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
    eventNow("link", "frame numbering restarted: the sender was restarted, or a second one sends");
  return step;
}

std::optional<std::int64_t> StreamLink::deviceTime(const StreamItem& item,
                                                   std::int64_t monotonicUs) {
  if (!item.deviceUs) return std::nullopt;
  const std::int64_t deviceUs = session_.clock.next(*item.deviceUs, monotonicUs);
  if (session_.clock.restarted() && !session_.speedReported) {
    const auto before = std::exchange(session_.clockReportedUs, monotonicUs);
    if (!before || monotonicUs - *before >= kClockAgainUs)
      eventNow("link", "the sender's clock jumped or restarted");
    minOffsetUs_ = {};
  }
  if (!options_.isInput && !session_.speedReported) {
    const auto speed = session_.clock.speed();
    const bool implausible =
        (speed && (*speed > kImplausibleSpeed || *speed < 1.0 / kImplausibleSpeed));
    if (implausible) {
      session_.speedReported = true;
      remark("the sender's clock runs " + fixedText(*speed, *speed < 1.0 ? 4 : 0) +
                 " times as fast as this machine's: is the unit of its times right?",
             "alarm");
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

// --- Faults and silence

StreamLink::Counts StreamLink::countsOfConnection() const {
  Counts counts;
  if (lines_) {
    counts.refused += lines_->stats().refused;
    counts.outOfRange += lines_->stats().outOfRange;
    counts.skippedBytes += lines_->stats().skippedBytes;
  }
  // While the form is not known, every line would also be bytes outside of packets.
  if (packets_ && formatFound_) {
    counts.badChecksums += packets_->stats().badChecksums;
    counts.refused += packets_->stats().refused + packets_->stats().badLengths;
    counts.outOfRange += packets_->stats().outOfRange;
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
    status.outOfRange = session_.before.outOfRange + now.outOfRange;
    status.skippedBytes = session_.before.skippedBytes + now.skippedBytes;
  });
}

// A refused line or packet is shown for two seconds, and reported at most every ten.
void StreamLink::watchFaults() {
  const Counts counts = countsOfConnection();
  watchOutOfRange(counts);
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
  {
    std::lock_guard lock(mutex_);
    lastFault_ = fault;
  }
  showFault(fault, more - 1, session_.alarmUs);
}

// Values outside of the description are shown and reported in the same way; the first one is also
// a remark, which says what to do.
void StreamLink::watchOutOfRange(const Counts& counts) {
  const std::uint64_t outOfRange = session_.before.outOfRange + counts.outOfRange;
  if (outOfRange <= session_.reportedOutOfRange) return;
  const std::uint64_t more = outOfRange - session_.reportedOutOfRange;
  const std::string& text = lines_ && lines_->stats().outOfRange > 0 ? lines_->lastOutOfRange()
                                                                     : packets_->lastOutOfRange();
  {
    std::lock_guard lock(mutex_);
    lastOutOfRange_ = text;
  }
  if (std::exchange(session_.reportedOutOfRange, outOfRange) == 0) {
    session_.outOfRangeUs = clock_.monotonicUs();
    return remark(text +
                      "; such values are kept: does the description of the hand fit (full_scale "
                      "in hand.json)?",
                  "alarm");
  }
  showFault(text, more - 1, session_.outOfRangeUs);
}

void StreamLink::showFault(const std::string& text,
                           std::uint64_t more,
                           std::optional<std::int64_t>& reportedUs) {
  session_.faultUs = clock_.monotonicUs();
  updateStatus([&](PortStatus& status) { status.message = escapedLine(port_ + ": " + text); });
  if (reportedUs && session_.faultUs - *reportedUs < kFaultAlarmEveryUs) return;
  reportedUs = session_.faultUs;
  eventNow("alarm", text + (more > 0 ? " (and " + std::to_string(more) + " before it)" : ""));
}

// --- What the user should know of the sender

void StreamLink::remark(const std::string& text, const std::string& kind) {
  eventNow(kind, text);
  std::lock_guard lock(mutex_);
  if (remarks_.size() < kMaxRemarks) remarks_.push_back(text);
}

void StreamLink::watchRemarks() {
  if (lines_ && !session_.guessReported && !lines_->guess().empty()) {
    session_.guessReported = true;
    remark(lines_->guess());
  }
  // Only this thread writes remarks_.
  if (lines_)
    for (; session_.notesReported < lines_->notes().size(); ++session_.notesReported) {
      const std::string& note = lines_->notes()[session_.notesReported];
      if (std::ranges::find(remarks_, note) == remarks_.end()) remark(note);
    }
  if (options_.source == nullptr) return;
  if (const std::string text = options_.source->takeRemark(); !text.empty()) remark(text);
}

// The frames that waited were read when a read did not fill the buffer.
void StreamLink::endPile(std::size_t got) {
  if (!session_.readsPile || got == buffer_.size()) return;
  session_.readsPile = false;
  const std::uint64_t waited = session_.frames - session_.framesBeforePile;
  if (waited < 2) return;
  remark(counted(waited, "frame") + " had waited up to " +
         secondsText(options_.source->waitedUs()) +
         " until the sender was read: their times are those at which they were read");
}

// --- Silence and loss

void StreamLink::watchSilence() {
  const std::int64_t nowUs = clock_.monotonicUs();
  const auto limitUs = std::max(
      kStreamSilentUs, static_cast<std::int64_t>(kStreamSilentPeriods * session_.periodUs));
  if (session_.silent || nowUs - session_.lastFrameUs < limitUs) return;
  if (packets_) packets_->flush([this](const StreamItem& item) { take(item); });
  if (nowUs - session_.lastFrameUs < limitUs) return;
  session_.silent = true;
  if (session_.gapFromUs && session_.gapIsEnd) beginGapOfConnection();
  beginGap(/*isEnd=*/false);
  setState(PortState::kSilent,
           port_ + ": no frames for " + secondsText(nowUs - session_.lastFrameUs) + "; " +
               whySilent(nowUs));
  eventNow("alarm", "no frames from the stream");
}

// Why no frames come, as far as it is known.
std::string StreamLink::whySilent(std::int64_t monotonicUs) const {
  // What was refused before the last frame, or with it, is no cause.
  if (monotonicUs - session_.faultUs < kFaultShownUs &&
      session_.faultUs - session_.lastFrameUs > kStreamSilentUs / 2)
    return lastFault();
  if (lines_ && lines_->pendingBytes() > 0)
    return counted(lines_->pendingBytes(), "byte") + " came without the end of a line";
  const std::string holder = options_.source ? options_.source->holderText() : std::string();
  return (holder.empty() ? "" : holder + "; ") + "is the sender running?";
}

void StreamLink::beginGap(bool isEnd) {
  if (!session_.gapFromUs && session_.lastStampUs != 0) {
    session_.gapFromUs = session_.lastStampUs;
    session_.gapIsEnd = isEnd;
  }
  publishGap();
}

// The sender closed its connection and came back, but sends nothing: frames are missing since then.
void StreamLink::beginGapOfConnection() {
  const std::int64_t fromUs = std::max(session_.connectedUs, *session_.gapFromUs);
  endGap(fromUs, std::nullopt, /*frameReceived=*/false);
  session_.gapFromUs = fromUs;
}

void StreamLink::publishGap() {
  std::lock_guard lock(mutex_);
  openGap_.reset();
  if (session_.gapFromUs && !session_.gapIsEnd)
    openGap_ = {*session_.gapFromUs, session_.periodUs, session_.closedUs};
}

void StreamLink::endGap(std::int64_t nowUs,
                        std::optional<std::uint64_t> missing,
                        bool frameReceived) {
  const std::int64_t fromUs = *std::exchange(session_.gapFromUs, std::nullopt);
  const bool wasClosed = std::exchange(session_.gapIsEnd, false);
  publishGap();
  const bool estimated = !missing && !wasClosed;
  if (!missing && wasClosed) missing = 0;
  if (estimated && session_.periodUs > 0.0) {
    missing = missingIn(nowUs - fromUs, session_.periodUs, frameReceived);
    updateStatus([&](PortStatus& status) {
      status.lost += *missing;
      status.estimatedLost += *missing;
    });
  }
  sink_->onEvent(frameGap(fromUs, nowUs, missing, estimated));
}

// Missing frames between two that came.
void StreamLink::noteLoss(std::int64_t fromUs, std::int64_t toUs, std::uint64_t missing) {
  if (missing == 0) return;
  if (session_.lossFrames == 0) session_.lossFromUs = fromUs;
  session_.lossToUs = toUs;
  session_.lossFrames += missing;
  reportLoss(/*atOnce=*/false);
}

void StreamLink::reportLoss(bool atOnce) {
  if (session_.lossFrames == 0) return;
  const std::int64_t nowUs = clock_.monotonicUs();
  if (!atOnce && session_.lossReportedUs && nowUs - *session_.lossReportedUs < kLossEveryUs) return;
  session_.lossReportedUs = nowUs;
  const std::uint64_t missing = std::exchange(session_.lossFrames, 0);
  Event event = frameGap(session_.lossFromUs, session_.lossToUs, missing, false);
  event.text = counted(missing, "frame") + (missing == 1 ? " is missing" : " are missing");
  sink_->onEvent(std::move(event));
}

}  // namespace palpate
