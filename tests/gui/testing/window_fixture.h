// A window with its surroundings in the test's hands: clock, files, answers to dialogs.
#pragma once

#include <QApplication>
#include <QSignalSpy>
#include <QTest>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gui/shell/main_window.h"
#include "gui/testing/fake_ask.h"
#include "gui/testing/fake_clock.h"
#include "gui/testing/sample_profiles.h"
#include "testing/testing.h"

namespace palpate::gui {

// Files called *.dsa in `folder` "hold": good*.dsa twenty frames, gap*.dsa a gap of 10 s between
// frames 4 and 5, empty*.dsa no frame, rich*.dsa a synthetic recording with angles and
// temperatures, slip*.dsa a contact that moves (slip_fixture.h), slow*.dsa never ends until
// cancelled; others fail.
class WindowTest : public ::testing::Test {
 protected:
  WindowTest();
  ~WindowTest() override;

  // Makes the window anew, as after a restart of the program.
  MainWindow& start();
  // Made when it is first asked for: `environment_`, the settings and files can be changed before.
  MainWindow& window() { return window_ ? *window_ : start(); }
  const ActionRegistry& actions() { return window().state().actions; }
  PlaybackController& playback() { return window().state().playback; }
  // Makes an empty file, so that it exists; returns its path.
  std::string file(const std::string& name);
  // Opens by WindowState::open() and waits for the end of it.
  void open(const std::vector<std::string>& names);
  void waitUntilOpened();
  void press(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier);
  // As from the menu.
  void trigger(const char* action) { actions().at(action)->trigger(); }
  void choose(const char* group, int index) {
    actions().group(group)->actions().at(index)->trigger();
  }
  template <class Widget>
  Widget* find(const char* name) {
    return window().findChild<Widget*>(name);
  }
  QString bannerText();
  QString settingsFile() const;

  testing::TemporaryFolder folder_;
  FakeClock clock_;
  FakeAsk ask_;
  std::atomic<int> reads_ = 0;
  WindowEnvironment environment_;  // without `read` files are read as they are
  std::unique_ptr<MainWindow> window_;
};

}  // namespace palpate::gui
