// A quarter of an hour of one hand, at full speed (reliability R11, short form).
#include "capture/soak.h"

namespace palpate::testing::soak_test {
namespace {

TEST(Soak, AQuarterOfAnHourIsRecordedAsItWasSent) { soak(30'000); }

}  // namespace
}  // namespace palpate::testing::soak_test
