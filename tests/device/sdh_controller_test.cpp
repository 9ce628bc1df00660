#include "palpate/device/sdh_controller.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "device/fake_sdh_hand.h"
#include "device/scripted_channel.h"

namespace palpate {
namespace {

using testing::Bytes;
using testing::FakeSdhHand;
using testing::ManualClock;
using testing::ScriptedChannel;
using Values = SdhController::Values;

// Driver and fake hand on a line whose time passes only while somebody waits.
class SdhControllerTest : public ::testing::Test {
 protected:
  FakeSdhHand hand;
  ManualClock clock;
  bool urgent = false;
  std::int64_t answerAfterUs = 3400;
  ScriptedChannel line{clock, [this](const Bytes& request, ScriptedChannel& channel) {
                         const Bytes answer = hand.receive(request);
                         if (!answer.empty()) channel.arrive(answer, answerAfterUs);
                       }};
  SdhController controller{line, clock, {.urgent = [this] { return urgent; }}};

  double seconds() const { return static_cast<double>(clock.nowUs) * 1e-6; }
};

template <typename Call>
DeviceError errorOf(Call call) {
  try {
    call();
  } catch (const DeviceError& error) {
    return error;
  }
  ADD_FAILURE() << "no error";
  return DeviceError(DeviceFault::kUnsupported, "", "");
}

TEST_F(SdhControllerTest, OpensAndLearnsWhatTheHandIs) {
  const SdhFacts facts = controller.open();
  EXPECT_EQ(facts.firmware, "0.0.3.3");
  EXPECT_EQ(facts.date, "2013-09-19");
  EXPECT_EQ(facts.soc, "SDH_SOC 7");
  EXPECT_EQ(facts.serial, "48");
  EXPECT_EQ(facts.id, "SDH");
  EXPECT_EQ(facts.maximumVelocity, hand.values["vlim"]);
  EXPECT_EQ(facts.maximumAcceleration, hand.values["alim"]);
  EXPECT_EQ(facts.controller, 0);
  EXPECT_LT(seconds(), 0.5);
}

TEST_F(SdhControllerTest, ReadsAndMovesTheAxes) {
  controller.open();
  EXPECT_EQ(controller.angles(), hand.pos);
  EXPECT_EQ(controller.targets(), hand.values["p"]);
  EXPECT_EQ(controller.temperatures(),
            (Values{40.5, 45.75, 37, 41.75, 34, 44, 36.75, 48.5, 48.25}));
  const Values goal{0, -20, -30, -40, 5, 60, 7.5};
  EXPECT_EQ(controller.setTargets(goal), goal);
  EXPECT_DOUBLE_EQ(controller.move(), 4.51);
  EXPECT_EQ(controller.states(), std::vector<int>(7, 1));
  controller.states();
  EXPECT_EQ(controller.states(), std::vector<int>(7, 0));
  EXPECT_EQ(controller.angles(), goal);
  controller.stop();
  EXPECT_EQ(hand.stops, 1);
}

}  // namespace
}  // namespace palpate
