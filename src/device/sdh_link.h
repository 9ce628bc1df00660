// Request and answer with the SDH-2's motion controller, in spite of errors on the line: finds the
// answer that belongs to a request, resynchronises after lost bytes, and repeats the request. Used
// by SdhController.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/core/time.h"
#include "palpate/device/byte_channel.h"
#include "palpate/device/sdh_controller.h"
#include "palpate/device/sdh_reply_parser.h"

#include "device/answer_watch.h"

namespace palpate {

// The bytes that stop the hand whatever it has received before: they end a line, and with `record`
// also complete a binary record, that it received in part (blanks before a command have no
// meaning). Over a network, records have no checksum, and the hand would take blanks for values:
// `record` must be false there.
std::string_view sdhStopBytes(bool record);

struct SdhRetryPolicy {
  std::chrono::milliseconds timeout{1000};  // time limit of one try
  int tries = 3;
  bool abortsForStop = true;  // ends the exchange early for a stop
};

class SdhLink {
 public:
  using Bytes = std::span<const std::byte>;
  // Checks whether the content of an answer is plausible; implausible answers are dropped and
  // counted.
  using LineCheck = std::function<bool(const SdhLine&)>;
  using RecordCheck = std::function<bool(const std::vector<double>&)>;

  SdhLink(ByteChannel& channel, const Clock& clock, std::function<bool()> urgent);

  // Sends a request and returns its answer: the line NAME=.. with `axis`, or the values of the
  // record.
  SdhLine requestLine(const std::string& request,
                      std::string_view name,
                      std::optional<int> axis,
                      const LineCheck& check,
                      const SdhRetryPolicy& retryPolicy = {});
  std::vector<double> requestRecord(SdhCommand command,
                                    std::span<const double> values,
                                    const RecordCheck& check,
                                    const SdhRetryPolicy& retryPolicy = {});
  // Sends `stop` before anything else and waits for STOP. Returns false if another line arrived
  // instead: it may be this hand's form of confirmation, or an answer to something else.
  bool stop();
  // Ends a command that the hand has received in part, and waits until no more bytes arrive.
  // `thorough` also completes a binary record that was received in part.
  void resync(bool thorough);
  // Sends nothing; discards all bytes until none arrived for `silence`, or until `limit` has
  // passed.
  void drain(std::chrono::milliseconds silence, std::chrono::milliseconds limit);
  void sendText(std::string_view text);

  // Limits the time for which answers may be missing or not valid; 0: the retry policies alone
  // decide. With a limit each request is repeated quickly until it is over, also one that the hand
  // refuses; only requests with a single try are not repeated.
  void limitBadAnswers(std::chrono::milliseconds limit) noexcept { watch_.setLimit(limit); }

  // While set, `watcher` is called with every byte that is read.
  void watch(std::function<void(Bytes)> watcher) { watcher_ = std::move(watcher); }
  SdhStats stats() const noexcept;
  // True after a failure in which the request may have been lost or damaged.
  bool mayBeLost() const noexcept;
  [[noreturn]] void fail(DeviceFault fault, const std::string& message) const;

 private:
  enum class ReplyMatch { kStray, kAnswer, kImplausible };
  using ReplyMatcher = std::function<ReplyMatch(SdhReply&)>;

  // Returns the answer, after at most as many tries as `retryPolicy` allows.
  SdhReply exchange(Bytes request,
                    const std::string& what,
                    const ReplyMatcher& match,
                    const SdhRetryPolicy& retryPolicy);
  // One try; returns nothing after silence or an unusable answer (problem_ contains the reason).
  std::optional<SdhReply> attempt(Bytes request,
                                  const std::string& what,
                                  const ReplyMatcher& match,
                                  const SdhRetryPolicy& retryPolicy);
  std::optional<SdhReply> matchReply(const std::string& what, const ReplyMatcher& match);
  void takeError(int code, const std::string& what);
  std::size_t readOnce(std::chrono::milliseconds timeout);
  void write(Bytes bytes);
  void abortIfUrgent();
  [[noreturn]] void failExchange(const std::string& what) const;

  ByteChannel& channel_;
  const Clock& clock_;
  std::function<bool()> urgent_;
  std::function<void(Bytes)> watcher_;
  SdhReplyParser parser_;
  AnswerWatch watch_;
  std::vector<std::byte> buffer_;
  std::vector<SdhReply> replies_;  // from the last read
  SdhStats stats_;
  bool abortsForStop_ = true;  // see SdhRetryPolicy; of the present exchange
  // True when an answer may still arrive; the next exchange begins with a resync then.
  bool needsResync_ = false;
  // Reason why the last try failed.
  enum class FailureCause {
    kSilence,
    kBroken,
    kImplausible,
    kRefused
  } problem_ = FailureCause::kSilence;
  int errorCode_ = 0;
};

}  // namespace palpate
