#include "gui/hand3d/hand_scene_builder.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "palpate/device/sdh2.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/touch.h"

#include "gui/appearance/difference_map.h"
#include "gui/hand3d/hand_picture.h"
#include "gui/testing/sample_profiles.h"
#include "testing/sdh2.h"

namespace palpate::gui::hand_scene_builder_test {
namespace {

const std::vector<double> kPose = {0.0, -10.0, 20.0, -10.0, 20.0, -10.0, 20.0};

class HandSceneBuilderTest : public ::testing::Test {
 protected:
  HandSceneBuilderTest() {
    drawing_.setHand(sdh2(), true);
    frame_.matrix(1)(4, 2) = 100.0F;
    frame_.matrix(1)(4, 3) = 200.0F;
    frame_.matrix(5)(5, 2) = 50.0F;
    look_.range = {0.0, 200.0};
    look_.theme = Theme::kDark;
  }
  const HandScene& fill() {
    drawing_.fill(scene_, look_, camera_);
    return scene_;
  }
  std::size_t numOf(QRgb color) const {
    return static_cast<std::size_t>(
        std::count_if(scene_.solid.begin(), scene_.solid.end(), [=](const SceneVertex& vertex) {
          return vertex.color == color;
        }));
  }

  HandGeometry geometry_{sdh2Geometry()};
  HandSceneBuilder drawing_;
  TactileFrame frame_ = emptyFrame();
  HandLook look_;
  HandCamera camera_;
  HandScene scene_;
};

TEST_F(HandSceneBuilderTest, TaxelsHaveTheColoursOfTheHeatMaps) {
  drawing_.setMoment(frame_, kPose);
  fill();
  const ColorTable& table = colorTable(look_.map);
  EXPECT_EQ(numOf(table[static_cast<std::size_t>(colorIndex(100.0, 0.0, 200.0))]), 6u);
  EXPECT_EQ(numOf(table[255]), 6u);  // two triangles
  EXPECT_EQ(numOf(colorsOf(Theme::kDark).taxel.rgb()), 6u * (456u - 3u));
}

// A ball around an emulated hand: solid before it is touched, seen through afterwards.
TEST_F(HandSceneBuilderTest, ObjectsAreSolidUntilTheyAreTouched) {
  SceneObject ball;
  ball.shape.sizeMm = Eigen::Vector3d::Constant(70.0);
  ball.positionMm = {1.0, 2.0, 150.0};
  drawing_.setMoment(emptyFrame(), kPose);
  const std::size_t solid = fill().solid.size(), clear = scene_.clear.size();
  EXPECT_TRUE(drawing_.setObjects({ball}));
  EXPECT_FALSE(drawing_.setObjects({ball}));
  double top = 0.0;
  for (const Eigen::Vector3d& point : drawing_.extent(look_)) top = std::max(top, point.z());
  EXPECT_GE(top, 185.0) << "the picture has room for it";
  fill();
  ASSERT_GT(scene_.solid.size(), solid);
  EXPECT_EQ(scene_.clear.size(), clear);
  std::size_t onBall = 0;
  for (const SceneVertex& vertex : scene_.solid) {
    const Eigen::Vector3d at(vertex.positionMm[0], vertex.positionMm[1], vertex.positionMm[2]);
    if (std::abs((at - ball.positionMm).norm() - 35.0) < 1e-3) ++onBall;
  }
  EXPECT_GE(onBall, scene_.solid.size() - solid);
  drawing_.setMoment(frame_, kPose);
  look_.sphere = SphereLook::kNone;
  EXPECT_EQ(fill().solid.size(), solid);
  EXPECT_GT(scene_.clear.size(), 0u);
  ball.positionMm.x() += 5.0;
  EXPECT_TRUE(drawing_.setObjects({ball}));
  look_.only = 1;
  EXPECT_TRUE(fill().clear.empty());
}

// As in the heat maps: less than half a count, in a taxel that nothing presses on, is nothing to
// see.
TEST_F(HandSceneBuilderTest, WhatFiltersLeaveInTaxelsAtRestIsSeenFromHalfACount) {
  frame_.filtered = frame_.values;
  frame_.filtered[0] = 0.4F;
  drawing_.setMoment(frame_, kPose);
  fill();
  const QRgb resting = colorsOf(Theme::kDark).taxel.rgb();
  EXPECT_EQ(numOf(resting), 6u * (456u - 3u));
  frame_.filtered[0] = 0.6F;
  drawing_.setMoment(frame_, kPose);
  fill();
  EXPECT_EQ(numOf(resting), 6u * (456u - 4u));
}

TEST_F(HandSceneBuilderTest, SphereAndContactsAreThoseOfTheContactGeometry) {
  drawing_.setMoment(frame_, kPose);
  const HandContact expected = contactOf(frame_, geometry_.pose(kPose));
  look_.sphere = SphereLook::kOpaque;
  const std::size_t without = [&] {
    look_.sphere = SphereLook::kNone;
    return fill().solid.size();
  }();
  look_.sphere = SphereLook::kOpaque;
  fill();
  ASSERT_GT(scene_.solid.size(), without);
  for (std::size_t i = without; i < scene_.solid.size(); ++i) {
    const auto& at = scene_.solid[i].positionMm;
    const Eigen::Vector3d point(at[0], at[1], at[2]);
    EXPECT_NEAR(
        (point - expected.taxelSphere->centreMm).norm(), expected.taxelSphere->radiusMm, 1e-3);
  }
  look_.sphere = SphereLook::kGlass;
  EXPECT_FALSE(fill().clear.empty());
  EXPECT_EQ(scene_.solid.size(), without);
  look_.sphereOf = SphereOf::kCentroids;
  const auto& vertex = fill().clear.front().positionMm;
  EXPECT_NEAR(
      (Eigen::Vector3d(vertex[0], vertex[1], vertex[2]) - expected.centroidSphere->centreMm).norm(),
      expected.centroidSphere->radiusMm,
      1e-3);
}

// A hand without axes needs no angles, and none of an earlier hand are assumed.
TEST_F(HandSceneBuilderTest, AHandWithoutAxesIsPosedByItsFrame) {
  const HandDescription& pad = builtInHand("flat_pad_16x16");
  drawing_.setHand(pad, true);
  EXPECT_FALSE(drawing_.posed());
  TactileFrame frame;
  frame.layout = pad.layout;
  frame.values.assign(pad.layout->numCells(), 0.0F);
  frame.values[17] = 100.0F;
  drawing_.setMoment(frame, {});
  EXPECT_TRUE(drawing_.posed());
  EXPECT_EQ(poseNotice(drawing_, false), "");
}

TEST_F(HandSceneBuilderTest, WithoutAnglesItRestsGreyedAndMeasuresNothing) {
  for (const std::vector<double>& none :
       {std::vector<double>(),
        std::vector<double>{1.0, 2.0},
        std::vector<double>(7, std::numeric_limits<double>::quiet_NaN())}) {
    drawing_.setMoment(frame_, kPose);
    fill();
    const QRgb before = scene_.solid.front().color;
    EXPECT_TRUE(drawing_.posed());
    drawing_.setMoment(frame_, none);
    fill();
    EXPECT_FALSE(drawing_.posed());
    EXPECT_TRUE(scene_.clear.empty());
    EXPECT_FALSE(drawing_.handState().contact.taxelSphere);
    EXPECT_NE(scene_.solid.front().color, before);
    EXPECT_FALSE(scene_.solid.empty());
  }
}

TEST_F(HandSceneBuilderTest, AFrameWithoutTouchHasNoSphere) {
  drawing_.setMoment(emptyFrame(), kPose);
  EXPECT_TRUE(fill().clear.empty());
  EXPECT_TRUE(scene_.points.empty());
}

TEST_F(HandSceneBuilderTest, OneMatrixAlone) {
  drawing_.setMoment(frame_, kPose);
  look_.only = 5;
  fill();
  EXPECT_EQ(numOf(colorTable(look_.map)[255]), 0u);
  EXPECT_EQ(numOf(colorsOf(Theme::kDark).taxel.rgb()),
            6u * (sdh2().layout->matrix(5).numTaxels() - 1u));
  const auto few = drawing_.extent(look_).size();
  look_.only.reset();
  EXPECT_LT(few, drawing_.extent(look_).size());
  look_.only = 17;  // of another hand
  EXPECT_FALSE(drawing_.effective(look_).only);
}

TEST_F(HandSceneBuilderTest, BarsArePointsAreNormalsAre) {
  drawing_.setMoment(frame_, kPose);
  const std::size_t cells = fill().solid.size();
  look_.taxels = TaxelShape::kBars;
  EXPECT_EQ(fill().solid.size(), cells + 3u * 30u);  // five faces for each of three
  look_.taxels = TaxelShape::kPoints;
  look_.contacts = false;
  EXPECT_EQ(fill().points.size(), 456u);
  EXPECT_EQ(scene_.solid.size(), cells - 456u * 6u);
  look_.normals = true;
  EXPECT_EQ(fill().lines.size(), 456u);
  look_.normals = false;
  look_.axes = true;
  EXPECT_EQ(fill().labels.size(), 3u);
  look_.wire = true;
  EXPECT_EQ(fill().solid.size(), 0u);
  EXPECT_GT(scene_.lines.size(), 100u);
  look_.taxels = TaxelShape::kFlatCells;
  look_.wire = false;
  EXPECT_EQ(fill().solid.size(), 456u * 6u);
  EXPECT_TRUE(scene_.labels.empty());
}

// The highest bar stands 30 mm on its taxel.
TEST_F(HandSceneBuilderTest, ABarIsAsHighAsItsShareOfTheRange) {
  drawing_.setMoment(frame_, kPose);
  look_.taxels = TaxelShape::kFlatBars;
  fill();
  float highest = 0.0F, half = 0.0F;
  const QRgb halfColor =
      colorTable(look_.map)[static_cast<std::size_t>(colorIndex(100.0, 0.0, 200.0))];
  for (const SceneVertex& vertex : scene_.solid) {
    highest = std::max(highest, vertex.positionMm[2]);
    if (vertex.color == halfColor) half = std::max(half, vertex.positionMm[2]);
  }
  EXPECT_NEAR(highest, 30.0F, 0.01F);
  EXPECT_NEAR(half, 15.0F, 0.01F);
}

TEST_F(HandSceneBuilderTest, ASensorOfUnknownGeometryIsLaidFlat) {
  const SensorLayout pad({MatrixLayout::full(8, 8, 4.0)});
  drawing_.setHand(describeHand(pad, 0, 0), true);
  EXPECT_FALSE(drawing_.hasGeometry());
  TactileFrame frame(drawing_.hand().layout);
  frame.matrix(0)(3, 3) = 5.0F;
  drawing_.setMoment(frame, {});
  EXPECT_EQ(fill().solid.size(), 64u * 6u);
  EXPECT_EQ(drawing_.extent(look_).size(), 64u);
  look_.only = 0;
  fill();
}

// O-A20: five taxels are 17 mm.
TEST_F(HandSceneBuilderTest, SlipHasALengthOnlyInAPoseAndWordsOnlyOnTheSideThatIsSeen) {
  look_.contacts = false;
  look_.sphere = SphereLook::kNone;
  drawing_.setSlip({{.matrix = 1, .x = 2.0, .y = 4.0, .dx = 0.0, .dy = 5.0, .slipping = true}});
  const auto words = [&] {
    QStringList all;
    for (const SceneLabel& label : fill().labels) all << label.text;
    return all;
  };
  const auto lookAlong = [&](const Eigen::Vector3d& normal) {
    camera_.azimuthDeg = std::atan2(normal.y(), normal.x()) * 180.0 / std::numbers::pi;
    camera_.elevationDeg = std::asin(normal.z()) * 180.0 / std::numbers::pi;
  };
  drawing_.setMoment(frame_, kPose);
  const Eigen::Vector3d normal = geometry_.pose(kPose).normal(1, 4, 2);
  lookAlong(normal);
  EXPECT_EQ(words(), QStringList{"slip 17.0 mm"});
  EXPECT_GT(scene_.lines.size(), 0u);
  lookAlong(-normal);
  EXPECT_EQ(words(), QStringList{});
  // Without joint angles the hand is at rest, without sizes.
  drawing_.setMoment(frame_, {});
  ASSERT_FALSE(drawing_.posed());
  lookAlong(geometry_.pose(std::vector<double>(7, 0.0)).normal(1, 4, 2));
  EXPECT_EQ(words(), QStringList{"slip"});
}

TEST_F(HandSceneBuilderTest, FindsTheTaxelUnderARay) {
  drawing_.setMoment(frame_, kPose);
  const HandPose pose = geometry_.pose(kPose);
  for (const auto& [m, y, x] : {TaxelPlace{1, 4, 2}, TaxelPlace{3, 0, 2}, TaxelPlace{0, 10, 5}}) {
    const Eigen::Vector3d at = pose.positionMm(m, y, x), out = pose.normal(m, y, x);
    EXPECT_EQ(drawing_.taxelUnder(at + 8.0 * out, -out, look_), (TaxelPlace{m, y, x}));
    // From behind, the link is in the way.
    EXPECT_EQ(drawing_.taxelUnder(at - 60.0 * out, out, look_), std::nullopt);
  }
  EXPECT_EQ(drawing_.taxelUnder({0.0, 0.0, 500.0}, Eigen::Vector3d::UnitZ(), look_), std::nullopt);
}

// A pad of two taxels laid flat: pressed and sheared to the right and down, and pulled.
TEST_F(HandSceneBuilderTest, ReadingsHaveSignsAndArrows) {
  MatrixLayout matrix = MatrixLayout::full(1, 2, 2.0);
  matrix.touch = {.components = 3, .isSigned = true, .threshold = 1.0F};
  const HandDescription pad = describeHand(SensorLayout({matrix}), 0, 0);
  drawing_.setHand(pad, true);
  TactileFrame frame(pad.layout);
  frame.readings = {30, 40, 100, 0, 0, -100};
  decideTouch(frame, nullptr);
  drawing_.setMoment(frame, {});
  look_.range = {-100.0, 100.0};
  look_.isSigned = true;
  look_.arrows = 2.0;
  fill();
  const ColorTable& table = differenceTable(look_.theme);
  EXPECT_EQ(numOf(table.front()), 6u);
  EXPECT_EQ(numOf(table.back()), 6u);
  ASSERT_EQ(scene_.lines.size(), 5u) << "a line and four of its head; the other isn't sheared";
  // 2 * 2 mm * (30, 40) / 100, down is -y.
  const Eigen::Vector3f way = scene_.lines[0].toMm - scene_.lines[0].fromMm;
  EXPECT_LT((way - Eigen::Vector3f(1.2F, -1.6F, 0.0F)).norm(), 1e-5F);
  look_.arrows = 0.0;
  EXPECT_TRUE(fill().lines.empty());
  look_.isSigned = false;
  look_.view = TaxelView::kMagnitude;
  look_.range = {0.0, 100.0};
  fill();
  EXPECT_EQ(numOf(colorTable(look_.map).back()), 12u);
  HandLook other;
  other.arrows = 5.0;
  other.isSigned = true;
  const HandLook taken = withColorsOf(look_, other);
  EXPECT_EQ(taken.arrows, 5.0);
  EXPECT_TRUE(taken.isSigned);
  EXPECT_EQ(taken.view, TaxelView::kNormal);
}

TEST_F(HandSceneBuilderTest, WithoutAHandNothingIsDrawn) {
  drawing_.clear();
  EXPECT_TRUE(fill().solid.empty());
  EXPECT_TRUE(drawing_.extent(look_).empty());
  EXPECT_EQ(drawing_.taxelUnder(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), look_),
            std::nullopt);
}

}  // namespace
}  // namespace palpate::gui::hand_scene_builder_test
