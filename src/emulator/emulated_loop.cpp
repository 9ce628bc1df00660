#include "emulator/emulated_loop.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "palpate/core/error.h"

namespace palpate {
namespace {

constexpr std::int64_t kQuietUs = 200'000;  // an incomplete request is discarded after this silence
constexpr std::int64_t kTickUs = 50'000;    // the model's time goes on at least so often
constexpr std::int64_t kCutUs = 5000;       // time for the client to read before a hang-up
constexpr std::int64_t kTidyUs = 500'000;
// Pause before the next try on a line that accepts no bytes; doubled up to 16 times that.
constexpr std::int64_t kRetryUs = 1000;
constexpr int kMaxRetryDoublings = 4;
constexpr int kFramesPerTurn = 16;
constexpr std::size_t kRememberedFrames = 8192;
constexpr double kMinThinkUs = 2000.0, kMaxThinkUs = 3000.0;

EmulatedHandOptions completed(EmulatedHandOptions options, const HandModel& model) {
  const bool real = options.rate == EmulationRate::kReal;
  options.dsa.frameHz.reset();
  if (options.rate == EmulationRate::kFixed) options.dsa.frameHz = options.hz;
  // With kMax the hand's time advances as on a real line, although no byte waits.
  options.dsa.lineByteUs = options.rate == EmulationRate::kMax ? kSerialByteUs : 0.0;
  options.sdh.minResponseDelayUs = real ? kMinThinkUs : 0.0;
  options.sdh.maxResponseDelayUs = real ? kMaxThinkUs : 0.0;
  options.sdh.requestByteUs = real ? kSerialByteUs : 0.0;
  options.sdh.seed = options.seed;
  options.dsa.serial =
      options.serial.value_or(model.serial().value_or(emulatedSerial(options.seed)));
  constexpr std::uint32_t kMotionSerials = 1'000'000;
  options.sdh.serial = std::to_string(options.dsa.serial % kMotionSerials);
  options.sdh.checksum = !options.sdhPort.starts_with("tcp:");
  if (options.faults.bootS) options.dsa.bootS = options.sdh.bootS = *options.faults.bootS;
  return options;
}

double byteUs(const EmulatedHandOptions& options) {
  return options.rate == EmulationRate::kReal ? kSerialByteUs : 0.0;
}

}  // namespace

std::uint32_t emulatedSerial(std::uint64_t seed) {
  // Mixes the bits as SplitMix64 does, a bijection, so that near seeds have numbers far apart.
  std::uint64_t bits = seed + 0x9E3779B97F4A7C15;
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EB;
  constexpr int kOwnBits = 28;
  return 0xE0000000 | static_cast<std::uint32_t>((bits ^ (bits >> 31)) >> (64 - kOwnBits));
}

EmulatedHand::Loop::Loop(std::unique_ptr<HandModel> model,
                         EmulatedHandOptions options,
                         FrameObserver observer)
    : options_(completed(std::move(options), *model)),
      observer_(std::move(observer)),
      model_(std::move(model)),
      startUs_(systemClock().monotonicUs()),
      dsaLane_(openPortServer(options_.dsaPort), byteUs(options_), options_.faults, options_.seed),
      sdhLane_(openPortServer(options_.sdhPort),
               byteUs(options_),
               options_.faults,
               options_.seed ^ 0x5D),
      dsa_(*model_, options_.dsa),
      sdh_(*model_, options_.sdh) {
  planIncidents(options_.faults, 0);
  wakeUp_ = FileDescriptor(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (wakeUp_.get() < 0)
    throw DeviceError(DeviceFault::kDisconnected,
                      dsaLane_.port().name(),
                      std::string("no event descriptor is available: ") + std::strerror(errno));
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

EmulatedHand::Loop::~Loop() {
  thread_.request_stop();
  wake();
  if (thread_.joinable()) thread_.join();
}

void EmulatedHand::Loop::wake() noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(wakeUp_.get(), &one, sizeof one);
}

void EmulatedHand::Loop::call(std::function<void()> work) {
  if (std::this_thread::get_id() == threadId_.load()) return work();
  std::packaged_task<void()> task(std::move(work));
  auto done = task.get_future();
  {
    const std::lock_guard lock(callsMutex_);
    if (ended_)
      throw DeviceError(
          DeviceFault::kDisconnected, dsaLane_.port().name(), "the emulated hand has stopped");
    calls_.push_back(std::move(task));
  }
  wake();
  done.get();
}

void EmulatedHand::Loop::runCalls() {
  std::deque<std::packaged_task<void()>> calls;
  {
    const std::lock_guard lock(callsMutex_);
    calls.swap(calls_);
  }
  for (auto& task : calls) task();
  if (!calls.empty()) collect();
}

EmulatedHandCounts EmulatedHand::Loop::counts() const {
  const std::lock_guard lock(countsMutex_);
  return counts_;
}

std::vector<SentFrame> EmulatedHand::Loop::sentFrames() const {
  const std::lock_guard lock(countsMutex_);
  return {sent_.begin(), sent_.end()};
}

std::int64_t EmulatedHand::Loop::nowUs() const {
  return systemClock().monotonicUs() - startUs_ + jumpedUs_;
}

void EmulatedHand::Loop::run(const std::stop_token& stop) {
  threadId_ = std::this_thread::get_id();
  std::string failure;
  try {
    while (!stop.stop_requested()) {
      runCalls();
      step();
      wait();
    }
  } catch (const std::exception& error) {
    failure = error.what();
  }
  {
    const std::lock_guard lock(callsMutex_);
    ended_ = true;
    calls_.clear();  // their callers receive a broken promise
  }
  const std::lock_guard lock(countsMutex_);
  counts_.failure = failure;
}

void EmulatedHand::Loop::powerCycle(double bootS) {
  dsa_.powerCycle(nowUs(), bootS);
  sdh_.powerCycle(nowUs(), bootS);
}

void EmulatedHand::Loop::setFaults(const Faults& faults) {
  dsaLane_.setFaults(faults);
  sdhLane_.setFaults(faults);
  planIncidents(faults, nowUs());
  if (faults.bootS) powerCycle(*faults.bootS);
}

void EmulatedHand::Loop::planIncidents(const Faults& faults, std::int64_t fromUs) {
  scheduledOutages_.clear();
  const auto add = [&](const Outage& outage, bool unplug) {
    scheduledOutages_.push_back(
        {fromUs + static_cast<std::int64_t>(outage.atS * 1e6),
         fromUs + static_cast<std::int64_t>((outage.atS + outage.durationS) * 1e6),
         unplug});
  };
  for (const Outage& stall : faults.stalls) add(stall, false);
  for (const Outage& unplug : faults.unplugs) add(unplug, true);
}

// Executes the outages that are due. Returns whether the controllers are stalled now.
bool EmulatedHand::Loop::incidents(std::int64_t nowUs) {
  bool stalled = false;
  for (ScheduledOutage& incident : scheduledOutages_) {
    if (nowUs < incident.beginUs) continue;
    if (!incident.begun) {
      incident.begun = true;
      ++(incident.unplug ? faultCounts_.unplugs : faultCounts_.stalls);
      if (incident.unplug) {
        dsaLane_.unplug();
        sdhLane_.unplug();
      }
    }
    if (nowUs < incident.endUs) {
      stalled = stalled || !incident.unplug;
    } else if (incident.unplug) {
      dsaLane_.port().plug();
      sdhLane_.port().plug();
    }
  }
  std::erase_if(scheduledOutages_,
                [&](const ScheduledOutage& incident) { return nowUs >= incident.endUs; });
  return stalled;
}

void EmulatedHand::Loop::step() {
  stalled_ = incidents(nowUs());
  if (!stalled_) {
    receive(nowUs());
    advance();
    const std::int64_t now = nowUs();
    dsaLane_.flush(now);
    sdhLane_.flush(now);
  }
  endCut(dsaLane_, dsaCutUs_);
  endCut(sdhLane_, sdhCutUs_);
  collect();
}

// A hang-up discards the bytes that the client has not read; it follows the last byte after a
// delay.
void EmulatedHand::Loop::endCut(EmulatedPortChannel& lane, std::int64_t& sinceUs) {
  const std::int64_t wallUs = systemClock().monotonicUs();
  if (!lane.cut()) {
    sinceUs = 0;
  } else if (sinceUs == 0) {
    sinceUs = wallUs;
  } else if (wallUs - sinceUs >= kCutUs) {
    lane.unplug();
  }
}

void EmulatedHand::Loop::receive(std::int64_t nowUs) {
  const std::int64_t wallUs = systemClock().monotonicUs();
  if (const auto bytes = dsaLane_.receive(nowUs, faultCounts_); !bytes.empty()) {
    dsaInputUs_ = wallUs;
    if (options_.received) options_.received(EmulatedPort::kTactile, bytes, wallUs);
    dsa_.receive(bytes, nowUs);
  } else if (dsa_.hasPartialRequest() && wallUs - dsaInputUs_ > kQuietUs) {
    dsa_.onReceiveTimeout();
  }
  if (const auto bytes = sdhLane_.receive(nowUs, faultCounts_); !bytes.empty()) {
    sdhInputUs_ = wallUs;
    if (options_.received) options_.received(EmulatedPort::kMotion, bytes, wallUs);
    sdh_.receive(bytes, nowUs);
  } else if (sdh_.hasPartialRequest() && wallUs - sdhInputUs_ > kQuietUs) {
    sdh_.onReceiveTimeout();
  }
}

bool EmulatedHand::Loop::jumpToNextFrame() {
  if (options_.rate != EmulationRate::kMax || !dsaLane_.ready()) return false;
  const auto next = dsa_.nextFrameUs(0);
  if (!next) return false;
  jumpedUs_ += std::max<std::int64_t>(0, *next - nowUs());
  return true;
}

void EmulatedHand::Loop::advance() {
  for (int i = 0; i < kFramesPerTurn; ++i) {
    const bool jumped = jumpToNextFrame();
    const std::int64_t now = nowUs();
    dsa_.advance(now, dsaLane_.freeAtUs());
    forwardTactile(now);
    sdh_.advance(now);
    forwardMotion(now);
    if (!jumped && !somethingIsDue(now)) break;
  }
  const std::int64_t now = nowUs();
  model_->advanceTo(static_cast<double>(now) * 1e-6);
  const std::int64_t wallUs = systemClock().monotonicUs();
  if (wallUs - tidiedUs_ < kTidyUs) return;
  tidiedUs_ = wallUs;
  dsaLane_.port().releaseStaleLock();
  sdhLane_.port().releaseStaleLock();
}

bool EmulatedHand::Loop::somethingIsDue(std::int64_t nowUs) const {
  const auto next = dsa_.nextUs(dsaLane_.freeAtUs());
  return next && *next <= nowUs;
}

void EmulatedHand::Loop::forwardTactile(std::int64_t nowUs) {
  const auto& scanned = dsa_.scanned();
  if (scanned) {
    ++working_.framesScanned;
    onTheLine_.push_back(*scanned);
    if (observer_) observer_({*scanned, hostTime_.nowUs(), dsa_.counts(), *model_});
  }
  for (LineMessage& message : dsa_.take())
    dsaLane_.push(
        std::move(message), message.frame && scanned ? scanned->timeUs : nowUs, faultCounts_);
}

void EmulatedHand::Loop::forwardMotion(std::int64_t nowUs) {
  for (LineMessage& message : sdh_.take()) sdhLane_.push(std::move(message), nowUs, faultCounts_);
}

// Makes counts and sent frames visible to other threads.
void EmulatedHand::Loop::collect() {
  const std::int64_t hostUs = hostTime_.nowUs();
  working_.handTimeS = static_cast<double>(nowUs()) * 1e-6;
  working_.ownMotion = model_->ownMotion();
  working_.faults = faultCounts_;
  working_.dsa = dsaLane_.counts();
  working_.sdh = sdhLane_.counts();
  const std::lock_guard lock(countsMutex_);
  for (const SentMessage& message : dsaLane_.ended()) {
    if (!message.frame) continue;
    const auto found = std::find_if(onTheLine_.begin(), onTheLine_.end(), [&](const auto& frame) {
      return frame.number == *message.frame;
    });
    if (found == onTheLine_.end()) continue;
    ++(message.lost ? working_.framesLost : working_.framesSent);
    const bool whole = !message.lost && !message.damaged;
    if (whole) ++working_.framesWhole;
    if (!message.lost) sent_.push_back({*message.frame, found->deviceMs, hostUs, whole});
    onTheLine_.erase(found);
  }
  while (sent_.size() > kRememberedFrames) sent_.pop_front();
  dsaLane_.ended().clear();
  sdhLane_.ended().clear();
  counts_ = working_;
}

std::int64_t EmulatedHand::Loop::waitUs(std::int64_t nowUs) {
  std::int64_t until = nowUs + kTickUs;
  const auto consider = [&](std::optional<std::int64_t> timeUs) {
    if (timeUs) until = std::min(until, *timeUs);
  };
  for (const ScheduledOutage& incident : scheduledOutages_)
    consider(incident.begun ? incident.endUs : incident.beginUs);
  if (dsaLane_.cut() || sdhLane_.cut()) consider(nowUs + kCutUs);
  if (stalled_) return std::max<std::int64_t>(0, until - nowUs);
  consider(dsa_.nextUs(dsaLane_.freeAtUs()));
  consider(sdh_.nextUs());
  const bool blocked = dsaLane_.blocked() || sdhLane_.blocked();
  blockedTurns_ = blocked ? std::min(blockedTurns_ + 1, kMaxRetryDoublings) : 0;
  if (blocked) consider(nowUs + (kRetryUs << blockedTurns_));
  if (!dsaLane_.blocked()) consider(dsaLane_.nextDueUs());
  if (!sdhLane_.blocked()) consider(sdhLane_.nextDueUs());
  if (options_.rate == EmulationRate::kMax && dsaLane_.ready() && dsa_.nextFrameUs(0)) return 0;
  return std::max<std::int64_t>(0, until - nowUs);
}

void EmulatedHand::Loop::wait() {
  const std::int64_t us = waitUs(nowUs());
  // While stalled no port is polled: input would end the wait without being read.
  pollfd polled[3] = {{wakeUp_.get(), POLLIN, 0},
                      {stalled_ ? -1 : dsaLane_.port().descriptor(), POLLIN, 0},
                      {stalled_ ? -1 : sdhLane_.port().descriptor(), POLLIN, 0}};
  const timespec timeout{static_cast<time_t>(us / 1'000'000), (us % 1'000'000) * 1000};
  ::ppoll(polled, 3, &timeout, nullptr);
  std::uint64_t count = 0;
  if ((polled[0].revents & POLLIN) != 0) [[maybe_unused]]
    const ssize_t n = ::read(wakeUp_.get(), &count, sizeof count);
}

}  // namespace palpate
