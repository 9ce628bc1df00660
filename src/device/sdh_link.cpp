#include "device/sdh_link.h"

#include <algorithm>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/time.h"

namespace palpate {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kSdhLinkReadBytes = 1024;
constexpr milliseconds kSilence{50};      // after this time no more bytes of an old answer arrive
constexpr milliseconds kDrainLimit{300};  // limit for a line that never falls silent
constexpr milliseconds kGap{150};  // a longer gap within an answer means that the rest was lost
// A normal answer takes 3.4 ms; a stop does not wait for one that takes longer than this.
constexpr milliseconds kUrgentAfter{10};
constexpr milliseconds kSdhLinkSlice{4};  // period of calling `urgent` while waiting
constexpr milliseconds kExchangeLimit{3500};
constexpr std::size_t kLongestRecordBytes = 40;

std::span<const std::byte> bytesOf(std::string_view text) {
  return std::as_bytes(std::span<const char>(text.data(), text.size()));
}

// True for errors that mean the hand received something else than was sent; another try may
// succeed.
bool isTransmissionError(int code) {
  constexpr int kCodes[] = {7, 10, 11, 12, 13, 14, 32, 33, 34};
  return std::find(std::begin(kCodes), std::end(kCodes), code) != std::end(kCodes);
}

}  // namespace

std::string_view sdhStopBytes(bool record) {
  // As many blanks as the longest record has bytes.
  static constexpr std::string_view kStop =
      "                                        "
      " \r\nstop\r\n";
  static_assert(kStop.size() == kLongestRecordBytes + std::string_view(" \r\nstop\r\n").size());
  return record ? kStop : kStop.substr(kLongestRecordBytes);
}

SdhLink::SdhLink(ByteChannel& channel, const Clock& clock, std::function<bool()> urgent)
    : channel_(channel),
      clock_(clock),
      urgent_(std::move(urgent)),
      parser_(!channel.isNetwork()),
      buffer_(kSdhLinkReadBytes) {}

void SdhLink::fail(DeviceFault fault, const std::string& message) const {
  throw DeviceError(fault, channel_.name(), message);
}

SdhStats SdhLink::stats() const noexcept {
  SdhStats stats = stats_;
  stats.badChecksums = parser_.stats().badChecksums;
  stats.skippedBytes += parser_.stats().skippedBytes;
  return stats;
}

// --- Bytes

std::size_t SdhLink::readOnce(milliseconds timeout) {
  const std::size_t count = channel_.read(buffer_, timeout);
  stats_.bytesRead += count;
  const auto bytes = Bytes(buffer_).first(count);
  if (count > 0 && watcher_) watcher_(bytes);
  parser_.push(bytes, [this](SdhReply&& reply) { replies_.push_back(std::move(reply)); });
  return count;
}

void SdhLink::write(Bytes bytes) {
  channel_.write(bytes);
  stats_.bytesWritten += bytes.size();
}

void SdhLink::sendText(std::string_view text) { write(bytesOf(text)); }

void SdhLink::drain(milliseconds silence, milliseconds limit) {
  const std::int64_t startUs = clock_.monotonicUs();
  std::int64_t lastUs = startUs;
  for (;;) {
    const std::int64_t nowUs = clock_.monotonicUs();
    const std::int64_t leftUs = usOf(silence) - (nowUs - lastUs);
    if (leftUs <= 0 || nowUs - startUs >= usOf(limit)) break;
    const milliseconds wait(leftUs / 1000 + 1);
    if (readOnce(urgent_ ? std::min(wait, kSdhLinkSlice) : wait) > 0) lastUs = clock_.monotonicUs();
    stats_.strayReplies += replies_.size();
    replies_.clear();
    abortIfUrgent();
  }
  parser_.reset();
}

void SdhLink::resync(bool thorough) {
  ++stats_.resyncs;
  parser_.reset();
  replies_.clear();
  needsResync_ = true;
  const milliseconds silence = watch_.isLimited() ? watch_.silence() : kSilence;
  const milliseconds limit = watch_.isLimited() ? silence : kDrainLimit;
  drain(silence, limit);
  // Blanks before a command have no meaning. As many as the longest record complete a record that
  // the hand received in part; it then fails by its checksum. Network records have no checksum:
  // there the hand would take the blanks for values.
  if (thorough && !channel_.isNetwork()) sendText(std::string(kLongestRecordBytes, ' '));
  sendText(" \r\n");
  drain(silence, limit);
  needsResync_ = false;
}

// --- One question

void SdhLink::abortIfUrgent() {
  if (!abortsForStop_ || !urgent_ || !urgent_()) return;
  needsResync_ = true;
  ++stats_.stops;
  sendText(sdhStopBytes(false));
  throw SdhInterrupted(channel_.name());
}

// Returns if another try may help; otherwise throws.
void SdhLink::takeError(int code, const std::string& what) {
  errorCode_ = code;
  problem_ = FailureCause::kRefused;
  if (isTransmissionError(code) || watch_.isLimited()) return;
  needsResync_ = false;
  failExchange(what);
}

std::optional<SdhReply> SdhLink::matchReply(const std::string& what, const ReplyMatcher& match) {
  std::vector<SdhReply> replies = std::move(replies_);
  replies_.clear();
  for (SdhReply& reply : replies) {
    const auto* line = std::get_if<SdhLine>(&reply);
    if (line && line->kind == SdhLine::Kind::kDebug) {
      ++stats_.debugLines;
      continue;
    }
    if (line && line->kind == SdhLine::Kind::kError) {
      takeError(line->error, what);
      return std::nullopt;
    }
    switch (match(reply)) {
      case ReplyMatch::kStray:
        ++stats_.strayReplies;
        break;
      case ReplyMatch::kImplausible:
        ++stats_.suspect;
        problem_ = FailureCause::kImplausible;
        return std::nullopt;
      case ReplyMatch::kAnswer:
        if (const auto* record = std::get_if<SdhRecord>(&reply); record && record->status != 0) {
          takeError(record->status, what);
          return std::nullopt;
        }
        return std::move(reply);
    }
  }
  return std::nullopt;
}

std::optional<SdhReply> SdhLink::attempt(Bytes request,
                                         const std::string& what,
                                         const ReplyMatcher& match,
                                         const SdhRetryPolicy& retryPolicy) {
  replies_.clear();
  problem_ = FailureCause::kSilence;
  const SdhReplyStats before = parser_.stats();
  // The end of a long command is always awaited, even if noise looks like the begin of its answer.
  const bool quick = retryPolicy.timeout <= SdhRetryPolicy{}.timeout;
  needsResync_ = true;
  write(request);
  const std::int64_t sentUs = clock_.monotonicUs();
  const milliseconds timeout = quick && watch_.isLimited()
                                   ? std::min(retryPolicy.timeout, watch_.timeout(sentUs))
                                   : retryPolicy.timeout;
  std::int64_t heardUs = sentUs;
  bool looked = false;
  for (;;) {
    const std::int64_t nowUs = clock_.monotonicUs();
    if (nowUs - sentUs >= usOf(kUrgentAfter)) abortIfUrgent();
    const bool begun = quick && (parser_.pendingBytes() > 0 ||
                                 parser_.stats().skippedBytes != before.skippedBytes);
    const std::int64_t restUs = usOf(timeout) - (nowUs - sentUs);
    const std::int64_t leftUs = begun ? std::min(restUs, usOf(kGap) - (nowUs - heardUs)) : restUs;
    // An answer that arrived while this process stood still is looked for before it counts as
    // missing.
    if (leftUs <= 0 && std::exchange(looked, true)) {
      if (begun) problem_ = FailureCause::kBroken;
      return std::nullopt;
    }
    const milliseconds wait(std::max<std::int64_t>(leftUs, 0) / 1000 + 1);
    // Before kUrgentAfter no look is due: a usual answer then costs one wait.
    const milliseconds slice(std::max<std::int64_t>(
        kSdhLinkSlice.count(), kUrgentAfter.count() - (nowUs - sentUs) / 1000));
    if (readOnce(urgent_ ? std::min(wait, slice) : wait) == 0) continue;
    heardUs = clock_.monotonicUs();
    if (parser_.stats().badChecksums != before.badChecksums) problem_ = FailureCause::kBroken;
    if (auto answer = matchReply(what, match)) {
      needsResync_ = parser_.pendingBytes() > 0;
      return answer;
    }
    if (problem_ != FailureCause::kSilence) return std::nullopt;
  }
}

void SdhLink::failExchange(const std::string& what) const {
  switch (problem_) {
    case FailureCause::kRefused: {
      const std::string advice = sdhErrorAdvice(errorCode_);
      fail(DeviceFault::kRefused,
           "the hand refused '" + shortened(what) + "': E" + std::to_string(errorCode_) + ", " +
               sdhErrorText(errorCode_) + (advice.empty() ? "" : "; " + advice));
    }
    case FailureCause::kBroken:
      fail(DeviceFault::kProtocol,
           "the answers to '" + shortened(what) + "' arrive damaged; check cable and adapter");
    case FailureCause::kImplausible:
      fail(DeviceFault::kProtocol, "the answers to '" + shortened(what) + "' are not valid");
    case FailureCause::kSilence:
      break;
  }
  fail(DeviceFault::kSilent,
       "the motion controller gave no answer to '" + shortened(what) + "'; check cable and power");
}

bool SdhLink::mayBeLost() const noexcept {
  return problem_ != FailureCause::kRefused || isTransmissionError(errorCode_);
}

SdhReply SdhLink::exchange(Bytes request,
                           const std::string& what,
                           const ReplyMatcher& match,
                           const SdhRetryPolicy& retryPolicy) {
  const struct Restore {
    bool& flag;
    ~Restore() { flag = true; }
  } restore{abortsForStop_};
  abortsForStop_ = retryPolicy.abortsForStop;
  abortIfUrgent();
  ++stats_.exchanges;
  if (needsResync_) resync(false);
  const std::int64_t startUs = clock_.monotonicUs();
  for (int tries = 1;; ++tries) {
    const std::int64_t attemptUs = clock_.monotonicUs();
    if (auto answer = attempt(request, what, match, retryPolicy)) {
      watch_.onGood();
      return std::move(*answer);
    }
    watch_.onBad(attemptUs);
    const std::int64_t nowUs = clock_.monotonicUs();
    const bool isLast = watch_.isLimited() && retryPolicy.tries > 1
                            ? watch_.isOver(nowUs)
                            : tries >= retryPolicy.tries || nowUs - startUs > usOf(kExchangeLimit);
    if (isLast) break;
    ++stats_.retries;
    resync(tries > 1);
  }
  failExchange(what);
}

SdhLine SdhLink::requestLine(const std::string& request,
                             std::string_view name,
                             std::optional<int> axis,
                             const LineCheck& check,
                             const SdhRetryPolicy& retryPolicy) {
  const ReplyMatcher match = [&](SdhReply& reply) {
    const auto* line = std::get_if<SdhLine>(&reply);
    if (!line || line->kind != SdhLine::Kind::kValue || line->name != name || line->axis != axis)
      return ReplyMatch::kStray;
    return check(*line) ? ReplyMatch::kAnswer : ReplyMatch::kImplausible;
  };
  const std::string text = request + "\r\n";
  return std::get<SdhLine>(exchange(bytesOf(text), request, match, retryPolicy));
}

std::vector<double> SdhLink::requestRecord(SdhCommand command,
                                           std::span<const double> values,
                                           const RecordCheck& check,
                                           const SdhRetryPolicy& retryPolicy) {
  const ReplyMatcher match = [&](SdhReply& reply) {
    const auto* record = std::get_if<SdhRecord>(&reply);
    if (!record || record->command != command) return ReplyMatch::kStray;
    if (record->status != 0) return ReplyMatch::kAnswer;
    return check(record->values) ? ReplyMatch::kAnswer : ReplyMatch::kImplausible;
  };
  const auto request = sdhRecordRequest(command, values, !channel_.isNetwork());
  return std::get<SdhRecord>(exchange(request, std::string(sdhName(command)), match, retryPolicy))
      .values;
}

// --- Stop

bool SdhLink::stop() {
  ++stats_.stops;
  constexpr milliseconds kWaits[] = {milliseconds(150), milliseconds(300), milliseconds(500)};
  bool first = true, anyReply = false;
  for (const milliseconds timeout : kWaits) {
    replies_.clear();
    parser_.reset();
    // Sent in one piece before anything else; later ones also end a record that the hand received
    // in part.
    sendText(sdhStopBytes(!first && !channel_.isNetwork()));
    first = false;
    needsResync_ = true;
    const std::int64_t endUs = clock_.monotonicUs() + usOf(timeout);
    for (std::int64_t leftUs = usOf(timeout); leftUs > 0; leftUs = endUs - clock_.monotonicUs()) {
      readOnce(milliseconds(leftUs / 1000 + 1));
      for (const SdhReply& reply : replies_) {
        // An error may be the answer to a command that this one interrupted.
        const auto* line = std::get_if<SdhLine>(&reply);
        if (!line || line->kind == SdhLine::Kind::kDebug || line->kind == SdhLine::Kind::kError)
          continue;
        if (line->text.starts_with("STOP") || line->name == "STOP") {
          needsResync_ = false;
          return true;
        }
        anyReply = true;
      }
      replies_.clear();
    }
    // Another line may be the answer to an earlier request, or this hand's form of confirmation. It
    // shows that the connection works, and the next exchange begins with a resync. But such a line
    // must not confirm a stop that was lost, so the first stop is not confirmed by it.
    if (anyReply && timeout != kWaits[0]) return false;
  }
  fail(DeviceFault::kSilent,
       "'stop' was sent, but the hand doesn't confirm it: use its emergency stop if it moves");
}

}  // namespace palpate
