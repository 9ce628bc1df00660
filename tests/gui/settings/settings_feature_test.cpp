#include "gui/settings/settings_feature.h"

#include <QTimer>

#include "gui/appearance/text_size.h"
#include "gui/export/export_request.h"
#include "gui/testing/window_fixture.h"

namespace palpate::gui::settings_feature_test {
namespace {

class SettingsFeatureTest : public WindowTest {
 protected:
  ~SettingsFeatureTest() override { applyTextPt(0); }
  SettingsFeature& feature() { return window().feature<SettingsFeature>(); }
  QString path(const char* name) {
    std::filesystem::create_directories(folder_ / name);
    return QString::fromStdString((folder_ / name).string());
  }
  void restart() {
    window().close();
    start();
  }
};

TEST_F(SettingsFeatureTest, AppliesAtOnceAndRemembers) {
  WindowChoices wanted = feature().choices();
  wanted.theme = ThemeChoice::kLight;
  wanted.textPt = 12;
  wanted.map = ColorMapName::kTurbo;
  wanted.range = RangeMode::kFullScale;
  wanted.recordings = path("runs");
  wanted.exports = path("pictures");
  wanted.reopen = false;
  feature().apply(wanted);
  EXPECT_EQ(feature().choices(), wanted);
  EXPECT_EQ(window().state().appearance.view().map, ColorMapName::kTurbo);
  EXPECT_NEAR(QApplication::font().pointSizeF(), 12.0, 0.01);
  restart();
  EXPECT_EQ(feature().choices(), wanted);
  EXPECT_EQ(loadRecordingSettings(window().state().settings).folder, path("runs"));
  EXPECT_EQ(loadExportRequest(window().state().settings).folder, path("pictures"));
}

TEST_F(SettingsFeatureTest, TheRecordingDialogTakesTheFolder) {
  WindowChoices wanted = feature().choices();
  wanted.recordings = path("runs");
  feature().apply(wanted);
  QString asked;
  window().state().prompts.recording = [&](const RecordingSettings& last, const QString&) {
    asked = last.folder;
    return std::optional<RecordingSettings>();
  };
  actions().at("recordingSettings")->trigger();
  EXPECT_EQ(asked, path("runs"));
}

TEST_F(SettingsFeatureTest, CancelRestores) {
  const WindowChoices before = feature().choices();
  QTimer::singleShot(0, [&] {
    auto* dialog = window().findChild<SettingsDialog*>();
    ASSERT_NE(dialog, nullptr);
    WindowChoices other = before;
    other.theme = before.theme == ThemeChoice::kLight ? ThemeChoice::kDark : ThemeChoice::kLight;
    other.textPt = 14;
    emit dialog->changed(other);
    EXPECT_EQ(feature().choices(), other);
    dialog->reject();
  });
  press(Qt::Key_Comma, Qt::ControlModifier);
  EXPECT_EQ(feature().choices(), before);
}

TEST_F(SettingsFeatureTest, ForgetsWhenTheWindowCloses) {
  open({"good.dsa"});
  window().state().settings.setValue("connection/tactile_port", "/dev/one");
  window().state().settings.setValue("slip/step_taxels", 3);
  WindowChoices wanted = feature().choices();
  wanted.forgotten = {"recent", "connection"};
  feature().apply(wanted);
  EXPECT_FALSE(window().state().recent.paths().isEmpty()) << "not before";
  restart();
  EXPECT_TRUE(window().state().recent.paths().isEmpty());
  EXPECT_FALSE(window().state().settings.contains("connection/tactile_port"));
  EXPECT_TRUE(window().state().settings.contains("slip/step_taxels"));
  EXPECT_TRUE(feature().choices().forgotten.isEmpty()) << "only once";
  wanted = feature().choices();
  wanted.forgotten = {"everything"};
  wanted.map = ColorMapName::kGrey;
  feature().apply(wanted);
  restart();
  EXPECT_FALSE(window().state().settings.contains("slip/step_taxels"));
  EXPECT_EQ(feature().choices().map, ColorMapName::kInferno);
}

TEST_F(SettingsFeatureTest, ReopensUnlessToldOtherwise) {
  EXPECT_TRUE(reopensSession(window().state().settings));
  WindowChoices wanted = feature().choices();
  wanted.reopen = false;
  feature().apply(wanted);
  EXPECT_FALSE(reopensSession(window().state().settings));
}

}  // namespace
}  // namespace palpate::gui::settings_feature_test
