// Grasps of the emulated hand, and a small model of them.
#pragma once

#include <QSettings>
#include <memory>
#include <string>
#include <vector>

#include <palpate/emulator/simulated_recording.h>
#include <palpate/model/profile_builder.h>
#include <palpate/recognition/trained_model.h>
#include <palpate/recording/recording.h>

#include "gui/recognise_panel.h"
#include "window_fixture.h"

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
      : panel_(std::make_unique<RecognisePanel>(settings_, testing::dataFolder())) {
    panel_->resize(460, 640);
    panel_->setTheme(Theme::kDark);
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
  QSettings settings_{QString::fromStdString((folder_ / "palpate.ini").string()),
                      QSettings::IniFormat};
  std::unique_ptr<RecognisePanel> panel_;
};

}  // namespace palpate::gui
