// Single joints and own poses in the dock Hand, on the emulated hand.
#include "gui/hand/joint_panel.h"

#include <QAction>
#include <QComboBox>
#include <QFile>
#include <QSlider>
#include <QTabBar>

#include "palpate/device/sdh2.h"

#include "gui/hand/hand_dock_bench.h"
#include "gui/source/file_reading.h"

namespace palpate::gui::joint_panel_test {
namespace {
using testing::stillHand;

class JointPanelTest : public HandDockBench {
 protected:
  void connectAndOpen() {
    connectTo(stillHand());
    dock_->resize(520, 900);
    find<QTabBar>("handPages")->setCurrentIndex(1);
    panel_ = dock_->findChild<JointPanel*>();
    ASSERT_TRUE(await([&] { return find<ValueSlider>("targetAngle1")->value() == -75.0; }));
  }
  std::vector<double> angles() {
    std::vector<double> now;
    bench_->hand->withModel([&](HandModel& model) { now = model.joints().angles(); });
    return now;
  }
  void save(const QString& name) {
    ask_.texts = {name};
    click("savePose");
  }
  std::vector<double> saved(const QString& name) {
    const auto pose = panel_->saved().load(name);
    return pose ? pose->anglesDeg : std::vector<double>{};
  }
  JointPanel* panel_ = nullptr;
};

TEST_F(JointPanelTest, NothingMovesBeforeMoveIsPressed) {
  connectAndOpen();
  type("jointVelocity", "100");
  EXPECT_FALSE(isEnabled("moveJoints"));
  EXPECT_FALSE(isEnabled("moveJoint2"));
  QSlider* slider = find<ValueSlider>("targetAngle2")->slider();
  slider->setSliderDown(true);
  for (const int value : {100, 60, 40}) slider->setSliderPosition(value);
  slider->setSliderDown(false);
  QTest::qWait(150);
  EXPECT_TRUE(bench_->log.deeds().empty());
  EXPECT_EQ(find<QLabel>("presentAngle2")->text(), "75.0°");
  EXPECT_EQ(find<ValueSlider>("targetAngle2")->value(), 20.0);
  ASSERT_TRUE(isEnabled("moveJoint2"));
  auto* move = find<QPushButton>("moveJoint2");
  move->setFocus();
  QTest::keyClick(move, Qt::Key_Space);
  EXPECT_TRUE(bench_->log.deeds().empty()) << "Space moves nothing";
  click("moveJoint2");
  ASSERT_TRUE(await([&] { return std::abs(angles()[2] - 20.0) < 0.01; }));
  ASSERT_TRUE(await([&] { return !isEnabled("moveJoint2"); })) << "its target is reached";
  for (const std::size_t axis : {std::size_t{1}, std::size_t{3}, std::size_t{5}})
    EXPECT_NEAR(angles()[axis], -75.0, 0.01) << "the others stay";
  EXPECT_NEAR(angles()[0], 60.0, 0.01);
}

TEST_F(JointPanelTest, AllChangedJointsMoveTogetherAndAStoppedTargetStays) {
  connectAndOpen();
  type("jointVelocity", "5");
  type("targetAngle3", "-10");
  type("targetAngle5", "-20");
  click("moveJoints");
  ASSERT_TRUE(bench_->awaitMotion());
  EXPECT_TRUE(await([&] { return !isEnabled("moveJoints"); }));
  EXPECT_EQ(bench_->control->status().request->velocityDegPerS, 5.0);
  click("stopHand");
  ASSERT_TRUE(await([&] { return !bench_->handMoves() && isEnabled("moveJoints"); }));
  EXPECT_EQ(find<ValueSlider>("targetAngle3")->value(), -10.0);
  EXPECT_TRUE(isEnabled("resetTargets"));
  click("resetTargets");
  EXPECT_TRUE(await([&] { return find<ValueSlider>("targetAngle3")->value() < -60.0; }));
  EXPECT_FALSE(isEnabled("moveJoints"));
}

// A target that is set while a motion runs is not taken for reached when that motion ends.
TEST_F(JointPanelTest, ATargetSetDuringAMotionStays) {
  connectAndOpen();
  type("jointVelocity", "60");
  type("targetAngle4", "30");
  click("moveJoint4");
  ASSERT_TRUE(bench_->awaitMotion());
  type("targetAngle4", "50");
  ASSERT_TRUE(await([&] { return std::abs(angles()[4] - 30.0) < 0.01; }));
  EXPECT_TRUE(await([&] { return isEnabled("moveJoint4"); }));
  EXPECT_EQ(find<ValueSlider>("targetAngle4")->value(), 50.0);
}

// 999 became 90, and Move would have gone there.
TEST_F(JointPanelTest, AnAngleBeyondTheRangeIsRefusedAndArmsNothing) {
  connectAndOpen();
  const double before = find<ValueSlider>("targetAngle2")->value();
  for (const char* typed : {"999", "-300", "ninety", ""}) {
    type("targetAngle2", typed);
    EXPECT_EQ(find<ValueSlider>("targetAngle2")->value(), before) << typed;
    dock_->refresh();
    EXPECT_FALSE(isEnabled("moveJoint2")) << typed;
    EXPECT_FALSE(isEnabled("moveJoints")) << typed;
  }
}

TEST_F(JointPanelTest, AnAngleBeyondTheRangeIsSaidAndMarked) {
  connectAndOpen();
  QDoubleSpinBox* field = find<ValueSlider>("targetAngle2")->field();
  type("targetAngle2", "80");
  type("targetAngle2", "200");
  EXPECT_EQ(field->value(), 80.0);
  EXPECT_TRUE(state().contains("finger 0 distal: 200 is out of -90 .. 90°; 80.0 stays"))
      << state().toStdString();
  EXPECT_TRUE(field->property("refused").toBool());
  dock_->refresh();
  EXPECT_TRUE(isEnabled("moveJoint2")) << "as it was";
  type("targetAngle2", "70");
  EXPECT_FALSE(field->property("refused").toBool());
  EXPECT_FALSE(state().contains("out of")) << state().toStdString();
  // The range's own end is in it; the second time is no less refused than the first.
  type("targetAngle2", "90");
  EXPECT_FALSE(field->property("refused").toBool());
  type("targetAngle2", "91");
  EXPECT_TRUE(field->property("refused").toBool());
  EXPECT_TRUE(state().contains("91 is out of")) << state().toStdString();
}

TEST_F(JointPanelTest, APoseIsSavedGoneToRenamedAndDeleted) {
  connectAndOpen();
  save("rest / soft");
  auto* names = find<QComboBox>("ownPoses");
  EXPECT_EQ(names->currentText(), "rest / soft");
  type("jointVelocity", "100");
  type("targetAngle4", "10");
  click("moveJoint4");
  ASSERT_TRUE(await([&] { return std::abs(angles()[4] - 10.0) < 0.01 && !bench_->handMoves(); }));
  const std::size_t motions = bench_->log.named("m").size();
  names->setCurrentIndex(1);
  emit names->activated(1);
  EXPECT_EQ(find<ValueSlider>("targetAngle4")->value(), 75.0);
  EXPECT_EQ(bench_->log.named("m").size(), motions) << "choosing moves nothing";
  ASSERT_TRUE(await([&] { return isEnabled("moveJoints"); }));
  click("moveJoints");
  ASSERT_TRUE(await([&] { return std::abs(angles()[4] - 75.0) < 0.01; }));
  ask_.texts = {"home"};
  ask_.choices = {"Delete"};
  click("renamePose");
  EXPECT_EQ(names->count(), 2);
  EXPECT_EQ(names->itemText(1), "home");
  click("removePose");
  EXPECT_EQ(names->count(), 1);
}

TEST_F(JointPanelTest, AnOwnPoseIsLostOnlyAfterAQuestion) {
  connectAndOpen();
  save("wide open");
  EXPECT_TRUE(ask_.choices.asked.isEmpty()) << "it is a new one";
  const std::vector<double> before = saved("wide open");
  ASSERT_EQ(before.size(), 7u);
  type("jointVelocity", "100");
  type("targetAngle4", "10");
  ASSERT_TRUE(await([&] { return isEnabled("moveJoint4"); }));
  click("moveJoint4");
  ASSERT_TRUE(await([&] {
    return std::abs(angles()[4] - 10.0) < 0.01 && isEnabled("savePose") &&
           find<QLabel>("presentAngle4")->text() == "10.0°";
  }));
  ask_.choices = {QString(), "Replace", QString(), "Delete"};
  save("wide open");
  EXPECT_EQ(ask_.choices.asked.back(), "Replace the pose \"wide open\" with the current angles?");
  EXPECT_EQ(saved("wide open"), before);
  save("wide open");
  EXPECT_NEAR(saved("wide open").at(4), 10.0, 0.05);
  click("removePose");
  EXPECT_EQ(ask_.choices.asked.back(), "Delete the pose \"wide open\"?");
  EXPECT_FALSE(saved("wide open").empty());
  click("removePose");
  EXPECT_TRUE(saved("wide open").empty());
}

// The angles of one moment of a motion were saved.
TEST_F(JointPanelTest, NothingIsSavedWhileTheHandMoves) {
  connectAndOpen();
  type("jointVelocity", "5");
  type("targetAngle3", "-10");
  click("moveJoint3");
  ASSERT_TRUE(bench_->awaitMotion());
  EXPECT_TRUE(await([&] { return !isEnabled("savePose"); }));
  EXPECT_EQ(find<QPushButton>("savePose")->toolTip(),
            "The hand moves: angles are saved when it stands still");
  click("stopHand");
  EXPECT_TRUE(await([&] { return isEnabled("savePose"); }));
  EXPECT_EQ(find<QPushButton>("savePose")->toolTip(), "Save the current angles under a name");
}

TEST_F(JointPanelTest, TheListDropsTheNameWhenTargetsAreChanged) {
  connectAndOpen();
  save("rest");
  auto* names = find<QComboBox>("ownPoses");
  ASSERT_EQ(names->currentText(), "rest");
  type("targetAngle4", "10");
  EXPECT_EQ(names->currentIndex(), 0);
  EXPECT_FALSE(isEnabled("removePose"));
  names->setCurrentIndex(1);
  emit names->activated(1);
  EXPECT_EQ(names->currentText(), "rest") << "its angles are the targets";
  QSlider* slider = find<ValueSlider>("targetAngle2")->slider();
  slider->setSliderDown(true);
  EXPECT_EQ(names->currentIndex(), 0);
  slider->setSliderDown(false);
  // The targets that were set stay, and are not those of the pose.
  save("rest 2");
  EXPECT_EQ(names->currentIndex(), 0);
  EXPECT_NE(names->findText("rest 2"), -1);
}

TEST_F(JointPanelTest, APoseOfAnotherHandOrOutOfRangeIsRefusedInOneLine) {
  connectAndOpen();
  SavedPose far{"far", sdh2().name, {0, 0, 120, 0, 0, 0, 0}};
  panel_->saved().save(QString::fromStdString(far.name), far);
  QString why;
  QObject::connect(panel_, &JointPanel::refused, panel_, [&](const QString& said) { why = said; });
  auto* names = find<QComboBox>("ownPoses");
  names->addItem("far");
  names->setCurrentText("far");
  emit names->activated(names->currentIndex());
  EXPECT_TRUE(why.contains("out of range: finger 0 distal at 120")) << why.toStdString();
  EXPECT_FALSE(isEnabled("moveJoints"));
  const QString path = QString::fromStdString((folder_ / "poses.json").string());
  const auto import = [&](const std::string& text) {
    QFile file(path);
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(text.c_str());
    file.close();
    ask_.files = {path};
    why.clear();
    dock_->findChild<QAction*>("importPoses")->trigger();
    FileReading::settleAll(*panel_);
  };
  SavedPose good{"good", sdh2().name, {0, 0, 20, 0, 0, 0, 0}};
  SavedPose foreign{"foreign", "another", {0, 0, 20, 0, 0, 0, 0}};
  import(posesText({good, foreign}));
  EXPECT_TRUE(why.startsWith("nothing imported: the pose 'foreign' is of another hand"))
      << why.toStdString();
  EXPECT_FALSE(panel_->saved().load("good")) << "all or none";
  import("{");
  EXPECT_TRUE(why.contains("poses.json")) << why.toStdString();
  import(posesText({good, good}));
  EXPECT_EQ(why, "nothing imported: the pose 'good' is there twice");
  std::vector<SavedPose> many(1001, good);
  for (std::size_t i = 0; i < many.size(); ++i) many[i].name += std::to_string(i);
  import(posesText(many));
  EXPECT_EQ(why, "nothing imported: more than 1000 poses");
  EXPECT_FALSE(panel_->saved().load("good")) << "all or none";
  import(posesText({good}));
  EXPECT_EQ(why, "");
  EXPECT_TRUE(panel_->saved().load("good"));
}

}  // namespace
}  // namespace palpate::gui::joint_panel_test
