// Slip-aware grasps of the emulated hand: what it holds is pulled at, and stays.
#include <algorithm>

#include "palpate/core/error.h"
#include "palpate/core/json.h"

#include "control/held_object.h"
#include "testing/testing.h"

namespace palpate {
namespace {

using testing::HeldObject;

Scene sceneOf(const std::string& name) {
  Scene scene = loadScene(name, testing::dataFolder() / "scenes");
  scene.script.clear();
  return scene;
}

// Pulls at the object from `atS` on, ever more.
void pull(Scene& scene, double atS, const Eigen::Vector3d& forceN, double growsS) {
  LoadObject load;
  load.forceN = forceN;
  load.durationS = growsS;
  scene.script.push_back({atS, load});
}

GraspRequest slipAware(const std::string& preshape, int limit) {
  GraspRequest request;
  request.mode = GraspMode::kSlip;
  request.preshape = preshape;
  request.closeRatio = 1.0;
  request.velocityDegPerS = 25.0;
  request.limitCounts = limit;
  return request;
}

TEST(SlipGrasp, HoldsWhatRestsAndMovesNothing) {
  HeldObject held(sceneOf("bottle"));
  held.begin(slipAware("cylindrical", 400));
  ASSERT_TRUE(held.run(8.0, [&] { return held.machine().phase() == GraspPhase::kHolding; }));
  const std::uint64_t orders = held.hand().joints().orders();
  held.run(4.0);
  EXPECT_EQ(held.machine().phase(), GraspPhase::kHolding);
  EXPECT_EQ(held.machine().running().slips, 0);
  EXPECT_EQ(held.hand().joints().orders(), orders);
  EXPECT_EQ(held.actions("holding"), 1);
}

struct Pulled {
  double slipTaxels = 0.0;
  int contacts = 0;
  int slips = 0;
  int limit = 0;
};

// A bottle that is pulled out along its axis with 12 N: grasped at 300 counts it can't hold that.
Pulled pullTheBottle(GraspMode mode) {
  Scene scene = sceneOf("bottle");
  scene.objects[0].friction = 0.5;
  pull(scene, 8.0, {0.0, 14.0, 0.0}, 6.0);
  HeldObject held(scene);
  GraspRequest request = slipAware("cylindrical", 300);
  request.mode = mode;
  held.begin(request);
  held.run(19.0);
  if (mode == GraspMode::kSlip)
    return {held.farthestSlip(),
            held.contacts(),
            held.machine().running().slips,
            held.machine().running().limitCounts};
  return {held.farthestSlip(), held.contacts(), 0, 300};
}

TEST(SlipGrasp, ClosesAgainUponASlippingBottleAndItStays) {
  const Pulled plain = pullTheBottle(GraspMode::kReactive);
  const Pulled aware = pullTheBottle(GraspMode::kSlip);
  printf("plain: slip %.2f contacts %d; aware: slip %.2f contacts %d slips %d limit %d\n",
         plain.slipTaxels, plain.contacts, aware.slipTaxels, aware.contacts, aware.slips, aware.limit);
  EXPECT_GE(aware.slips, 1);
}

}  // namespace
}  // namespace palpate
