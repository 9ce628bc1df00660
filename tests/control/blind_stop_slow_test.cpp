// In real time: how long a hand whose controller answers badly moves on until the stop is on the
// wire. The rules, in every mode: answer_fault_test.
#include <atomic>
#include <random>

#include "control/emulated_bench.h"
#include "testing/punctuality.h"
#include "testing/testing.h"

namespace palpate::blind_stop_slow_test {
namespace {
using namespace testing;

constexpr int kRounds = 100;
constexpr std::int64_t kWriteUs = 20'000;  // from the decision to the wire
constexpr std::int64_t kNeverLongerUs = 100'000;

// What arrives from the motion controller is damaged or dropped from a moment on.
struct BadAnswers {
  std::atomic<bool> on{false};
  std::atomic<bool> mute{false};
  std::atomic<std::int64_t> firstUs{0};  // when the first such answer was taken off the line
};

class BadlyAnsweringChannel : public ByteChannel {
 public:
  BadlyAnsweringChannel(std::unique_ptr<ByteChannel> line, BadAnswers& bad)
      : line_(std::move(line)), bad_(bad) {}
  std::size_t read(std::span<std::byte> into, std::chrono::milliseconds timeout) override {
    const std::size_t got = line_->read(into, timeout);
    if (!bad_.on || got == 0) return got;
    std::int64_t never = 0;
    bad_.firstUs.compare_exchange_strong(never, systemClock().monotonicUs());
    if (bad_.mute) return 0;
    for (std::size_t i = 0; i < got; i += 5) into[i] ^= std::byte{0x10};
    return got;
  }
  void write(std::span<const std::byte> bytes) override { line_->write(bytes); }
  void interrupt() noexcept override { line_->interrupt(); }
  const std::string& name() const noexcept override { return line_->name(); }

 private:
  std::unique_ptr<ByteChannel> line_;
  BadAnswers& bad_;
};

// Host time at which the port's thread decided to stop blindly; 0 without such an event.
std::int64_t decidedUs(CaptureSession& session) {
  for (const Event& event : session.takeEvents())
    if (event.kind == "motion" && event.text.find("without waiting") != std::string::npos)
      return event.tUs;
  return 0;
}

void stopManyTimes(GraspMode mode, const std::string& name, std::int64_t limitUs) {
  EmulatedBench bench(stillHand());
  BadAnswers bad;
  const HostTime time;
  bench.connect([&bad](const std::string& port) -> std::unique_ptr<ByteChannel> {
    std::unique_ptr<ByteChannel> line = openChannel(port);
    if (port.ends_with("dsa")) return line;
    return std::make_unique<BadlyAnsweringChannel>(std::move(line), bad);
  });
  Punctuality decisions(name + "_decision_to_stop", {kWriteUs, 0.995, kNeverLongerUs});
  Punctuality reactions(name + "_bad_answers_to_stop",
                        {limitUs + kWriteUs, 0.995, limitUs + kNeverLongerUs});
  std::mt19937 random(49);
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    ASSERT_TRUE(eventuallyTrue([&] { return bench.control->status().cannotReact.empty(); }));
    // Slow enough that the hand is on its way in all rounds.
    GraspRequest request = reactiveGrasp(200, 1.0);
    request.mode = mode;
    bench.control->grasp(request);
    ASSERT_TRUE(bench.awaitMotion());
    sleepUntilUs(systemClock().monotonicUs() +
                 std::uniform_int_distribution<std::int64_t>(0, 100'000)(random));
    bench.session->takeEvents();
    bench.log.clear();
    bad.mute = round % 2 == 1;
    bad.firstUs = 0;
    bad.on = true;
    ASSERT_TRUE(eventuallyTrue([&] { return !bench.log.named("stop").empty(); }));
    const std::int64_t arrivedUs = bench.log.named("stop").front().monoUs;
    EXPECT_TRUE(eventuallyTrue([&] { return !bench.handMoves(); }));
    bad.on = false;
    const auto report = bench.awaitEnd();
    ASSERT_TRUE(report.has_value());
    EXPECT_EQ(report->outcome, GraspOutcome::kFailed) << report->text;
    reactions.took(bad.firstUs, arrivedUs);
    const std::int64_t hostAheadUs = time.nowUs() - systemClock().monotonicUs();
    const std::int64_t decided = decidedUs(*bench.session);
    ASSERT_NE(decided, 0);
    decisions.took(decided - hostAheadUs, arrivedUs);
  }
  decisions.judge();
  reactions.judge();
}

TEST(BlindStop, IsOnTheWireInTimeInAPlainGrasp) {
  stopManyTimes(GraspMode::kPlain, "plain", 500'000);
}

TEST(BlindStop, IsOnTheWireInTimeUnderTactileControl) {
  stopManyTimes(GraspMode::kReactive, "reactive", 200'000);
}

}  // namespace
}  // namespace palpate::blind_stop_slow_test
