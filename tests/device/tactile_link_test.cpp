// Tests the rounds of the tactile port on a clock of the test and without a thread: gaps and their
// counts, settings with their masks, a second start.
#include "device/tactile_link.h"

#include <functional>

#include <gtest/gtest.h>

#include "palpate/core/json.h"

#include "device/collecting_sink.h"
#include "device/dsa_fake.h"

namespace palpate::testing::tactile_link_test {
namespace {

constexpr std::int64_t kPeriodUs = 31'500;

// Test bench with a controller that continues while it is unplugged.
struct Bench {
  ManualClock clock;
  HostTime time{clock};
  FakeDsa dsa{clock};
  CollectingSink sink;
  bool plugged = true;
  ScriptedChannel* line = nullptr;
  std::function<void()> requested;  // called with each request
  TactileLink link{
      "port", [this](const std::string& port) { return open(port); }, true, time, clock};

  std::unique_ptr<ByteChannel> open(const std::string& port) {
    if (!plugged) throw DeviceError(DeviceFault::kNotFound, port, "no such port");
    auto channel =
        std::make_unique<ScriptedChannel>(clock, [this](const Bytes& request, ScriptedChannel& to) {
          if (requested) requested();
          dsa(request, to);
        });
    line = channel.get();
    return channel;
  }
  void begin() {
    link.begin(sink);
    connect();
  }
  void connect() {
    for (int i = 0; i < 10 && !dsa.streaming; ++i) {
      clock.nowUs += 100'001;
      link.step();
    }
    ASSERT_TRUE(dsa.streaming) << link.status().message;
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) {
      dsa.sendFrame(*line, kPeriodUs);
      link.step();
    }
  }
  void silence(std::int64_t us) {
    for (const std::int64_t endUs = clock.nowUs + us; clock.nowUs < endUs;) link.step();
  }
  void unplugFor(std::int64_t us) {
    line->pullThePlug();
    plugged = false;
    dsa.streaming = false;
    for (const std::int64_t endUs = clock.nowUs + us; clock.nowUs < endUs;) {
      link.step();
      clock.nowUs += 100'001;
    }
    plugged = true;
    connect();
  }
  void end() {
    link.requestStop();
    link.finish();
    dsa.streaming = false;
  }
  std::vector<Event> events(const std::string& kind) {
    std::vector<Event> found;
    for (Event& event : sink.takeEvents())
      if (event.kind == kind) found.push_back(std::move(event));
    return found;
  }
};

// Number of frames that a hand would have sent in a gap, one per period.
double expectedLost(const Event& gap) {
  return static_cast<double>(gap.t1Us - gap.tUs) / static_cast<double>(kPeriodUs) - 1.0;
}

TEST(TactileLink, TheGapOfAnUnplugSaysHowManyFramesAreMissingAndThatItIsAnEstimate) {
  Bench bench;
  bench.begin();
  bench.frames(50);
  bench.unplugFor(3'000'000);
  bench.frames(20);
  const auto gaps = bench.events("gap");
  ASSERT_EQ(gaps.size(), 1u);
  const Json json = Json::parse(gaps[0].json);
  EXPECT_GT(expectedLost(gaps[0]), 90.0);
  EXPECT_NEAR(json.at("lost").asDouble(), expectedLost(gaps[0]), 1.0);
  ASSERT_TRUE(json.contains("estimated"));
  EXPECT_TRUE(json.at("estimated").asBool());
  EXPECT_NE(gaps[0].text.find("about " + std::to_string(json.at("lost").asInteger()) + " frames"),
            std::string::npos)
      << gaps[0].text;
  const PortStatus status = bench.link.status();
  EXPECT_EQ(static_cast<std::int64_t>(status.lost), json.at("lost").asInteger());
  EXPECT_EQ(status.estimatedLost, status.lost);
}

// On a noisy line, finding the controller may take seconds.
TEST(TactileLink, WhileTheControllerIsLookedForNobodySaysThatThereIsNoPort) {
  Bench bench;
  bench.begin();
  bench.frames(10);
  bench.line->pullThePlug();
  bench.plugged = bench.dsa.streaming = false;
  for (int i = 0; i < 5; ++i) {
    bench.link.step();
    bench.clock.nowUs += 100'001;
  }
  ASSERT_EQ(bench.link.status().message, "port: no such port");
  ASSERT_EQ(bench.link.status().state, PortState::kLost);
  bench.plugged = true;
  std::vector<PortStatus> seen;
  bench.requested = [&] { seen.push_back(bench.link.status()); };
  bench.connect();
  ASSERT_FALSE(seen.empty());
  EXPECT_EQ(seen.front().state, PortState::kConnecting);
  EXPECT_EQ(seen.front().message, "port: the port is there; looking for the tactile controller");
  EXPECT_EQ(bench.link.status().state, PortState::kStreaming);
  EXPECT_EQ(bench.link.status().message, "");
}

TEST(TactileLink, AGapOnAnOpenPortIsCountedByTheControllersClock) {
  Bench bench;
  bench.begin();
  bench.frames(50);
  bench.silence(700'000);
  bench.frames(20);
  const auto gaps = bench.events("gap");
  ASSERT_EQ(gaps.size(), 1u);
  const Json json = Json::parse(gaps[0].json);
  EXPECT_NEAR(json.at("lost").asDouble(), expectedLost(gaps[0]), 1.0);
  ASSERT_TRUE(json.contains("estimated"));
  EXPECT_FALSE(json.at("estimated").asBool());
  EXPECT_EQ(bench.link.status().estimatedLost, 0u);
  EXPECT_EQ(static_cast<std::int64_t>(bench.link.status().lost), json.at("lost").asInteger());
}

// After being switched off and on, the clock may show a later time than before; it does not tell
// how long the controller was off.
TEST(TactileLink, AGapThatNeededAWakeIsEstimatedByOurClock) {
  Bench bench;
  bench.dsa.clockAheadMs = 0;
  bench.begin();
  bench.frames(50);
  bench.silence(1'400'000);
  EXPECT_GT(bench.dsa.stops, 0) << "it was woken";
  bench.dsa.clockAheadMs = -1'000;
  bench.frames(20);
  const auto gaps = bench.events("gap");
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_GT(expectedLost(gaps[0]), 40.0);
  const Json json = Json::parse(gaps[0].json);
  EXPECT_NEAR(json.at("lost").asDouble(), expectedLost(gaps[0]), 1.0);
  EXPECT_TRUE(json.at("estimated").asBool());
}

TEST(TactileLink, AGapThatTheEndFindsOpenIsCountedToo) {
  Bench bench;
  bench.begin();
  bench.frames(50);
  bench.line->pullThePlug();
  bench.plugged = false;
  bench.link.step();
  bench.clock.nowUs += 2'000'000;
  bench.end();
  const auto gaps = bench.events("gap");
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_NEAR(Json::parse(gaps[0].json).at("lost").asDouble(), expectedLost(gaps[0]) + 1.0, 1.0);
}

// A recording that ends while the hand is unplugged asks for it.
TEST(TactileLink, AGapThatIsOpenIsKnownToOthers) {
  Bench bench;
  bench.begin();
  bench.frames(50);
  EXPECT_FALSE(bench.link.openGap(bench.time.nowUs()));
  bench.line->pullThePlug();
  bench.plugged = false;
  bench.link.step();
  const std::int64_t untilUs = bench.time.nowUs() + 8'000'000;
  const auto open = bench.link.openGap(untilUs);
  ASSERT_TRUE(open);
  EXPECT_EQ(open->kind, "gap");
  EXPECT_EQ(open->t1Us, untilUs);
  const Json json = Json::parse(open->json);
  EXPECT_NEAR(json.at("seconds").asDouble(), 8.0, 0.1);
  EXPECT_NEAR(json.at("lost").asDouble(), 8'000'000.0 / kPeriodUs, 3.0);
  EXPECT_TRUE(json.at("estimated").asBool());
  EXPECT_EQ(bench.link.status().lost, 0u) << "counted once it ends";
  EXPECT_TRUE(bench.events("gap").empty());
  bench.plugged = true;
  bench.dsa.streaming = false;
  bench.connect();
  bench.frames(3);
  EXPECT_FALSE(bench.link.openGap(bench.time.nowUs()));
  EXPECT_EQ(bench.events("gap").size(), 1u);
}

TEST(TactileLink, BeforeAFrameWasSeenNoNumberIsMadeUp) {
  Bench bench;
  bench.begin();
  bench.silence(700'000);
  bench.frames(3);
  const auto gaps = bench.events("gap");
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_FALSE(Json::parse(gaps[0].json).contains("lost")) << gaps[0].json;
}

TEST(TactileLink, SettingsTellTheMasksOfAllMatrices) {
  Bench bench;
  bench.begin();
  bench.frames(3);
  Mask half(84, 0);
  std::fill_n(half.begin(), 42, std::uint8_t{1});
  auto answer = bench.link.submit(SetDynamicMask{2, half});
  bench.link.step();
  EXPECT_NO_THROW(answer.get());
  const auto settings = bench.events("settings");
  ASSERT_EQ(settings.size(), 1u);
  const Json matrices = Json::parse(settings[0].json).at("matrices");
  ASSERT_EQ(matrices.size(), 6u);
  ASSERT_TRUE(matrices.at(2).contains("dynamic_mask")) << settings[0].json;
  EXPECT_EQ(matrices.at(2).at("dynamic_mask").asString(), "FFFFFFFFFF030000000000");
  EXPECT_EQ(matrices.at(0).at("dynamic_mask").asString(), "FFFFFFFFFFFFFFFFFFFF0F");
  EXPECT_EQ(matrices.at(1).at("dynamic_mask").asString(), "FFFFFFFFFFFFFFFFFF3F");
  EXPECT_EQ(matrices.at(2).at("threshold_counts").asInteger(), 150);
}

TEST(TactileLink, AMatrixIsKnownByItsUniqueId) {
  Bench bench;
  bench.begin();
  const HandDescription hand = bench.link.hand();
  for (std::size_t m = 0; m < 6; ++m)
    EXPECT_EQ(hand.layout->matrix(m).uniqueId, "102233445566") << m;
}

TEST(TactileLink, ASecondStartCountsFromItself) {
  Bench bench;
  bench.begin();
  bench.frames(30);
  bench.end();
  bench.clock.nowUs += 60'000'000;
  bench.sink.frames.clear();
  bench.sink.events.clear();
  const std::int64_t secondUs = bench.time.nowUs();
  bench.begin();
  EXPECT_EQ(bench.link.status().items, 0u);
  bench.silence(700'000);  // before its first frame
  bench.frames(10);
  const PortStatus status = bench.link.status();
  EXPECT_EQ(status.items, 10u);
  EXPECT_EQ(status.lost, 0u);
  for (const Event& gap : bench.events("gap")) EXPECT_GE(gap.tUs, secondUs) << gap.text;
  EXPECT_EQ(bench.events("gap").size(), 1u);
}

}  // namespace
}  // namespace palpate::testing::tactile_link_test
