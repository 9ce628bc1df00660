#include "gui/appearance/window_settings.h"

#include <gtest/gtest.h>

#include "testing/testing.h"

namespace palpate::gui::window_settings_test {
namespace {

class WindowSettingsTest : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;
  QString ini_ = QString::fromStdString((folder_ / "a.ini").string());
};

TEST_F(WindowSettingsTest, ReadBackAsWritten) {
  ViewSettings view;
  view.theme = ThemeChoice::kLight;
  view.map = ColorMapName::kCividis;
  view.interpolated = view.values = view.loop = view.skipGaps = true;
  view.range = RangeMode::kManual;
  view.manualMin = 50.0;
  view.manualMax = 725.0;
  view.signal = PlottedSignal::kFilteredMean;
  view.taxels = TaxelView::kMagnitude;
  view.arrows = 0.0;
  view.speed = 0.25;
  {
    QSettings settings(ini_, QSettings::IniFormat);
    saveViewSettings(view, settings);
  }
  QSettings settings(ini_, QSettings::IniFormat);
  const ViewSettings back = loadViewSettings(settings);
  EXPECT_EQ(back.theme, view.theme);
  EXPECT_EQ(back.map, view.map);
  EXPECT_TRUE(back.interpolated && back.values && back.loop && back.skipGaps);
  EXPECT_EQ(back.range, view.range);
  EXPECT_EQ(back.manualMin, 50.0);
  EXPECT_EQ(back.manualMax, 725.0);
  EXPECT_EQ(back.signal, view.signal);
  EXPECT_EQ(back.taxels, view.taxels);
  EXPECT_EQ(back.arrows, 0.0);
  EXPECT_EQ(back.speed, 0.25);
}

TEST_F(WindowSettingsTest, NonsenseReadsAsTheDefaults) {
  testing::writeFile(folder_ / "a.ini",
                     "[view]\ntheme=pink\nmap=jet\nrange=7\nmanual_min=nan\nmanual_max=-4\n"
                     "signal=\n[playback]\nspeed=1e9\n");
  QSettings settings(ini_, QSettings::IniFormat);
  const ViewSettings view = loadViewSettings(settings);
  EXPECT_EQ(view.theme, ThemeChoice::kSystem);
  EXPECT_EQ(view.map, ColorMapName::kInferno);
  EXPECT_EQ(view.range, RangeMode::kRecording);
  EXPECT_EQ(view.manualMin, 0.0);
  EXPECT_EQ(view.manualMax, 1000.0);
  EXPECT_EQ(view.signal, PlottedSignal::kSum);
  EXPECT_EQ(view.speed, 1.0);
}

TEST_F(WindowSettingsTest, AnEmptyManualRangeIsReplaced) {
  testing::writeFile(folder_ / "a.ini", "[view]\nmanual_min=500\nmanual_max=500\n");
  QSettings settings(ini_, QSettings::IniFormat);
  EXPECT_LT(loadViewSettings(settings).manualMin, loadViewSettings(settings).manualMax);
}

TEST_F(WindowSettingsTest, LieInTheUsersConfigFolder) {
  EXPECT_EQ(settingsPath().toStdString(),
            std::string(std::getenv("XDG_CONFIG_HOME")) + "/palpate/palpate.ini");
}

}  // namespace
}  // namespace palpate::gui::window_settings_test
