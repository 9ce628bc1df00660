#include "device/series_link.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"

#include "device/silence.h"
#include "device/stream_source.h"

namespace palpate {
namespace {

constexpr std::chrono::milliseconds kSeriesReadWait{50};
constexpr std::size_t kSeriesReadBytes = 4096;
constexpr std::size_t kLargestDatagram = 1U << 16;
// As for frames; before the rate is known a series may be a slow one.
constexpr std::int64_t kSeriesSilentUs = 500'000;
constexpr std::int64_t kFirstSilentUs = 5'000'000;
constexpr double kSeriesSilentPeriods = 3.0;
constexpr double kPeriodWeight = 0.05;
constexpr double kLongestDecay = 0.99;
constexpr std::int64_t kRowUs = 100;        // at 10,000 rows/s
constexpr std::int64_t kBurstUs = 100'000;  // rows of this time may come at once
constexpr std::int64_t kLongestWaitUs = 50'000;
constexpr std::int64_t kShownUs = 2'000'000;
constexpr std::int64_t kToldAgainUs = 10'000'000;

}  // namespace

SeriesLink::SeriesLink(const SeriesSourceOptions& options,
                       Open open,
                       StreamSource* source,
                       const HostTime& time,
                       const Clock& clock)
    : PortLink(options.source, "series " + options.name, std::move(open), time, clock),
      given_(options.columns),
      source_(source),
      lines_(given_),
      buffer_(kLargestDatagram),
      description_{options.name, "", lines_.columns(), options.source} {}

SeriesDescription SeriesLink::description() const {
  std::lock_guard lock(mutex_);
  return description_;
}

double SeriesLink::rateHz() const {
  const bool streams = status().state == PortState::kStreaming;
  std::lock_guard lock(mutex_);
  return streams && periodUs_ > 0.0 ? kUsPerS / periodUs_ : 0.0;
}

std::string SeriesLink::lastFault() const {
  std::lock_guard lock(mutex_);
  return lastFault_;
}

std::optional<Event> SeriesLink::openGap(std::int64_t untilUs) const {
  std::lock_guard lock(mutex_);
  if (!gap_ || gap_->isEnd || untilUs - gap_->fromUs < kSeriesSilentUs) return std::nullopt;
  std::optional<std::uint64_t> missing;
  if (gap_->periodUs > 0.0) missing = missingIn(untilUs - gap_->fromUs, gap_->periodUs, false);
  return gapEventOf(*gap_, untilUs, missing);
}

void SeriesLink::forget() {
  session_ = {};
  lines_ = SeriesLines(given_);
  std::lock_guard lock(mutex_);
  description_.columns = lines_.columns();
  lastFault_.clear();
  gap_.reset();
  periodUs_ = 0.0;
}

void SeriesLink::connect(ByteChannel& channel) {
  channel_ = &channel;
  lines_.beginConnection(source_ != nullptr && source_->startsInside());
  session_.lastRowUs = clock_.monotonicUs();
  session_.connectedUs = time_.nowUs();
  session_.rowSinceConnect = false;
  session_.silent = false;
}

void SeriesLink::work() {
  const std::int64_t aheadUs = session_.paidUs - clock_.monotonicUs();
  if (aheadUs > 0) return waitForCommand(clock_.monotonicUs() + std::min(aheadUs, kLongestWaitUs));
  const auto into =
      std::span(buffer_).first(channel_->isDatagrams() ? buffer_.size() : kSeriesReadBytes);
  const std::size_t got = channel_->read(into, kSeriesReadWait);
  if (stopping()) return;
  if (got > 0) {
    session_.bytes += got;
    const std::uint64_t before = session_.rows + lines_.refused();
    const auto sink = [this](const SeriesRow& row) { take(row); };
    lines_.push(into.first(got), sink);
    if (channel_->isDatagrams()) lines_.endLine(sink);
    const auto rows = static_cast<std::int64_t>(session_.rows + lines_.refused() - before);
    session_.paidUs = std::max(session_.paidUs, clock_.monotonicUs() - kBurstUs) + rows * kRowUs;
    watchFaults();
  }
  if (source_ != nullptr)
    if (const std::string text = source_->takeRemark(); !text.empty()) eventNow("link", text);
  watchSilence();
}

void SeriesLink::disconnected() {
  if (!stopping()) lines_.cutOff([this](const SeriesRow& row) { take(row); });
  watchFaults();
  beginGap(std::exchange(channel_, nullptr)->atEnd());
}

void SeriesLink::ended() {
  channel_ = nullptr;
  if (gap_ && !gap_->isEnd) endGap(time_.nowUs(), /*rowReceived=*/false);
}

void SeriesLink::take(const SeriesRow& row) {
  const std::int64_t nowUs = clock_.monotonicUs();
  if (session_.rows == 0) {
    std::lock_guard lock(mutex_);
    description_.columns = lines_.columns();
  }
  Sample sample{stampAfter(session_.lastStampUs), {row.values.begin(), row.values.end()}, series_};
  sample.deviceUs = deviceTime(row.deviceUs, nowUs);
  if (sample.deviceUs) measureAge(sample.hostUs, *sample.deviceUs);
  if (gap_)
    endGap(sample.hostUs, /*rowReceived=*/true);
  else
    measureRate(nowUs);
  session_.lastRowUs = nowUs;
  session_.rowSinceConnect = true;
  session_.silent = false;
  ++session_.rows;
  const bool showsFault = session_.faultUs != 0 && nowUs - session_.faultUs < kShownUs;
  updateStatus([&](PortStatus& status) {
    status.items = session_.rows;
    status.lastItemUs = sample.hostUs;
    status.state = PortState::kStreaming;
    if (!showsFault) status.message.clear();
  });
  sink_->onSample(std::move(sample));
}

std::optional<std::int64_t> SeriesLink::deviceTime(std::optional<std::int64_t> deviceUs,
                                                   std::int64_t nowUs) {
  if (!deviceUs) return std::nullopt;
  const std::int64_t us = session_.clock.next(*deviceUs, nowUs);
  if (!session_.clock.restarted()) return us;
  minOffsetUs_ = {};
  const auto before = std::exchange(session_.clockReportedUs, nowUs);
  if (!before || nowUs - *before >= kToldAgainUs)
    eventNow("link", "the clock of the " + what_ + " jumped or restarted");
  return us;
}

void SeriesLink::measureRate(std::int64_t nowUs) {
  if (!session_.rowSinceConnect) return;
  const auto intervalUs = static_cast<double>(nowUs - session_.lastRowUs);
  session_.longestUs = std::max(intervalUs, kLongestDecay * session_.longestUs);
  std::lock_guard lock(mutex_);
  periodUs_ = periodUs_ == 0.0 ? intervalUs : periodUs_ + kPeriodWeight * (intervalUs - periodUs_);
}

// A refused row is shown for two seconds, and reported at most every ten.
void SeriesLink::watchFaults() {
  const std::uint64_t refused = lines_.refused();
  updateStatus([&](PortStatus& status) {
    status.bytes = session_.bytes;
    status.suspect = refused;
    status.skippedBytes = lines_.skippedBytes();
  });
  if (refused == session_.reportedRefused) return;
  const std::uint64_t more = refused - std::exchange(session_.reportedRefused, refused) - 1;
  session_.faultUs = clock_.monotonicUs();
  const std::string fault = lines_.lastFault();
  {
    std::lock_guard lock(mutex_);
    lastFault_ = fault;
  }
  updateStatus([&](PortStatus& status) { status.message = escapedLine(port_ + ": " + fault); });
  if (session_.alarmUs && session_.faultUs - *session_.alarmUs < kToldAgainUs) return;
  session_.alarmUs = session_.faultUs;
  eventNow(
      "alarm",
      what_ + ": " + fault + (more > 0 ? " (and " + std::to_string(more) + " before it)" : ""));
}

void SeriesLink::watchSilence() {
  const std::int64_t silentUs = clock_.monotonicUs() - session_.lastRowUs;
  const std::int64_t limitUs =
      session_.longestUs == 0.0
          ? kFirstSilentUs
          : std::max(kSeriesSilentUs,
                     static_cast<std::int64_t>(kSeriesSilentPeriods * session_.longestUs));
  if (session_.silent || silentUs < limitUs) return;
  session_.silent = true;
  // The sender came back, but sends nothing: rows are missing since then.
  if (gap_ && gap_->isEnd) {
    const std::int64_t fromUs = std::max(session_.connectedUs, gap_->fromUs);
    endGap(fromUs, /*rowReceived=*/false);
    std::lock_guard lock(mutex_);
    gap_ = Gap{fromUs, periodUs_};
  }
  beginGap(/*isEnd=*/false);
  const std::string fault = lines_.lastFault();
  const bool isCause = session_.faultUs > session_.lastRowUs;
  setState(PortState::kSilent,
           escapedLine(port_ + ": no rows for " +
                       fixedText(static_cast<double>(silentUs) / kUsPerS, 1) + " s; " +
                       (isCause                     ? fault
                        : lines_.pendingBytes() > 0 ? counted(lines_.pendingBytes(), "byte") +
                                                          " came without the end of a line"
                                                    : "is the sender running?")));
  eventNow("alarm", "no rows from the " + what_);
}

void SeriesLink::beginGap(bool isEnd) {
  if (gap_ || session_.lastStampUs == 0) return;
  std::lock_guard lock(mutex_);
  gap_ = Gap{session_.lastStampUs, periodUs_, isEnd};
}

void SeriesLink::endGap(std::int64_t toUs, bool rowReceived) {
  Gap gap;
  {
    std::lock_guard lock(mutex_);
    gap = *std::exchange(gap_, std::nullopt);
  }
  std::optional<std::uint64_t> missing;
  if (gap.isEnd)
    missing = 0;
  else if (gap.periodUs > 0.0)
    missing = missingIn(toUs - gap.fromUs, gap.periodUs, rowReceived);
  updateStatus([&](PortStatus& status) {
    status.lost += missing.value_or(0);
    status.estimatedLost += missing.value_or(0);
  });
  sink_->onEvent(gapEventOf(gap, toUs, missing));
}

Event SeriesLink::gapEventOf(const Gap& gap,
                             std::int64_t toUs,
                             std::optional<std::uint64_t> missing) const {
  return palpate::gapEventOf(
      {gap.fromUs, toUs, missing, !gap.isEnd}, "rows of the " + what_, "sample", description_.name);
}

}  // namespace palpate
