// One question, one answer with the SDH-2's motion controller, whatever the line does to them:
// finds the answer that belongs to the question, brings a line that lost bytes back into step, asks
// again.
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

namespace palpate {

struct SdhRetryPolicy {
  std::chrono::milliseconds timeout{1000};  // of one try
  int tries = 3;
  bool abortsForStop = true;  // gives up for a stop
};

class SdhLink {
 public:
  using Bytes = std::span<const std::byte>;
  // Whether the content of an answer is plausible; one that isn't is dropped and counted.
  using LineCheck = std::function<bool(const SdhLine&)>;
  using RecordCheck = std::function<bool(const std::vector<double>&)>;

  SdhLink(ByteChannel& channel, const Clock& clock, std::function<bool()> urgent);

  // Sends a line and returns the answer to it: the line NAME=.. with `axis`, or the values of the
  // record.
  SdhLine ask(const std::string& request,
              std::string_view name,
              std::optional<int> axis,
              const LineCheck& check,
              const SdhRetryPolicy& retryPolicy = {});
  std::vector<double> askRecord(SdhCommand command,
                                std::span<const double> values,
                                const RecordCheck& check);
  // Puts `stop` on the wire before anything else, and waits for STOP; where that doesn't come in
  // time, any other line will do.
  void stop();
  // Ends a command of the hand that was received in part, and waits until nothing comes any more.
  // `thorough` also fills up a binary record that was received in part.
  void resync(bool thorough);
  // Sends nothing; what comes until `silence` long nothing came, or `limit` is over, is discarded.
  void drain(std::chrono::milliseconds silence, std::chrono::milliseconds limit);
  void sendText(std::string_view text);

  // Sees every byte that is read, while set.
  void watch(std::function<void(Bytes)> watcher) { watcher_ = std::move(watcher); }
  SdhStats stats() const noexcept;
  // After a failure: the question may have been lost or garbled on its way.
  bool mayBeLost() const noexcept;
  [[noreturn]] void fail(DeviceFault fault, const std::string& message) const;

 private:
  enum class ReplyMatch { kStray, kAnswer, kImplausible };
  using ReplyMatcher = std::function<ReplyMatch(SdhReply&)>;

  // The answer, after as many tries as `patience` has.
  SdhReply exchange(Bytes request,
                    const std::string& what,
                    const ReplyMatcher& match,
                    const SdhRetryPolicy& retryPolicy);
  // One try; nothing: silence, or an answer that can't be used (problem_ says which).
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
  std::vector<std::byte> buffer_;
  std::vector<SdhReply> replies_;  // of the last read
  SdhStats stats_;
  bool needsResync_ = false;  // an answer may still be on its way: resync first
  // Why the last try failed.
  enum class FailureCause {
    kSilence,
    kBroken,
    kImplausible,
    kRefused
  } problem_ = FailureCause::kSilence;
  int errorCode_ = 0;
};

}  // namespace palpate
