// takeScreenshot: the window as a file.
#include <QImage>

#include <gtest/gtest.h>

#include <palpate/core/error.h>

#include "gui/appearance/window_settings.h"
#include "gui/shell/run_window.h"
#include "testing/testing.h"

namespace palpate::gui::screenshot_test {
namespace {

class ScreenshotTest : public ::testing::Test {
 protected:
  ScreenshotOptions options(const char* name = "w.png") {
    ScreenshotOptions usual;
    usual.out = folder_ / name;
    usual.size = QSize(1280, 800);
    usual.dataFolder = testing::dataFolder();
    return usual;
  }
  ScreenshotOptions ofDemoFile(const char* name = "w.png") {
    ScreenshotOptions with = options(name);
    with.file = testing::dataFolder() / "demo_grasps.dsa";
    return with;
  }
  QImage shot(const ScreenshotOptions& with) {
    std::string program = "palpate";
    char* arguments[] = {program.data(), nullptr};
    int count = 1;
    EXPECT_EQ(takeScreenshot(count, arguments, with), 0);
    return QImage(QString::fromStdString(with.out.string()));
  }
  std::string failure(const ScreenshotOptions& with) {
    try {
      shot(with);
    } catch (const Error& error) {
      EXPECT_FALSE(std::filesystem::exists(with.out));
      return error.what();
    }
    return "it worked";
  }
  testing::TemporaryFolder folder_;
};

TEST_F(ScreenshotTest, HasTheSizeAskedFor) {
  for (const QSize size : {QSize(1280, 800), QSize(1600, 1000), QSize(640, 480)}) {
    ScreenshotOptions with = ofDemoFile();
    with.size = size;
    with.force = true;
    EXPECT_EQ(shot(with).size(), size);
  }
}

TEST_F(ScreenshotTest, ThemeFrameAndStartPageMakeADifference) {
  const QImage dark = shot(ofDemoFile("a.png"));
  EXPECT_EQ(dark, shot(ofDemoFile("b.png"))) << "the same twice";
  ScreenshotOptions other = ofDemoFile("c.png");
  other.theme = "light";
  const QImage light = shot(other);
  EXPECT_LT(dark.pixelColor(3, 3).lightness(), 60);
  EXPECT_GT(light.pixelColor(3, 3).lightness(), 200);
  other = ofDemoFile("d.png");
  other.frame = 0;
  EXPECT_NE(shot(other), dark);
  EXPECT_NE(shot(options("e.png")), dark);
}

TEST_F(ScreenshotTest, TheDemoPlaysFirst) {
  ScreenshotOptions demo = options();
  demo.demo = true;
  demo.afterS = 0.3;
  EXPECT_EQ(shot(demo).size(), QSize(1280, 800));
}

TEST_F(ScreenshotTest, WhatIsPressedAndRememberedIsSeen) {
  const QImage usual = shot(ofDemoFile("usual.png"));
  ScreenshotOptions with = ofDemoFile("pressed.png");
  with.presses = {{"Ctrl+I", 0.0}};  // hides Inspect
  const QImage pressed = shot(with);
  EXPECT_EQ(pressed.size(), usual.size());
  EXPECT_NE(pressed, usual);
  with = ofDemoFile("keys.png");
  with.presses = {{"F1", 0.0}};
  EXPECT_NE(shot(with).size(), usual.size()) << "the dialogue alone";
  with = ofDemoFile("dock.png");
  with.docks = {"slip"};  // in any case of its letters
  EXPECT_NE(shot(with), usual);
  with = ofDemoFile("settings.png");
  testing::writeFile(folder_ / "s.ini", "[view]\nmap=viridis\n");
  with.settings = folder_ / "s.ini";
  EXPECT_NE(shot(with), usual);
  EXPECT_EQ(testing::readFile(folder_ / "s.ini"), "[view]\nmap=viridis\n");
}

TEST_F(ScreenshotTest, SaysWhatIsWrong) {
  ScreenshotOptions with = ofDemoFile();
  with.frame = 99'999'999;
  EXPECT_NE(failure(with).find("no frame 99999999"), std::string::npos);
  with = ofDemoFile();
  with.docks = {"Nonsense"};
  EXPECT_NE(failure(with).find("no dock 'Nonsense': there are Inspect, Timeline"),
            std::string::npos);
  with = options();
  with.file = folder_ / "missing.dsa";
  EXPECT_NE(failure(with).find("missing.dsa"), std::string::npos);
  with = options();
  with.theme = "pink";
  EXPECT_NE(failure(with).find("pink"), std::string::npos);
  with = ofDemoFile();
  with.out = folder_ / "no" / "w.png";
  EXPECT_THROW(shot(with), FileError);
}

TEST_F(ScreenshotTest, DoesNotReplaceUnlessForced) {
  ScreenshotOptions with = ofDemoFile();
  testing::writeFile(with.out, "precious");
  EXPECT_THROW(shot(with), FileError);
  EXPECT_EQ(testing::readFile(with.out), "precious");
  with.force = true;
  EXPECT_FALSE(shot(with).isNull());
}

TEST_F(ScreenshotTest, LeavesTheUsersSettingsAlone) {
  shot(ofDemoFile());
  EXPECT_FALSE(std::filesystem::exists(settingsPath().toStdString()));
}

}  // namespace
}  // namespace palpate::gui::screenshot_test
