// Long form of R18: a thousand stops.
#include "control/stop_moments.h"
#include "testing/testing.h"

namespace palpate::safety_slow_test {
namespace {

TEST(SafetyLong, StopAtAThousandRandomMomentsIsOnTheWireWithinTwentyMilliseconds) {
  testing::stopAtRandomMoments(1000, 400'000);
}

}  // namespace
}  // namespace palpate::safety_slow_test
