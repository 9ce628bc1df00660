// In real time: how soon another program connects after the one that moved the hand was killed.
#include "palpate/core/time.h"
#include "palpate/device/live_hand.h"

#include "device/collecting_sink.h"
#include "device/last_stop_bench.h"
#include "testing/awaited.h"
#include "testing/punctuality.h"

namespace palpate::testing::last_stop_slow_test {
namespace {

constexpr int kKills = 20;
constexpr std::int64_t kConnectedUs = 1'000'000;

class LastStopSlowTest : public LastStopTest {};

TEST_F(LastStopSlowTest, TheNextProgramConnectsWithinASecondOfAKill) {
  Punctuality connected("connected_after_kill", {.usualUs = kConnectedUs, .worstUs = kConnectedUs});
  for (int i = 0; i < kKills; ++i) {
    SCOPED_TRACE(i);
    const auto program = movedBy({"kill", kStopProgram});
    const std::int64_t killedUs = systemClock().monotonicUs();
    program->signal(SIGKILL);
    EXPECT_EQ(program->wait(), 128 + SIGKILL);
    CollectingSink sink;
    LiveHandOptions options;
    options.sdhPort = server.path();
    LiveHand next(options);
    next.start(sink);
    EXPECT_TRUE(awaited([&] { return next.status().motion->state == PortState::kStreaming; }));
    connected.took(killedUs, systemClock().monotonicUs());
    EXPECT_TRUE(awaited([this] { return stopProgramsOf(server.path()).empty(); }));
    next.stop();
  }
  connected.judge();
}

}  // namespace
}  // namespace palpate::testing::last_stop_slow_test
