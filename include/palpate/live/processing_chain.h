// Live processing: what a capture session delivers goes through the stages, in order of time, on a
// thread of its own. The newest results wait in a mailbox for the screen; what happened goes to a
// sink of events.
//
//   CaptureSession --> CaptureQueue (bounded, counts) --> stages --> newest results, events
//
// Results depend on what came alone, not on when: the same items give the same results bit by bit,
// live, replayed or offline (runOver()).
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
  // Frames that may wait: half a second at 31.7/s. More is late rather than right; what doesn't fit
  // is skipped, counted, and told to the stages by an event "gap".
  std::size_t waitingFrames = 16;
  // Nothing is skipped, the source waits instead: for a replay that can.
  bool lossless = false;
  // Told of every frame's results, in order; on the processing thread. May be empty.
  std::function<void(const LiveResults&)> onResults;
  // Told of what stages found; on the processing thread. May be empty.
  std::function<void(const RecordingEvent&)> onEvent;
};

struct ChainStats {
  std::uint64_t frames = 0;   // processed
  std::uint64_t skipped = 0;  // frames that came and weren't
  double lastUs = 0.0;        // what the stages took for the newest frame [us]
  double longestUs = 0.0;     // for any [us]
};

class ProcessingChain {
 public:
  // Throws std::invalid_argument: no stage, no waiting frame.
  explicit ProcessingChain(std::vector<std::unique_ptr<Stage>> stages, ChainOptions options = {});
  ~ProcessingChain();  // stops
  ProcessingChain(const ProcessingChain&) = delete;
  ProcessingChain& operator=(const ProcessingChain&) = delete;

  // Listens to a session from now on, instead of another one; stages are reset. Not while start()ed
  // (std::logic_error). The session may end before the chain.
  void connect(CaptureSession& session);
  // run() on a thread of its own, until stop(); both do nothing when that is so already.
  void start();
  void stop() noexcept;
  // Processes what comes until a stop is asked for, or a stage throws.
  void run(const std::stop_token& stop);
  // Processes what waits now; returns how many frames. For those who have their own thread.
  std::size_t step();
  // All of a profile and its events through the stages, from a fresh start, in the caller's thread:
  // as a replay of it would be. Throws Cancelled, Error (a frame that can't be read),
  // std::logic_error (started).
  void runOver(const Profile& profile,
               std::vector<RecordingEvent> events = {},
               const Progress& progress = {});

  // What is newer than at the last call; nothing when there is nothing new.
  std::optional<LiveResults> take() { return newest_.take(); }
  ChainStats stats() const;
  // Why processing ended by itself; empty: it didn't.
  std::string failure() const;

 private:
  void reset();
  void process(const CaptureItem& item);
  void processFrame(const SharedFrame& frame);
  std::size_t processWaiting();

  const std::vector<std::unique_ptr<Stage>> stages_;
  const ChainOptions options_;
  std::shared_ptr<CaptureQueue> queue_;
  std::vector<CaptureItem> items_;  // held back
  std::vector<RecordingEvent> found_;
  std::optional<JointAngles> angles_;
  std::optional<Temperatures> temperatures_;
  LatestValue<LiveResults> newest_;

  mutable std::mutex mutex_;
  ChainStats stats_;
  std::string failure_;
  std::jthread thread_;
};

}  // namespace palpate
