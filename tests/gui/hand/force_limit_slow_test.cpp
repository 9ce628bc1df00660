// A grasp from the dock Hand stops at a limit in newtons, in real time: frames that come late stop
// it.
#include <QCheckBox>
#include <QComboBox>
#include <QToolButton>

#include "calibration/sample_calibrations.h"
#include "gui/hand/hand_dock_bench.h"

namespace palpate::gui::force_limit_slow_test {
namespace {

using ForceLimitTest = HandDockBench;

TEST_F(ForceLimitTest, AGraspStopsAtTheForce) {
  connectTo(testing::handWith("ball"));
  dock_->resize(455, 900);
  find<QToolButton>("moreGraspOptions")->click();
  dock_->calibrationOf = [](const std::string&) {
    return std::optional(testing::linearCalibration({0.5, 150.0, false}));
  };
  dock_->renewCalibration();
  auto* unit = find<QComboBox>("limitUnit");
  ASSERT_TRUE(await([&] { return unit->isEnabled(); }));
  unit->setCurrentIndex(1);
  type("forceLimit", "1");
  type("velocity", "30");
  // What stops it is tested, not how slowly it touches.
  find<QCheckBox>("keepLimit")->setChecked(false);
  ASSERT_TRUE(await([&] { return isEnabled("reactiveGrasp"); }));
  click("reactiveGrasp");
  EXPECT_TRUE(await([&] { return state().startsWith("limit reached: finger "); }))
      << state().toStdString();
  EXPECT_TRUE(state().contains(" N")) << state().toStdString();
}

}  // namespace
}  // namespace palpate::gui::force_limit_slow_test
