// The dock Slip in the real window.
#include <QComboBox>
#include <QDockWidget>
#include <QImage>
#include <filesystem>
#include <functional>

#include "gui/export/export_controller.h"
#include "gui/export/export_feature.h"
#include "gui/hand3d/hand3d_feature.h"
#include "gui/hand3d/hand_panel.h"
#include "gui/slip/slip_fixture.h"
#include "gui/slip/slip_panel.h"
#include "gui/source/connection.h"
#include "gui/testing/window_fixture.h"
#include "gui/timeline/event_rows.h"
#include "gui/timeline/timeline_feature.h"
#include "gui/timeline/timeline_panel.h"

namespace palpate::gui::slip_window_test {
namespace {

class SlipWindowTest : public WindowTest {
 protected:
  SlipWindowTest() { open({"slip.dsa"}); }
  QDockWidget* dock() { return window().findChild<QDockWidget*>("Slip"); }
  SlipPanel& panel() { return *find<SlipPanel>("SlipPanel"); }
  void showIt() {
    if (!dock()->isVisible()) press(Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier);
    settle();
  }
  void settle() {
    panel().settle();
    for (int i = 0; i < 5; ++i) QCoreApplication::processEvents();
  }
  std::vector<EventMark> slips() {
    std::vector<EventMark> found;
    for (const EventMark& mark : window().feature<TimelineFeature>().panel().rows().marks())
      if (mark.lane == EventLane::kSlips) found.push_back(mark);
    return found;
  }
};

TEST_F(SlipWindowTest, ComesAndGoesByItsKey) {
  EXPECT_FALSE(dock()->isVisible());
  showIt();
  EXPECT_TRUE(dock()->isVisible());
  EXPECT_GE(dock()->width(), 580);
  EXPECT_TRUE(window().docks().names().contains("Slip"));
  press(Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_FALSE(dock()->isVisible());
}

TEST_F(SlipWindowTest, SlipsAreARowOfTheTimeline) {
  EXPECT_TRUE(slips().empty()) << "nobody asked for them";
  showIt();
  ASSERT_EQ(slips().size(), 1U);
  const EventMark slip = slips().front();
  const double beginsS = kRests * 0.032, endsS = (kRests + kMoves) * 0.032;
  EXPECT_NEAR(slip.fromS, beginsS, 0.1);
  EXPECT_GT(slip.toS, endsS - 0.1);
  EXPECT_LT(slip.toS, endsS + 35 * 0.032) << "the longest window looks 30 frames back";
  EXPECT_FALSE(slip.editable);
  EXPECT_TRUE(slip.detail.startsWith("slip of finger 0 distal (found)"));
  EXPECT_EQ(nameOf(EventLane::kSlips), "slip");
  press(Qt::Key_W, Qt::ControlModifier);
  open({"good.dsa"});
  EXPECT_TRUE(slips().empty());
}

TEST_F(SlipWindowTest, FollowsThePlaybackAndTheKeyOfTheReference) {
  showIt();
  playback().seekFrame(kRests + 3);
  EXPECT_EQ(panel().frame(), kRests + 3);
  trigger("slipReference");
  settle();
  ASSERT_TRUE(panel().found());
  EXPECT_EQ(panel().found()->options.referenceFrame, std::optional<std::size_t>(kRests + 3));
  press(Qt::Key_Right);
  EXPECT_EQ(panel().frame(), kRests + 4);
}

TEST_F(SlipWindowTest, TheKeyOfTheReferenceBringsTheDock) {
  trigger("slipReference");
  settle();
  EXPECT_TRUE(dock()->isVisible());
  EXPECT_TRUE(panel().found()->options.referenceFrame);
}

TEST_F(SlipWindowTest, ArrowsAreOnTheHandWhileItSlips) {
  showIt();
  HandView& hand = window().feature<Hand3dFeature>().panel().view();
  const auto of = [&](std::size_t matrix) -> const HandSlip* {
    for (const HandSlip& slip : hand.drawing().slip())
      if (slip.matrix == matrix) return &slip;
    return nullptr;
  };
  playback().seekFrame(kRests + 12);
  ASSERT_TRUE(of(kMoving) && of(kStill));
  EXPECT_TRUE(of(kMoving)->slipping);
  EXPECT_NEAR(of(kMoving)->dy, 9 * kStepTaxels, 0.35) << "0.3 s are nine steps and a half";
  EXPECT_FALSE(of(kStill)->slipping);
  HandScene with, without;
  hand.drawing().fill(with, hand.look(), hand.camera());
  HandLook plain = hand.look();
  plain.slip = false;
  hand.drawing().fill(without, plain, hand.camera());
  EXPECT_GT(with.lines.size(), without.lines.size() + 4);
  // O-A20: in no frame has a matrix of which the dock says that it is invalid an arrow.
  std::size_t invalid = 0;
  for (std::size_t frame = 0; frame < playback().numFrames(); ++frame) {
    playback().seekFrame(frame);
    for (std::size_t m = 0; m < panel().found()->matrices.size(); ++m) {
      const SlipSample* sample = panel().found()->at(m, frame);
      if (!sample || sample->state != SlipState::kInvalid) continue;
      ++invalid;
      EXPECT_EQ(of(m), nullptr) << "frame " << frame << ", matrix " << m;
    }
  }
  EXPECT_GT(invalid, 0u);
  trigger("slipArrows");
  EXPECT_FALSE(hand.look().slip);
  EXPECT_FALSE(actions().at("slipArrows")->isChecked());
}

TEST_F(SlipWindowTest, IsTakenAwayAsPictureAndTable) {
  showIt();
  ExportRequest request;
  request.view = "Slip";
  request.folder = QString::fromStdString(folder_.path().string());
  request.name = "s";
  for (const ExportFormat form : {ExportFormat::kPng, ExportFormat::kCsv}) {
    request.form = form;
    window().feature<ExportFeature>().exportController().write(request);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return !window().feature<ExportFeature>().exportController().busy(); }, 20'000));
    EXPECT_EQ(bannerText(), "");
  }
  EXPECT_FALSE(QImage(QString::fromStdString((folder_ / "s.png").string())).isNull());
  EXPECT_EQ(testing::readFile(folder_ / "s.csv").find("frame,time_ms,matrix,active,valid,dx,dy"),
            0U);
}

// A handle that is pulled out of the emulated hand's grasp.
TEST_F(SlipWindowTest, OfAConnectedHandItTellsWhenItSlips) {
  std::filesystem::create_directory_symlink(testing::dataFolder() / "scenes", folder_ / "scenes");
  start();
  Connection handle;
  handle.kind = Connection::Kind::kEmulated;
  handle.scene = "slipping_handle";
  handle.sceneScriptRuns = true;
  window().state().connectTo(handle);
  const auto await = [](const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 40'000);
  };
  ASSERT_TRUE(await([&] { return window().state().live.hasReceivedFrames(); }));
  press(Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier);
  ASSERT_TRUE(await([&] { return panel().shown(); })) << panel().emptyText().toStdString();
  EXPECT_EQ(find<QComboBox>("slipMethod")->currentText(), "centroid");
  const auto newest = [&](std::size_t matrix) {
    return panel().found()->at(matrix, panel().frame());
  };
  const auto slipping = [&] {
    for (std::size_t m = 0; panel().found() && m < panel().found()->matrices.size(); ++m)
      if (const SlipSample* sample = newest(m); sample && sample->slipping) return true;
    return false;
  };
  ASSERT_TRUE(await(slipping)) << "it is pulled";
  bool arrow = false;
  for (const HandSlip& slip : window().feature<Hand3dFeature>().panel().view().drawing().slip())
    arrow = arrow || slip.slipping;
  EXPECT_TRUE(arrow);
  // The frame that is shown becomes the reference: what was moved is zero again.
  std::size_t touched = 0;
  for (std::size_t m = 0; m < panel().found()->matrices.size(); ++m)
    if (newest(m)) touched = m;
  trigger("slipReference");
  EXPECT_TRUE(await([&] {
    const SlipSample* sample = newest(touched);
    return sample && sample->refValid && sample->shiftTaxels() < 0.05;
  }));
}

}  // namespace
}  // namespace palpate::gui::slip_window_test
