// Live processing: sends the items of a capture session through the stages in order of time, on a
// thread of its own. The newest results wait in a mailbox for the display; events go to a callback.
//
//   CaptureSession --> CaptureQueue (bounded, counts) --> stages --> newest results, events
//
// Results depend only on the items, not on their arrival times: the same items give the same
// results bit by bit, live, replayed or offline (runOver()).
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include <palpate/capture/capture_session.h>
#include <palpate/core/latest_value.h>
#include <palpate/core/progress.h>
#include <palpate/live/stage.h>
#include <palpate/model/profile.h>

namespace palpate {

struct ChainOptions {
  // Number of frames that may wait: half a second at 31.7 frames/s. A longer queue would only delay
  // the results. Frames that don't fit are skipped and counted, and the stages receive an event
  // "gap".
  std::size_t waitingFrames = 16;
  // True: no frame is skipped, the source waits instead (for a replay, which can wait).
  bool lossless = false;
  // The series of the source beside those of the hand, by their index from kHandSeries on. Called
  // on the processing thread when a sample comes whose series isn't known yet; one that it doesn't
  // describe is "series_2", with the columns "1", "2", .. May be empty.
  std::function<std::vector<SeriesDescription>()> furtherSeries;
  // Called with the results of every frame, in order, on the processing thread. May be empty.
  std::function<void(const LiveResults&)> onResults;
  // Called with every sample of the series beside those of the hand, in order of time among the
  // frames, on the processing thread. May be empty.
  std::function<void(const FurtherSample&)> onFurther;
  // Called with every event found by a stage, on the processing thread. May be empty.
  std::function<void(const Event&)> onEvent;
};

struct ChainStats {
  std::uint64_t frames = 0;   // processed
  std::uint64_t skipped = 0;  // frames that arrived but were not processed
  // Computing time of all stages for the newest frame [us].
  double lastUs = 0.0;
  double longestUs = 0.0;  // longest such time [us]
};

class ProcessingChain {
 public:
  // Throws std::invalid_argument if there is no stage or no waiting frame is allowed.
  explicit ProcessingChain(std::vector<std::unique_ptr<Stage>> stages, ChainOptions options = {});
  ~ProcessingChain();  // stops
  ProcessingChain(const ProcessingChain&) = delete;
  ProcessingChain& operator=(const ProcessingChain&) = delete;

  // Subscribes to a session and leaves the previous one; stages are reset. Throws std::logic_error
  // while started. The session may end before the chain.
  void connect(CaptureSession& session);
  // start() runs run() on a thread of its own until stop(). Both have no effect if already done.
  void start();
  void stop() noexcept;
  // Processes items until a stop is requested or a stage throws.
  void run(const std::stop_token& stop);
  // Processes all waiting items; returns the number of frames. For callers with a thread of their
  // own.
  std::size_t step();
  // Sends a whole profile and its events through the reset stages, in the caller's thread, with the
  // same results as its replay. Throws Cancelled, Error (a frame that can't be read),
  // std::logic_error (started).
  void runOver(const Profile& profile,
               std::vector<Event> events = {},
               const Progress& progress = {});

  // The newest results; empty when there are none since the last call.
  std::optional<LiveResults> take() { return newest_.take(); }
  ChainStats stats() const;
  // Reason why processing ended because of an error; empty otherwise.
  std::string failure() const;

 private:
  void reset();
  void process(const CaptureItem& item);
  const FurtherSample& takeFurther(const Sample& sample);
  void forgetRemoved();
  void processFrame(const SharedFrame& frame);
  std::size_t processWaiting();

  const std::vector<std::unique_ptr<Stage>> stages_;
  const ChainOptions options_;
  std::shared_ptr<CaptureQueue> queue_;
  std::vector<CaptureItem> items_;  // held back
  std::vector<Event> found_;
  std::optional<Sample> angles_;
  std::optional<Sample> temperatures_;
  std::vector<FurtherSample> further_;
  std::function<std::vector<SeriesDescription>()> furtherSeries_;
  LatestValue<LiveResults> newest_;

  mutable std::mutex mutex_;
  ChainStats stats_;
  std::string failure_;
  std::jthread thread_;
};

}  // namespace palpate
