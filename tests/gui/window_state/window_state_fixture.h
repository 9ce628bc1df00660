// The models of the window without the window, for tests of them and of single features: settings,
// clock, files and answers in the test's hands.
#pragma once

#include <QComboBox>
#include <QMenu>
#include <QTest>
#include <QWidget>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "gui/testing/fake_ask.h"
#include "gui/testing/fake_clock.h"
#include "gui/testing/sample_profiles.h"
#include "gui/window_state/window_state.h"
#include "testing/testing.h"

namespace palpate::gui {

class WindowStateTest : public ::testing::Test {
 protected:
  WindowStateTest() {
    windowState_ = std::make_unique<WindowState>(
        WindowEnvironment{.dataFolder = testing::dataFolder(),
                          .settingsPath = QString::fromStdString((folder_ / "p.ini").string()),
                          .clock = &clock_,
                          .read = asRecording([](const std::filesystem::path&, const Progress&) {
                            return twentyFrames();
                          }),
                          .ask = &ask_},
        &actionsOf_);
    windowState_->menus = {.edit = new QMenu(&actionsOf_),
                           .connections = new QMenu(&actionsOf_),
                           .only = new QMenu(&actionsOf_),
                           .scanned = new QMenu(&actionsOf_),
                           .recent = new QMenu(&actionsOf_),
                           .speed = new QComboBox(&actionsOf_),
                           .recordings = new QComboBox(&actionsOf_)};
  }
  // Twenty frames, 50 ms apart, under this name.
  static OpenedRecordingPtr recording(const std::string& name) {
    return makeOpenedRecording(name, twentyFrames());
  }
  void connectEmulated() {
    Connection connection;
    connection.kind = Connection::Kind::kEmulated;
    connection.scene = "ball";
    windowState_->connectTo(connection);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return windowState_->displayed.isLive() && windowState_->currentFrame.hasFrame(); },
        20'000));
  }
  void disconnect() {
    windowState_->live.end();
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return windowState_->live.state() == LiveController::State::kNone; }, 20'000));
  }

  testing::TemporaryFolder folder_;
  FakeClock clock_;
  FakeAsk ask_;
  QWidget actionsOf_;  // whose actions they are; never shown
  std::unique_ptr<WindowState> windowState_;
};

}  // namespace palpate::gui
