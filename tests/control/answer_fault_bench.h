// Test bench: the program's own thread of the motion port and its GraspControl, on a simulated
// clock, before an independent fake hand whose answers a test damages. Time passes only while the
// driver waits: then frames arrive every 32 ms and the control runs every 5 ms.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "palpate/control/grasp_control.h"

#include "capture/scripted_device.h"
#include "device/fake_sdh_hand.h"
#include "device/motion_link.h"
#include "device/scripted_channel.h"

namespace palpate::testing {

// kBabble: instead of answers random bytes arrive all the time.
enum class AnswerFault { kChecksum, kNan, kStateError, kGarbage, kMute, kShort, kEcho, kBabble };

class AnswerFaultBench {
 public:
  static constexpr std::int64_t kAnswerUs = 3'400;  // as the real controller
  static constexpr std::int64_t kFrameUs = 32'000;
  static constexpr std::int64_t kControlUs = 5'000;

  FakeSdhHand hand;
  std::optional<AnswerFault> fault;  // of every answer
  double damagedShare = 0.0;         // of the answers; each by another fault
  float counts = 0.0F;               // of the largest taxel
  std::int64_t firstFaultUs = 0;     // when the first damaged answer was asked for; 0: never
  std::int64_t firstStopUs = 0;      // when the next `stop` arrived after clearStops()
  std::size_t numBad = 0;
  std::unique_ptr<CaptureSession> session;
  std::unique_ptr<GraspControl> control;

  AnswerFaultBench() {
    hand.pollsPerMotion = 1'000'000;  // a motion lasts until it is stopped
    hand.values["power"].assign(7, 1.0);
    CaptureOptions options;
    options.ownThread = false;
    session = std::make_unique<CaptureSession>(std::make_unique<Port>(*this), options, clock_);
    session->start();
    control = std::make_unique<GraspControl>(*session, clock_);
    passUntil(
        [this] {
          const GraspStatus status = control->status();
          return status.cannotReact.empty() && !status.anglesDeg.empty();
        },
        5.0);
  }
  ~AnswerFaultBench() {
    fault.reset();
    damagedShare = 0.0;
    if (!unplugged_) {
      control->stop();
      awaitPhase(GraspPhase::kIdle);
    }
    control.reset();
    session.reset();
  }

  std::int64_t nowUs() const { return clock_.nowUs; }
  void pass(double seconds) {
    passUntil([] { return false; }, seconds);
  }
  // Returns whether the condition became true within the time.
  bool passUntil(const std::function<bool()>& condition, double seconds) {
    const std::int64_t endUs = clock_.nowUs + static_cast<std::int64_t>(seconds * kUsPerS);
    while (clock_.nowUs < endUs && !condition()) {
      // An attempt to open the port that fails at once must not stop the time.
      const std::int64_t beforeUs = clock_.nowUs;
      device_->link.step();
      if (clock_.nowUs == beforeUs) advance(beforeUs + 1000);
    }
    return condition();
  }
  // The line ends, and the port is not there any more.
  void unplug() {
    unplugged_ = true;
    line_->pullThePlug();
  }
  // Changes of the grasp whose text contains `words`.
  std::size_t numReported(const std::string& words) const {
    std::size_t found = 0;
    for (const std::string& text : reported_) found += text.find(words) != std::string::npos;
    return found;
  }
  int stops() const { return hand.stops; }
  void clearStops() {
    hand.stops = 0;
    firstStopUs = firstFaultUs = 0;
  }
  bool awaitPhase(GraspPhase phase, double seconds = 5.0) {
    return passUntil([this, phase] { return control->status().phase == phase; }, seconds);
  }

 private:
  class Line : public ScriptedChannel {
   public:
    explicit Line(AnswerFaultBench& bench)
        : ScriptedChannel(bench.clock_,
                          [&bench](const Bytes& request, ScriptedChannel& line) {
                            const Bytes answer = bench.answerTo(request);
                            if (!answer.empty()) line.arrive(answer, kAnswerUs);
                          }),
          bench_(bench) {}
    std::size_t read(std::span<std::byte> into, std::chrono::milliseconds timeout) override {
      const std::int64_t endUs = bench_.clock_.nowUs + usOf(timeout);
      while (true) {
        // In slices, so that frames and the control come in between.
        const std::int64_t leftUs = endUs - bench_.clock_.nowUs;
        const auto slice = std::min<std::int64_t>(leftUs / kUsPerMs, 1);
        std::size_t got = ScriptedChannel::read(into, std::chrono::milliseconds(slice));
        if (got == 0 && slice > 0 && bench_.fault == AnswerFault::kBabble && !into.empty()) {
          into[0] = static_cast<std::byte>(bench_.random_() & 0xFF);
          got = 1;
        }
        bench_.work();
        if (got > 0 || leftUs <= 0) return got;
      }
    }

   private:
    AnswerFaultBench& bench_;
  };
  class Link : public MotionLink {
   public:
    explicit Link(AnswerFaultBench& bench, const HostTime& time)
        : MotionLink(
              "motion",
              [&bench](const std::string& port) {
                if (bench.unplugged_)
                  throw DeviceError(DeviceFault::kNotFound, port, "no such port");
                auto line = std::make_unique<Line>(bench);
                bench.line_ = line.get();
                return line;
              },
              50.0,
              1.0,
              time,
              bench.clock_),
          bench_(bench) {}

   private:
    void waitForCommand(std::int64_t untilUs) override {
      while (bench_.clock_.nowUs < untilUs && !hasQueuedCommands())
        bench_.advance(std::min(bench_.clock_.nowUs + 1000, untilUs));
    }
    AnswerFaultBench& bench_;
  };
  struct Port : ScriptedDevice {
    explicit Port(AnswerFaultBench& bench) : time(bench.clock_), link(bench, time) {
      bench.device_ = this;
    }
    void start(DeviceSink& to) override {
      ScriptedDevice::start(to);
      link.begin(to);
    }
    void stop() noexcept override {
      if (sink == nullptr) return;
      link.requestStop();
      link.finish();
      ScriptedDevice::stop();
    }
    DeviceStatus status() const override {
      DeviceStatus now = state;
      now.motion = link.status();
      return now;
    }
    std::future<CommandAnswer> submit(DeviceCommand command) override {
      return link.submit(std::move(command));
    }
    std::vector<int> axisStates() const override { return link.axisStates(); }

    HostTime time;
    Link link;
  };

  void advance(std::int64_t untilUs) {
    clock_.nowUs = untilUs;
    work();
  }
  void work() {
    if (working_ || !control || device_->sink == nullptr) return;
    working_ = true;
    if (clock_.nowUs >= nextFrameUs_) {
      nextFrameUs_ = clock_.nowUs + kFrameUs;
      TactileFrame frame(sdh2().layout);
      frame.hostUs = device_->time.nowUs();
      frame.matrix(1)(3, 2) = counts;
      device_->sink->onFrame(std::move(frame));
    }
    if (clock_.nowUs >= nextControlUs_) {
      nextControlUs_ = clock_.nowUs + kControlUs;
      control->step();
      for (const GraspChange& change : control->takeChanges()) reported_.push_back(change.text);
      session->step();
      session->takeEvents();
    }
    working_ = false;
  }

  Bytes answerTo(const Bytes& request) {
    const int stopsBefore = hand.stops;
    const bool asksState = request.size() > 1 && request[0] == std::byte{0x84};
    std::optional<AnswerFault> now = fault;
    if (!now && std::uniform_real_distribution<double>()(random_) < damagedShare)
      now = static_cast<AnswerFault>(random_() % 7);
    if (now == AnswerFault::kNan) hand.nanAnswers = 1;
    const std::vector<double> states = hand.values["state"];
    if (now == AnswerFault::kStateError && asksState) hand.values["state"].assign(7, 42.0);
    Bytes answer = hand.receive(request);
    if (now == AnswerFault::kStateError && asksState) hand.values["state"] = states;
    hand.nanAnswers = 0;
    if (hand.stops > stopsBefore && firstStopUs == 0) firstStopUs = clock_.nowUs;
    if (!now || answer.empty()) return answer;
    if (now == AnswerFault::kStateError && !asksState) return answer;
    if (firstFaultUs == 0) firstFaultUs = clock_.nowUs;
    ++numBad;
    return damaged(*now, request, std::move(answer));
  }
  Bytes damaged(AnswerFault by, const Bytes& request, Bytes answer) {
    const bool isRecord = (answer[0] & std::byte{0x80}) != std::byte{0};
    switch (by) {
      case AnswerFault::kStateError:
        return answer;
      case AnswerFault::kNan:
        // Lines have no NaN of the fake hand: the text becomes one.
        if (!isRecord) answer = withValue(answer, "nan");
        return answer;
      case AnswerFault::kChecksum:
        if (isRecord)
          answer.back() ^= std::byte{0x40};
        else
          answer[answer.size() / 2] ^= std::byte{0x80};
        return answer;
      case AnswerFault::kGarbage:
        for (std::byte& b : answer) b = static_cast<std::byte>(random_() & 0xFF);
        return answer;
      case AnswerFault::kMute:
      case AnswerFault::kBabble:
        return {};
      case AnswerFault::kShort:
        answer.resize(answer.size() / 2);
        return answer;
      case AnswerFault::kEcho:
        return request;
    }
    return answer;
  }
  static Bytes withValue(const Bytes& answer, const std::string& value) {
    std::string line;
    for (const std::byte b : answer) line += static_cast<char>(b);
    line = line.substr(0, line.find('=') + 1) + value + "\r\n";
    Bytes changed;
    for (const char c : line) changed.push_back(static_cast<std::byte>(c));
    return changed;
  }

  ManualClock clock_;
  Port* device_ = nullptr;
  Line* line_ = nullptr;
  bool unplugged_ = false;
  std::vector<std::string> reported_;
  std::mt19937 random_{7};
  std::int64_t nextFrameUs_ = 0;
  std::int64_t nextControlUs_ = 0;
  bool working_ = false;
};

}  // namespace palpate::testing
