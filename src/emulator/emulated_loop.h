// Thread of an emulated hand: advances its time, moves bytes between the ports and the two servers,
// and executes calls of other threads.
#pragma once

#include <atomic>
#include <deque>
#include <future>
#include <mutex>
#include <stop_token>
#include <thread>

#include "palpate/core/file_descriptor.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/emulator/emulated_hand.h"

#include "emulator/emulated_port_channel.h"

namespace palpate {

class EmulatedHand::Loop {
 public:
  Loop(std::unique_ptr<HandModel> model, EmulatedHandOptions options, FrameObserver observer);
  ~Loop();
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  // Runs `work` in the hand's thread and waits for it; rethrows its exceptions.
  void call(std::function<void()> work);
  EmulatedHandCounts counts() const;
  std::vector<SentFrame> sentFrames() const;
  std::string dsaSerial() const { return hexDigits(options_.dsa.serial, kSerialDigits); }
  std::string sdhSerial() const { return options_.sdh.serial; }

  // To be used only within call().
  EmulatedPortChannel& dsaLane() noexcept { return dsaLane_; }
  EmulatedPortChannel& sdhLane() noexcept { return sdhLane_; }
  HandModel& model() noexcept { return *model_; }
  void powerCycle(double bootS);
  void setFaults(const Faults& faults);

 private:
  static constexpr int kSerialDigits = 8;
  // The end of an outage must undo exactly what its begin did, so both times are stored.
  struct ScheduledOutage {
    std::int64_t beginUs = 0, endUs = 0;
    bool unplug = false;
    bool begun = false;
  };
  std::int64_t nowUs() const;
  void run(const std::stop_token& stop);
  void runCalls();
  void step();
  void planIncidents(const Faults& faults, std::int64_t fromUs);
  bool incidents(std::int64_t nowUs);
  void receive(std::int64_t nowUs);
  void advance();
  void forwardTactile(std::int64_t nowUs);
  void forwardMotion(std::int64_t nowUs);
  bool somethingIsDue(std::int64_t nowUs) const;
  bool jumpToNextFrame();
  void endCut(EmulatedPortChannel& lane, std::int64_t& sinceUs);
  void collect();
  void wait();
  std::int64_t waitUs(std::int64_t nowUs);
  void wake() noexcept;

  EmulatedHandOptions options_;
  FrameObserver observer_;
  std::unique_ptr<HandModel> model_;
  std::int64_t startUs_;  // monotonic time
  // Amount by which the hand's time is ahead of the clock [us].
  std::int64_t jumpedUs_ = 0;
  HostTime hostTime_;
  EmulatedPortChannel dsaLane_, sdhLane_;
  DsaServer dsa_;
  SdhServer sdh_;
  std::vector<ScheduledOutage> scheduledOutages_;
  FaultCounts faultCounts_;
  bool stalled_ = false;
  // Monotonic times of the last input from a client.
  std::int64_t dsaInputUs_ = 0, sdhInputUs_ = 0;
  std::int64_t tidiedUs_ = 0;
  // Monotonic times since when a cut line has been silent.
  std::int64_t dsaCutUs_ = 0, sdhCutUs_ = 0;
  int blockedTurns_ = 0;
  std::deque<ScannedFrame> onTheLine_;
  EmulatedHandCounts working_;

  FileDescriptor wakeUp_;  // eventfd
  std::mutex callsMutex_;
  std::deque<std::packaged_task<void()>> calls_;
  bool ended_ = false;
  mutable std::mutex countsMutex_;
  EmulatedHandCounts counts_;
  std::deque<SentFrame> sent_;
  std::atomic<std::thread::id> threadId_;
  std::jthread thread_;  // declared last: all other members exist when it starts
};

}  // namespace palpate
