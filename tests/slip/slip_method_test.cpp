#include "palpate/slip/slip_method.h"

#include <set>
#include <string>

#include "testing/testing.h"

namespace palpate::slip_method_test {
namespace {

TEST(SlipMethod, IsCalledAsInTheCommands) {
  EXPECT_EQ(slipMethodNamed("centroid"), SlipMethod::kCentroid);
  EXPECT_EQ(slipMethodNamed("alcazar"), SlipMethod::kAlcazar);
  EXPECT_EQ(slipMethodNamed("ncc-paraboloid"), SlipMethod::kNccParaboloid);
  EXPECT_EQ(slipMethodNamed("ncc-gauss3"), SlipMethod::kNccGauss3);
  EXPECT_EQ(slipMethodNamed("phase"), SlipMethod::kPhase);
  EXPECT_EQ(slipMethodNamed("phase-normalized"), SlipMethod::kPhaseNormalized);
  EXPECT_EQ(slipMethodNamed("register"), SlipMethod::kRegister);
  EXPECT_EQ(slipMethodNamed("contest"), SlipMethod::kContest);
  EXPECT_EQ(slipMethodNamed("Centroid"), std::nullopt);
  EXPECT_EQ(slipMethodNamed(""), std::nullopt);
}

TEST(SlipMethod, EveryOneHasANameOfItsOwn) {
  std::set<std::string> names;
  for (const SlipMethod method : slipMethods()) names.emplace(nameOf(method));
  EXPECT_EQ(names.size(), 8U);
  EXPECT_EQ(names.count("unknown"), 0U);
}

}  // namespace
}  // namespace palpate::slip_method_test
