// The grasp that the start page plays.
#include "gui/shell/start_scene.h"

#include <QSettings>
#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

#include "gui/open/start_page.h"
#include "gui/source/recent_files.h"
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

TEST(StartScene, GivesWayToTheButtonsOnALowPage) {
  const testing::TemporaryFolder folder;
  QSettings settings(QString::fromStdString((folder / "settings.ini").string()),
                     QSettings::IniFormat);
  RecentFiles recent(settings);
  const Thumbnails thumbnails({});
  StartPage page(recent, thumbnails, true);
  auto* scene = new StartScene(testing::dataFolder() / "nothing.dsa", &page);
  page.setScene(scene);
  page.resize(900, 4 * scene->height());
  page.show();
  EXPECT_TRUE(scene->isVisible());
  page.resize(900, 2 * scene->height());
  EXPECT_TRUE(scene->isHidden());
  page.resize(900, 4 * scene->height());
  EXPECT_TRUE(scene->isVisible());
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
