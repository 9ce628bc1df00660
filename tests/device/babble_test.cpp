// Misbehaving controllers, short form (reliability R9).
#include "device/babble.h"

#include "testing/time_limit.h"

namespace palpate::testing::babble_test {
namespace {

// "Silent" within 500 ms, plus the delay of a busy machine.
constexpr double kNoticedMs = 700.0;

TEST(Babble, SilenceIsNoticedAndEnds) {
  EXPECT_LT(misbehave(Behaviour::kSilent, 0), timeLimit(kNoticedMs));
}

TEST(Babble, RandomBytesTakeNoMemory) {
  EXPECT_LT(misbehave(Behaviour::kBabbling, 50u << 20), timeLimit(kNoticedMs));
}

TEST(Babble, OneByteASecondIsSilence) {
  EXPECT_LT(misbehave(Behaviour::kDripping, 0), timeLimit(kNoticedMs));
}

}  // namespace
}  // namespace palpate::testing::babble_test
