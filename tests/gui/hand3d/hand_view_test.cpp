#include "gui/hand3d/hand_view.h"

#include <QPainter>
#include <QSignalSpy>
#include <algorithm>

#include "palpate/device/sdh2.h"
#include <palpate/emulator/synthetic_profile.h>
#include <palpate/model/profile_builder.h>
#include <palpate/recording/palpate_writer.h>

#include "gui/export/export_controller.h"
#include "gui/export/export_feature.h"
#include "gui/hand3d/hand3d_feature.h"
#include "gui/hand3d/hand_frame_painter.h"
#include "gui/hand3d/hand_panel.h"
#include "gui/matrices/matrices_feature.h"
#include "gui/matrices/matrices_panel.h"
#include "gui/testing/held_readings.h"
#include "gui/testing/mesh_hand.h"
#include "gui/testing/sample_profiles.h"
#include "gui/testing/window_fixture.h"

namespace palpate::gui::hand_view_test {
namespace {

const std::vector<double> kPose = {0.0, -10.0, 20.0, -10.0, 20.0, -10.0, 20.0};

class HandViewTest : public ::testing::Test {
 protected:
  HandViewTest() {
    view_.resize(800, 600);
    look_.range = {0.0, 200.0};
    view_.setLook(look_);
    view_.setHand(sdh2());
    frame_.matrix(1)(4, 2) = 100.0F;
    frame_.matrix(5)(5, 2) = 50.0F;
    view_.setMoment(frame_, kPose);
    view_.show();
    QCoreApplication::processEvents();
  }
  // Where a taxel is seen; it must be in sight.
  QPoint seen(std::size_t m, int y, int x) {
    const Eigen::Vector3d at = view_.drawing().pose().positionMm(m, y, x);
    const auto projected = view_.camera().project(at, view_.size());
    EXPECT_TRUE(projected);
    return projected ? projected->at.toPoint() : QPoint();
  }
  void lookAt(std::size_t matrix) {
    look_.only = matrix;
    view_.setLook(look_);
  }
  void drag(Qt::MouseButton button,
            Qt::KeyboardModifiers keys,
            const QPoint& from,
            const QPoint& to) {
    QTest::mousePress(&view_, button, keys, from);
    for (const QPoint& at : {from + (to - from) / 2, to}) {
      QMouseEvent move(QEvent::MouseMove, at, view_.mapToGlobal(at), Qt::NoButton, button, keys);
      QApplication::sendEvent(&view_, &move);
    }
    QTest::mouseRelease(&view_, button, keys, to);
  }

  HandView view_;
  HandLook look_;
  TactileFrame frame_ = emptyFrame();
};

// While the hand stands still, every second frame of 30 a second draws its colours; a moved hand is
// drawn at once, and so is the newest frame when the stream stops.
TEST_F(HandViewTest, DrawsTheColorsOfARunningHandLessOftenThanItsMotion) {
  const auto drawn = [&](std::int64_t hostUs, float counts, const std::vector<double>& anglesDeg) {
    const int before = view_.numPaints();
    frame_.hostUs = hostUs;
    frame_.matrix(1)(4, 2) = counts;
    view_.setLiveMoment(frame_, anglesDeg);
    QCoreApplication::processEvents();
    return view_.numPaints() - before;
  };
  EXPECT_EQ(drawn(1'000'000, 10.0F, kPose), 1);
  EXPECT_EQ(drawn(1'033'000, 20.0F, kPose), 0);
  EXPECT_EQ(drawn(1'066'000, 30.0F, kPose), 1);
  // A contact that ends between two drawings doesn't stay in the picture.
  EXPECT_EQ(drawn(1'070'000, 0.0F, kPose), 0);
  EXPECT_EQ(drawn(1'090'000, 0.0F, kPose), 0);
  EXPECT_EQ(drawn(1'120'000, 0.0F, kPose), 1);
  std::vector<double> moved = kPose;
  moved[1] += 1.0;
  EXPECT_EQ(drawn(1'130'000, 30.0F, moved), 1);
  EXPECT_EQ(drawn(1'163'000, 40.0F, moved), 0);
  const int before = view_.numPaints();
  view_.setStale({"no data", false});
  QCoreApplication::processEvents();
  EXPECT_EQ(view_.numPaints() - before, 1);
  EXPECT_EQ(view_.drawing().handState().frame->matrix(1)(4, 2), 40.0F);
  // A recording shows every frame that is asked for.
  frame_.hostUs += 1000;
  frame_.matrix(1)(4, 2) = 50.0F;
  view_.setMoment(frame_, moved);
  QCoreApplication::processEvents();
  EXPECT_EQ(view_.numPaints() - before, 2);
}

TEST_F(HandViewTest, ShowsAllOfTheHandAtFirst) {
  for (const Eigen::Vector3d& point : view_.drawing().extent(look_)) {
    const auto at = view_.camera().project(point, view_.size());
    ASSERT_TRUE(at);
    EXPECT_TRUE(QRectF(view_.rect()).contains(at->at));
  }
}

TEST_F(HandViewTest, AClickChoosesATaxelAndBesideLetsGo) {
  lookAt(1);
  QSignalSpy changed(&view_, &HandView::selectionChanged);
  QTest::mouseClick(&view_, Qt::LeftButton, Qt::NoModifier, seen(1, 4, 2));
  EXPECT_TRUE(view_.selection().contains(1, 4, 2));
  EXPECT_EQ(view_.selection().count(), 1u);
  QTest::mouseClick(&view_, Qt::LeftButton, Qt::ControlModifier, seen(1, 6, 3));
  EXPECT_EQ(view_.selection().count(), 2u);
  QTest::mouseClick(&view_, Qt::LeftButton, Qt::ControlModifier, seen(1, 6, 3));
  EXPECT_EQ(view_.selection().count(), 1u);
  QTest::mouseClick(&view_, Qt::LeftButton, Qt::NoModifier, QPoint(3, 3));
  EXPECT_TRUE(view_.selection().empty());
  EXPECT_EQ(changed.count(), 4);
}

TEST_F(HandViewTest, ADragWithControlChoosesWhatItCrosses) {
  lookAt(1);
  drag(Qt::LeftButton, Qt::ControlModifier, seen(1, 4, 2), seen(1, 8, 2));
  EXPECT_TRUE(view_.selection().contains(1, 4, 2));
  EXPECT_TRUE(view_.selection().contains(1, 8, 2));
}

TEST_F(HandViewTest, DragsTurnMoveAndComeNearer) {
  const HandCamera before = view_.camera();
  drag(Qt::LeftButton, Qt::NoModifier, {400, 300}, {460, 300});
  EXPECT_NE(view_.camera().azimuthDeg, before.azimuthDeg);
  EXPECT_EQ(view_.camera().targetMm, before.targetMm);
  EXPECT_TRUE(view_.selection().empty());
  const HandCamera turned = view_.camera();
  drag(Qt::LeftButton, Qt::ShiftModifier, {400, 300}, {430, 300});
  EXPECT_NE(view_.camera().targetMm, turned.targetMm);
  EXPECT_EQ(view_.camera().azimuthDeg, turned.azimuthDeg);
  drag(Qt::RightButton, Qt::NoModifier, {400, 300}, {400, 260});
  EXPECT_LT(view_.camera().distanceMm, turned.distanceMm);
  view_.resetCamera();
  EXPECT_EQ(view_.camera(), before);
}

TEST_F(HandViewTest, ResizingKeepsTheHandInThePictureUnlessItWasMoved) {
  const double before = view_.camera().distanceMm;
  view_.resize(240, 600);
  QCoreApplication::processEvents();
  EXPECT_GT(view_.camera().distanceMm, before);
  view_.zoomBy(2.0);
  const HandCamera chosen = view_.camera();
  view_.resize(800, 500);
  QCoreApplication::processEvents();
  EXPECT_EQ(view_.camera(), chosen);
}

TEST_F(HandViewTest, OtherTaxelsScannedAreTheSameHandSeenFromTheSamePlace) {
  view_.zoomBy(2.0);
  const HandCamera chosen = view_.camera();
  std::vector<MatrixLayout> matrices = sdh2().layout->matrices();
  matrices[1].dynamicMask.assign(matrices[1].numCells(), 0);
  HandDescription masked = sdh2();
  masked.layout = std::make_shared<const SensorLayout>(matrices);
  view_.setHand(masked);
  EXPECT_EQ(view_.camera(), chosen);
}

class MeshHandTest : public HandViewTest {
 protected:
  MeshHandTest() : hand_(meshHand(folder_.path())) { writeMesh(folder_.path()); }
  HandDescription withTaxels(std::uint8_t scanned) const {
    std::vector<MatrixLayout> matrices = hand_.layout->matrices();
    matrices[0].dynamicMask.assign(matrices[0].numCells(), scanned);
    HandDescription masked = hand_;
    masked.layout = std::make_shared<const SensorLayout>(matrices);
    return masked;
  }

  const testing::TemporaryFolder folder_;
  HandDescription hand_;
};

TEST_F(MeshHandTest, TheFirstViewHasTheBodyInItWhenItWasRead) {
  HeldReadings held;
  view_.setHand(hand_);
  const double before = view_.camera().distanceMm;
  held.release();
  FileReading::settleAll(view_);
  EXPECT_GT(view_.camera().distanceMm, 4.0 * before) << "300 mm instead of 8";
}

TEST_F(MeshHandTest, TheBodyComesIntoTheViewOfARecording) {
  HeldReadings held;
  view_.setHand(hand_);
  const double small = view_.camera().distanceMm;
  // What the recording needs.
  view_.setExtent({{0, 0, 0}, {0, 0, 2000}});
  const double before = view_.camera().distanceMm;
  ASSERT_GT(before, small);
  held.release();
  FileReading::settleAll(view_);
  EXPECT_GE(view_.camera().distanceMm, before) << "the recording's extent still counts";
}

TEST_F(MeshHandTest, AViewThatTheUserMovedStays) {
  HeldReadings held;
  view_.setHand(hand_);
  view_.zoomBy(2.0);
  const HandCamera chosen = view_.camera();
  held.release();
  FileReading::settleAll(view_);
  EXPECT_EQ(view_.camera(), chosen);
}

TEST_F(MeshHandTest, OtherScannedTaxelsDoNotReadTheBodyAgain) {
  view_.setHand(hand_);
  FileReading::settleAll(view_);
  ASSERT_TRUE(view_.drawing().drawsMeshes());
  const HeldReadings held;
  view_.setHand(withTaxels(0));
  EXPECT_TRUE(view_.drawing().drawsMeshes());
  for (const FileReading* reading : view_.findChildren<FileReading*>())
    EXPECT_FALSE(reading->busy());
}

// An export is prepared in the window's thread, where no file is read.
TEST_F(MeshHandTest, PicturesReadTheBodyWhenTheyArePainted) {
  ProfileBuilder builder(hand_);
  builder.addFrame(1'400'000'000'000'000, std::vector<float>(16, 0.0F));
  const Profile profile = builder.finish({});
  view_.setHand(hand_);
  FileReading::settleAll(view_);
  HandPictureOptions options = view_.pictureOptions({});
  options.page.size = QSizeF(200, 150);
  options.page.title.clear();
  const auto painted = [&](const FramePictures::Paint& paint) {
    QImage image(200, 150, QImage::Format_ARGB32_Premultiplied);
    image.fill(Qt::white);
    QPainter painter(&image);
    paint(painter, 0);
    return image;
  };
  const QImage whole = painted(handFramePainter(profile, options, {}));
  std::filesystem::remove(folder_ / "body.stl");
  EXPECT_NE(painted(handFramePainter(profile, options, {})), whole) << "the body is seen";
  const auto paint = handFramePainter(profile, options, {});
  writeMesh(folder_.path());
  EXPECT_EQ(painted(paint), whole);
}

TEST_F(HandViewTest, SaysWhatIsUnderTheMouse) {
  lookAt(1);
  QSignalSpy hovered(&view_, &HandView::hovered);
  const QPoint at = seen(1, 4, 2);
  QMouseEvent move(
      QEvent::MouseMove, at, view_.mapToGlobal(at), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QApplication::sendEvent(&view_, &move);
  EXPECT_EQ(view_.hoverText(), "finger 0 distal · x 2, y 4 · 100 counts");
  EXPECT_EQ(hovered.count(), 1);
}

TEST_F(HandViewTest, DrawsOnlyWhenSomethingChanged) {
  const int before = view_.numPaints();
  view_.setMoment(frame_, kPose);
  QCoreApplication::processEvents();
  EXPECT_EQ(view_.numPaints(), before);
  frame_.matrix(1)(4, 2) = 101.0F;
  view_.setMoment(frame_, kPose);
  QCoreApplication::processEvents();
  EXPECT_EQ(view_.numPaints(), before + 1);
}

TEST_F(HandViewTest, SaysWhenThereAreNoAnglesOrOnesOutOfRange) {
  EXPECT_EQ(poseNotice(view_.drawing(), false), "");
  view_.setMoment(frame_, {});
  EXPECT_TRUE(poseNotice(view_.drawing(), false).contains("No usable joint angles"));
  EXPECT_EQ(sphereText(view_.drawing(), SphereOf::kTaxels), "");
  view_.setAssumedAngles(kPose);
  EXPECT_TRUE(view_.drawing().posed());
  EXPECT_TRUE(
      sphereText(view_.drawing(), SphereOf::kTaxels).startsWith("enclosing sphere, diameter "));
  EXPECT_TRUE(view_.pictureOptions({}).notice.contains("assumed"));
  std::vector<double> wide = kPose;
  wide[1] = 200.0;
  view_.setMoment(frame_, wide);
  EXPECT_TRUE(poseNotice(view_.drawing(), false).contains("its range is"));
}

TEST_F(HandViewTest, TheNoticeOfAnUnknownGeometryCoversNoTaxel) {
  const HandDescription pads =
      describeHand(SensorLayout(std::vector(4, MatrixLayout::full(16, 16, 2.0))), 0, 0);
  for (const QSize& size : {QSize(640, 480), QSize(300, 260), QSize(900, 180)}) {
    HandView view;
    view.resize(size);
    view.setLook(look_);
    view.setHand(pads);
    const QString notice = poseNotice(view.drawing(), false);
    EXPECT_TRUE(notice.contains("geometry of this sensor isn't known")) << notice.toStdString();
    const double below = noticeHeight(view.font(), view.width(), notice);
    EXPECT_GT(below, view.fontMetrics().height());
    for (const Eigen::Vector3d& point : view.drawing().extent(view.drawing().effective(look_))) {
      const auto at = view.camera().project(point, view.size());
      ASSERT_TRUE(at);
      EXPECT_GE(at->at.y(), below) << size.width();
      EXPECT_TRUE(QRectF(view.rect()).contains(at->at)) << size.width();
    }
  }
  EXPECT_EQ(noticeHeight(view_.font(), 800.0, ""), 0.0);
}

TEST_F(HandViewTest, FlatMatricesAreLookedAtFromTheFront) {
  look_.taxels = TaxelShape::kFlatCells;
  view_.setLook(look_);
  EXPECT_NEAR(view_.camera().elevationDeg, 89.0, 1e-9);
  look_.taxels = TaxelShape::kCells;
  view_.setLook(look_);
  EXPECT_LT(view_.camera().elevationDeg, 60.0);
}

TEST_F(HandViewTest, WithoutAHandItIsEmptyAndHarmless) {
  view_.clear();
  QTest::mouseClick(&view_, Qt::LeftButton, Qt::NoModifier, QPoint(400, 300));
  drag(Qt::LeftButton, Qt::NoModifier, {400, 300}, {460, 300});
  QTest::mouseDClick(&view_, Qt::LeftButton, Qt::NoModifier, QPoint(400, 300));
  view_.fit();
  QCoreApplication::processEvents();
  EXPECT_TRUE(view_.hoverText().isEmpty());
}

class HandWindowTest : public WindowTest {
 protected:
  HandPanel& panel() { return window().feature<Hand3dFeature>().panel(); }
  HandLook look() { return panel().look(); }
};

TEST_F(HandWindowTest, FollowsTheCursorTheSelectionAndTheColours) {
  open({"rich.dsa"});
  playback().seekFrame(12);
  ASSERT_TRUE(panel().view().drawing().handState().frame);
  EXPECT_EQ(panel().view().drawing().handState().frame->values,
            window().state().displayed.unfilteredRecording()->profile.frame(12).values);
  EXPECT_TRUE(panel().view().drawing().posed());
  TaxelSelection chosen(*sdh2().layout);
  chosen.add(3, 2, 2, 4, 4);
  window().feature<MatricesFeature>().panel().view().select(chosen);
  EXPECT_EQ(panel().view().selection(), chosen);
  chosen.clear();
  chosen.add(0, 1, 1, 1, 1);
  panel().view().select(chosen);
  EXPECT_EQ(window().feature<MatricesFeature>().panel().view().selection(), chosen);
  actions().group("maps")->actions().at(1)->trigger();
  EXPECT_EQ(look().map, kAllColorMaps[1]);
  EXPECT_EQ(look().range, window().feature<MatricesFeature>().panel().view().look().range);
  choose("ranges", 1);
  EXPECT_EQ(look().range, window().feature<MatricesFeature>().panel().view().look().range);
}

TEST_F(HandWindowTest, TheFirstViewHasRoomForTheLargestGrasp) {
  open({"rich.dsa"});
  playback().seekFrame(window().state().displayed.unfilteredRecording()->table.frameOfLargestSum());
  const HandView& view = panel().view();
  ASSERT_TRUE(view.drawing().handState().contact.taxelSphere);
  for (const Eigen::Vector3d& point : view.drawing().extent(look())) {
    const auto at = view.camera().project(point, view.size());
    ASSERT_TRUE(at);
    EXPECT_TRUE(QRectF(view.rect()).contains(at->at));
  }
}

TEST_F(HandWindowTest, EverythingByKeyboard) {
  open({"rich.dsa"});
  choose("taxelShapes", 1);
  EXPECT_EQ(look().taxels, TaxelShape::kBars);
  choose("spheres", 1);
  EXPECT_EQ(look().sphere, SphereLook::kOpaque);
  trigger("sphereOfCentroids");
  EXPECT_EQ(look().sphereOf, SphereOf::kCentroids);
  trigger("normals");
  EXPECT_TRUE(look().normals);
  trigger("contacts");
  EXPECT_FALSE(look().contacts);
  trigger("wire");
  EXPECT_TRUE(look().wire);
  trigger("axes");
  EXPECT_TRUE(look().axes);
  actions().all("onlys")[2]->trigger();
  EXPECT_EQ(look().only, 1u);
  actions().all("onlys")[0]->trigger();
  EXPECT_FALSE(look().only);
  const HandCamera before = panel().view().camera();
  trigger("nearer");
  EXPECT_LT(panel().view().camera().distanceMm, before.distanceMm);
  press(Qt::Key_Left, Qt::ControlModifier);
  EXPECT_NE(panel().view().camera().azimuthDeg, before.azimuthDeg);
  trigger("resetHand");
  EXPECT_EQ(panel().view().camera(), before);
}

TEST_F(HandWindowTest, OneOfTheViewsIsAlwaysThereAndTheLookIsRemembered) {
  open({"rich.dsa"});
  trigger("handShown");
  EXPECT_TRUE(panel().isHidden());
  trigger("matricesShown");
  EXPECT_FALSE(panel().isHidden());
  choose("taxelShapes", 1);
  window().close();
  start();
  EXPECT_EQ(look().taxels, TaxelShape::kBars);
  EXPECT_FALSE(panel().isHidden());
  EXPECT_FALSE(actions().at("matricesShown")->isChecked());
}

TEST_F(HandWindowTest, ARecordingWithoutAnglesIsShownAtRest) {
  open({"good.dsa"});
  EXPECT_FALSE(panel().view().drawing().posed());
  EXPECT_TRUE(panel().view().pictureOptions({}).notice.contains("No usable joint angles"));
  open({"empty.dsa"});
  panel().view().grab();
}

// Flips bytes in the middle of a recording: the window says what is damaged there, and goes on.
TEST_F(HandWindowTest, ADamagedBlockIsSaidAndTheWindowGoesOn) {
  const std::filesystem::path path = folder_ / "damaged.palpate";
  writePalpate(synthesize({.durationS = 24.0, .grasps = 4}), {}, path);
  std::string bytes = testing::readFile(path);
  for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 200; ++i) bytes[i] ^= 0x5a;
  testing::writeFile(path, bytes);
  environment_.read = {};
  start();
  open({"damaged.palpate"});
  ASSERT_TRUE(window().state().displayed.unfilteredRecording());
  std::size_t numSaid = 0;
  const std::size_t numFrames = playback().numFrames();
  for (std::size_t frame = 0; frame < numFrames; frame += 5) {
    playback().seekFrame(frame);
    if (window().feature<MatricesFeature>().panel().view().notice().contains("is damaged"))
      ++numSaid;
  }
  EXPECT_GT(numSaid, 0u);
  EXPECT_LT(numSaid, numFrames / 10);
  playback().seekFrame(0);
  EXPECT_EQ(window().feature<MatricesFeature>().panel().view().notice(), "");
}

TEST_F(HandWindowTest, CanBeTakenAway) {
  open({"rich.dsa"});
  const auto views = window().feature<ExportFeature>().exportController().present();
  const auto found = std::find_if(
      views.begin(), views.end(), [](const ExportedView* view) { return view->name == "Hand"; });
  ASSERT_TRUE(found != views.end());
  const ExportedView* hand = *found;
  QImage image(400, 300, QImage::Format_RGB32);
  image.fill(Qt::magenta);
  QPainter painter(&image);
  hand->paint(painter, {.size = {400.0, 300.0}, .forPrint = true, .pixelRatio = 1.0});
  painter.end();
  EXPECT_NE(image.pixelColor(200, 150), QColor(Qt::magenta));
  EXPECT_EQ(image.pixelColor(3, 200), colorsOf(Theme::kLight).window);
  const auto pictures = hand->framePicturesNow();
  ASSERT_TRUE(pictures);
  EXPECT_EQ(pictures->numFrames,
            window().state().displayed.unfilteredRecording()->profile.numFrames());
  QImage of(400, 300, QImage::Format_RGB32);
  QPainter onImage(&of);
  pictures->painter({.size = {400.0, 300.0}, .pixelRatio = 1.0})(onImage, 5);
}

}  // namespace
}  // namespace palpate::gui::hand_view_test
