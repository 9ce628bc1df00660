// A day of one hand, at full speed (reliability R11).
#include "capture/soak.h"

namespace palpate::testing::soak_slow_test {
namespace {

TEST(SoakSlow, ADayIsRecordedAsItWasSent) { soak(2'600'000); }

}  // namespace
}  // namespace palpate::testing::soak_slow_test
