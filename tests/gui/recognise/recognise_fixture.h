// Grasps of the emulated hand, and a small model of them.
#pragma once

#include <QDockWidget>
#include <QSettings>
#include <memory>
#include <string>
#include <vector>

#include <palpate/emulator/simulated_recording.h>
#include <palpate/model/profile_builder.h>
#include <palpate/recognition/trained_model.h>
#include <palpate/recording/recording.h>

#include "gui/recognise/recognise_panel.h"
#include "gui/testing/fake_ask.h"
#include "gui/testing/window_fixture.h"

namespace palpate::gui {

inline Scene sceneOf(const std::string& name) {
  return loadScene(name, testing::dataFolder() / "scenes");
}

// So many grasps of an object of data/scenes, on the day on which the model in data/ was made.
inline Profile graspsOf(const std::string& name, int count, std::uint64_t seed = 7) {
  SimulatedRecordingOptions options;
  options.hand.seed = seed;
  return simulateGrasps(sceneOf(name), count, {}, options);
}

class RecognisePanelTest : public ::testing::Test {
 protected:
  RecognisePanelTest()
      : panel_(std::make_unique<RecognisePanel>(settings_, testing::dataFolder(), ask_)) {
    panel_->resize(460, 640);
    applyTheme(*qApp, Theme::kDark);
  }
  // A folder with so many grasps of some objects.
  std::filesystem::path teach(const std::vector<std::string>& objects, int grasps) {
    const std::filesystem::path folder = folder_ / "objects";
    for (const std::string& object : objects) {
      std::filesystem::create_directories(folder / object);
      saveRecording(graspsOf(object, grasps), {}, folder / object / (object + ".palpate"));
    }
    return folder;
  }
  template <class Widget>
  Widget* find(const char* name) {
    auto* found = panel_->findChild<Widget*>(name);
    if (!found) throw std::runtime_error(std::string("no ") + name);
    return found;
  }
  void settle() {
    panel_->settle();
    QCoreApplication::processEvents();
  }
  testing::TemporaryFolder folder_;
  FakeAsk ask_;
  QSettings settings_{QString::fromStdString((folder_ / "palpate.ini").string()),
                      QSettings::IniFormat};
  std::unique_ptr<RecognisePanel> panel_;
};

class RecogniseWindowTest : public WindowTest {
 protected:
  RecogniseWindowTest() {
    environment_ = {};
    environment_.dataFolder = testing::dataFolder();
    environment_.settingsPath = settingsFile();
  }
  QDockWidget* dock() { return window().findChild<QDockWidget*>("Recognise"); }
  RecognisePanel& panel() { return *find<RecognisePanel>("RecognisePanel"); }
  const RecognitionAnswer& answer() { return panel().controller().answer(); }
  void settle() {
    panel().settle();
    QCoreApplication::processEvents();
  }
  std::string record(const std::string& object) {
    const auto path = folder_ / (object + ".palpate");
    saveRecording(graspsOf(object, 2), {}, path);
    return path.string();
  }
  void openIt(const std::string& path) {
    QSignalSpy shown(&window().state().displayed, &DisplayedSource::shown);
    window().state().open({path});
    ASSERT_TRUE(shown.wait(20'000));
  }
  // Grasps a scene by its script, asks while it is held, until it is named.
  QString heldName(const std::string& scene) {
    Connection connection;
    connection.kind = Connection::Kind::kEmulated;
    connection.scene = QString::fromStdString(scene);
    connection.sceneScriptRuns = true;
    window().state().connectTo(connection);
    if (!dock()->isVisible()) window().docks().show("Recognise");
    const bool told = QTest::qWaitFor(
        [&] {
          QTest::qWait(250);
          press(Qt::Key_Q);
          settle();
          return answer().sure || answer().kind == RecognitionAnswer::Kind::kUnknown;
        },
        30'000);
    const QString name = told ? answer().name() : "not told: " + answer().accessibleText();
    window().state().live.end();
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return window().state().live.state() == LiveController::State::kNone; }, 20'000));
    return name;
  }
};

}  // namespace palpate::gui
