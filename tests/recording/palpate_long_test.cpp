// The long forms of the reliability table for native recordings: 1000 kills, 1000 power cuts,
// 10,000 damaged files, 200 killed recoveries.
#include "recording/palpate_damage.h"
#include "recording/palpate_faults.h"

namespace palpate::palpate_long_test {
namespace {
using namespace testing;

// In halves: each stays well below the time a test may take.
class PalpateLongHalves : public ::testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Half, PalpateLongHalves, ::testing::Values(0u, 1u));

TEST_P(PalpateLongHalves, aThousandKills) {
  std::mt19937 random(1 + GetParam());
  for (int round = 0; round < 500; ++round) killAfter(random() % 30, random());
}

TEST_P(PalpateLongHalves, tenThousandDamagedFiles) {
  DamageRun run(400);
  for (unsigned seed = 0; seed < 5'000; ++seed) run.round(GetParam() * 5'000 + seed);
  std::printf("%zu files: %zu frames lay in blocks that were not hit, %zu came back\n",
              run.rounds(),
              run.framesExpected(),
              run.framesSaved());
}

TEST(PalpateLong, aThousandPowerCuts) {
  std::mt19937 random(2);
  for (unsigned round = 0; round < 1000; ++round)
    cutPowerAt(1 + static_cast<std::int64_t>(random() % static_cast<unsigned>(operationsOfRun())),
               10'000 + round);
}

TEST(PalpateLong, twoHundredKilledRecoveries) {
  KilledRecovery recovery;
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) recovery.round(random() % 40'000'000);
  std::printf("%d of 200 were killed before their end\n", recovery.killed());
}

}  // namespace
}  // namespace palpate::palpate_long_test
