// Misbehaving controllers, long form: a gigabyte of random bytes (reliability R9).
#include "device/babble.h"

namespace palpate::testing::babble_slow_test {
namespace {

TEST(BabbleSlow, AGigabyteOfRandomBytesTakesNoMemory) {
  const double ms = misbehave(Behaviour::kBabbling, 1u << 30);
  std::printf("silent after %.0f ms\n", ms);
  EXPECT_LT(ms, 700.0);
}

}  // namespace
}  // namespace palpate::testing::babble_slow_test
