// Tests of unexpected exceptions inside a port's thread: the process continues, the hand is
// stopped, the port is opened again (docs/notes/safety.md).
#include <atomic>
#include <mutex>
#include <new>
#include <stdexcept>

#include <gtest/gtest.h>

#include "palpate/core/error.h"
#include "palpate/device/live_hand.h"

#include "device/babbling_channel.h"
#include "device/collecting_sink.h"
#include "device/fake_sdh_hand.h"

namespace palpate::testing::fault_test {
namespace {

using std::chrono::milliseconds;

// Exceptions that a test makes its channels throw at the next read that may fail.
struct Faults {
  std::atomic<int> left{0};
  std::atomic<bool> outOfMemory{false};

  void throwIfAny() {
    if (left <= 0) return;
    --left;
    if (outOfMemory) throw std::bad_alloc();
    throw std::runtime_error("a bug in the channel");
  }
};

class FaultyTactilePort : public ByteChannel {
 public:
  FaultyTactilePort(BabblerControls& controls, Faults& faults) : port_(controls), faults_(faults) {}
  std::size_t read(std::span<std::byte> into, milliseconds timeout) override {
    faults_.throwIfAny();
    return port_.read(into, timeout);
  }
  void write(std::span<const std::byte> bytes) override { port_.write(bytes); }
  void interrupt() noexcept override { port_.interrupt(); }
  const std::string& name() const noexcept override { return port_.name(); }

 private:
  BabblingChannel port_;
  Faults& faults_;
};

// A motion controller behind a lock: it outlives the channels that lead to it.
struct SharedSdh {
  std::mutex mutex;
  FakeSdhHand hand;
  template <typename Look>
  auto with(Look look) {
    const std::lock_guard lock(mutex);
    return look(hand);
  }
};

class FaultyMotionPort : public ByteChannel {
 public:
  FaultyMotionPort(SharedSdh& shared, Faults& faults) : shared_(shared), faults_(faults) {}
  std::size_t read(std::span<std::byte> into, milliseconds timeout) override {
    // Throws only while a motion runs.
    if (shared_.with([](FakeSdhHand& hand) { return hand.moves > hand.stops; }))
      faults_.throwIfAny();
    std::unique_lock lock(mutex_);
    if (here_.empty()) came_.wait_for(lock, timeout, [this] { return !here_.empty() || woken_; });
    woken_ = false;
    const std::size_t n = std::min(into.size(), here_.size());
    std::copy_n(here_.begin(), n, into.begin());
    here_.erase(here_.begin(), here_.begin() + static_cast<std::ptrdiff_t>(n));
    return n;
  }
  void write(std::span<const std::byte> bytes) override {
    const Bytes request(bytes.begin(), bytes.end());
    const Bytes answer = shared_.with([&](FakeSdhHand& hand) { return hand.receive(request); });
    const std::lock_guard lock(mutex_);
    here_.insert(here_.end(), answer.begin(), answer.end());
  }
  void interrupt() noexcept override {
    const std::lock_guard lock(mutex_);
    woken_ = true;
    came_.notify_all();
  }
  const std::string& name() const noexcept override { return name_; }

 private:
  SharedSdh& shared_;
  Faults& faults_;
  std::mutex mutex_;
  std::condition_variable came_;
  Bytes here_;
  bool woken_ = false;
  std::string name_ = "motion";
};

bool hasAlarm(CollectingSink& sink, const std::string& word) {
  for (const Event& event : sink.takeEvents())
    if (event.kind == "alarm" && event.text.find(word) != std::string::npos) return true;
  return false;
}

class TactileFault : public ::testing::TestWithParam<bool> {};

TEST_P(TactileFault, IsSaidAndTheStreamGoesOn) {
  BabblerControls controls;
  Faults faults;
  CollectingSink sink;
  LiveHandOptions options;
  options.dsaPort = "tactile";
  options.open = [&](const std::string&) {
    return std::make_unique<FaultyTactilePort>(controls, faults);
  };
  LiveHand hand(options);
  hand.start(sink);
  ASSERT_TRUE(sink.awaitFrames(5));
  faults.outOfMemory = GetParam();
  faults.left = 1;
  ASSERT_TRUE(sink.await([&] { return hand.status().tactile.state == PortState::kFault; }));
  EXPECT_FALSE(hand.status().tactile.message.empty());
  const std::size_t frames = sink.numFrames();
  ASSERT_TRUE(sink.awaitFrames(frames + 5)) << "the port is tried anew";
  EXPECT_TRUE(hasAlarm(sink, GetParam() ? "bad_alloc" : "a bug in the channel"));
  hand.stop();
  EXPECT_EQ(hand.status().tactile.reconnects, 1u);
}

INSTANTIATE_TEST_SUITE_P(Faults, TactileFault, ::testing::Bool(), [](const auto& instance) {
  return instance.param ? std::string("OutOfMemory") : std::string("Bug");
});

class MotionFault : public ::testing::TestWithParam<bool> {};

TEST_P(MotionFault, StopsTheHandOnTheWire) {
  SharedSdh shared;
  Faults faults;
  CollectingSink sink;
  LiveHandOptions options;
  options.sdhPort = "motion";
  options.open = [&](const std::string&) {
    return std::make_unique<FaultyMotionPort>(shared, faults);
  };
  LiveHand hand(options);
  hand.start(sink);
  ASSERT_TRUE(sink.await([&] { return !sink.angles.empty(); }));
  shared.with([](FakeSdhHand& sdh) { sdh.pollsUntilIdle = 0; });
  hand.submit(MoveJoints{std::vector<double>(7, 10.0), {}, false}).get();
  shared.with([](FakeSdhHand& sdh) { sdh.pollsUntilIdle = 0; });  // a motion that never ends
  EXPECT_EQ(shared.with([](FakeSdhHand& sdh) { return sdh.stops; }), 0);
  faults.outOfMemory = GetParam();
  faults.left = 1;
  ASSERT_TRUE(sink.await([&] {
    return shared.with([](FakeSdhHand& sdh) { return sdh.stops > 0; });
  })) << "no stop came";
  EXPECT_TRUE(sink.await([&] { return hand.status().motion->state == PortState::kFault; }));
  ASSERT_TRUE(sink.await([&] { return hand.status().motion->state == PortState::kStreaming; }))
      << "the port is tried anew";
  EXPECT_TRUE(hasAlarm(sink, GetParam() ? "bad_alloc" : "a bug in the channel"));
  EXPECT_NO_THROW(hand.submit(MoveJoints{std::vector<double>(7, 0.0), {}, false}).get());
  hand.stop();
}

INSTANTIATE_TEST_SUITE_P(Faults, MotionFault, ::testing::Bool(), [](const auto& instance) {
  return instance.param ? std::string("OutOfMemory") : std::string("Bug");
});

// C-A10: the status counts this session only.
TEST(MotionRestart, CountsFromItself) {
  SharedSdh shared;
  Faults faults;
  CollectingSink sink;
  LiveHandOptions options;
  options.sdhPort = "motion";
  options.open = [&](const std::string&) {
    return std::make_unique<FaultyMotionPort>(shared, faults);
  };
  LiveHand hand(options);
  const auto samples = [&] {
    std::size_t count = 0;
    sink.await([&] {
      count = sink.angles.size();
      return true;
    });
    return count;
  };
  hand.start(sink);
  ASSERT_TRUE(sink.await([&] { return sink.angles.size() > 20; }));
  hand.stop();
  const std::size_t before = samples();
  EXPECT_EQ(hand.status().motion->items, before);
  const std::uint64_t bytesBefore = hand.status().motion->bytes;
  hand.start(sink);
  ASSERT_TRUE(sink.await([&] { return sink.angles.size() > before + 2; }));
  hand.stop();
  EXPECT_EQ(hand.status().motion->items, samples() - before);
  EXPECT_LT(hand.status().motion->bytes, bytesBefore);
}

// A faulty controller reports more taxels than a frame can carry: 6 x 256 x 256.
TEST(TactileFault, AControllerWithTooManyTaxelsIsRefused) {
  CollectingSink sink;
  ManualClock time;
  FakeDsa dsa(time);
  dsa.knowsMasks = false;
  dsa.rowsTold = dsa.columnsTold = 256;
  class Port : public ScriptedChannel {
   public:
    using ScriptedChannel::ScriptedChannel;
    std::size_t read(std::span<std::byte> into, milliseconds timeout) override {
      const std::size_t n = ScriptedChannel::read(into, timeout);
      if (n == 0) std::this_thread::yield();
      return n;
    }
  };
  LiveHandOptions options;
  options.dsaPort = "tactile";
  options.open = [&](const std::string&) {
    return std::make_unique<Port>(
        time, [&](const Bytes& request, ScriptedChannel& line) { dsa(request, line); });
  };
  LiveHand hand(options, time);
  hand.start(sink);
  ASSERT_TRUE(sink.await([&] {
    return hand.status().tactile.message.find("393216 taxels") != std::string::npos;
  })) << hand.status().tactile.message;
  EXPECT_EQ(hand.status().tactile.state, PortState::kConnecting);
  hand.stop();
}

}  // namespace
}  // namespace palpate::testing::fault_test
