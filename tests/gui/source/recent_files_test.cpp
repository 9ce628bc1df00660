#include "gui/source/recent_files.h"

#include <QDir>
#include <QSignalSpy>

#include <gtest/gtest.h>

#include "testing/testing.h"

namespace palpate::gui::recent_files_test {
namespace {

class RecentFilesTest : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;
  QString ini_ = QString::fromStdString((folder_ / "a.ini").string());
};

TEST_F(RecentFilesTest, NewestFirstEachOnceAtMostTen) {
  QSettings settings(ini_, QSettings::IniFormat);
  RecentFiles recent(settings);
  for (int i = 0; i < 14; ++i) recent.add("/data/" + QString::number(i) + ".dsa");
  ASSERT_EQ(recent.paths().size(), 10);
  EXPECT_EQ(recent.paths().first(), "/data/13.dsa");
  EXPECT_EQ(recent.paths().last(), "/data/4.dsa");
  recent.add("/data/7.dsa");
  EXPECT_EQ(recent.paths().size(), 10);
  EXPECT_EQ(recent.paths().first(), "/data/7.dsa");
  EXPECT_EQ(recent.paths().count("/data/7.dsa"), 1);
}

TEST_F(RecentFilesTest, AreRememberedWithEveryLetter) {
  const QString odd = "/dä ta/a, b; \"c\" \\ 手.dsa";
  {
    QSettings settings(ini_, QSettings::IniFormat);
    RecentFiles(settings).add(odd);
  }
  QSettings settings(ini_, QSettings::IniFormat);
  EXPECT_EQ(RecentFiles(settings).paths(), QStringList{odd});
}

TEST_F(RecentFilesTest, RelativeNamesBecomeAbsolute) {
  QSettings settings(ini_, QSettings::IniFormat);
  RecentFiles recent(settings);
  recent.add("ball.dsa");
  EXPECT_EQ(recent.paths().first(), QDir::currentPath() + "/ball.dsa");
}

TEST_F(RecentFilesTest, ForgetsOneTheMissingOrAll) {
  const std::string here = folder_ / "here.dsa";
  testing::writeFile(here, "");
  QSettings settings(ini_, QSettings::IniFormat);
  RecentFiles recent(settings);
  QSignalSpy changed(&recent, &RecentFiles::changed);
  recent.add("/gone/a.dsa");
  recent.add(QString::fromStdString(here));
  recent.add("/gone/b.dsa");
  recent.look();
  EXPECT_FALSE(recent.isMissing("/gone/b.dsa")) << "the folder has not answered yet (window F13)";
  recent.settle();
  EXPECT_TRUE(recent.isMissing("/gone/b.dsa"));
  recent.remove("/gone/b.dsa");
  EXPECT_EQ(recent.paths().size(), 2);
  recent.removeMissing();
  EXPECT_EQ(recent.paths(), QStringList{QString::fromStdString(here)});
  EXPECT_EQ(changed.size(), 6);
  recent.remove("/never/there.dsa");
  EXPECT_EQ(changed.size(), 6);
  recent.clear();
  EXPECT_TRUE(recent.paths().isEmpty());
}

}  // namespace
}  // namespace palpate::gui::recent_files_test
