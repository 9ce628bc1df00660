// The grasp that the start page plays.
#include "gui/shell/start_scene.h"

#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

#include "testing/testing.h"

namespace palpate::gui::start_scene_test {
namespace {

TEST(StartScene, PlaysAGraspOnceItIsShown) {
  StartScene scene(testing::dataFolder() / "demo_grasps.dsa", nullptr);
  scene.resize(560, 240);
  EXPECT_EQ(scene.numPictures(), 0u);
  scene.show();
  ASSERT_TRUE(QTest::qWaitFor([&] { return scene.numPictures() >= 12; }, 60'000));
  const QImage early = scene.grab().toImage();
  ASSERT_TRUE(QTest::qWaitFor([&] { return scene.grab().toImage() != early; }, 60'000));
  QSignalSpy clicked(&scene, &StartScene::clicked);
  QTest::mouseClick(&scene, Qt::LeftButton);
  EXPECT_EQ(clicked.count(), 1);
}

// It is decoration: nothing is said, and nothing waits for it.
TEST(StartScene, WithoutTheRecordingThereIsAnEmptyPicture) {
  StartScene scene(testing::dataFolder() / "nothing.dsa", nullptr);
  scene.resize(560, 240);
  scene.show();
  QTest::qWait(300);
  EXPECT_EQ(scene.numPictures(), 0u);
  EXPECT_FALSE(scene.grab().isNull());
}

}  // namespace
}  // namespace palpate::gui::start_scene_test
