// A window with its surroundings in the test's hands: clock, files, answers to dialogs.
#pragma once

#include <QApplication>
#include <QSignalSpy>
#include <QTest>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include <palpate/core/time.h>
#include <palpate/model/profile.h>

#include "gui/shell/main_window.h"
#include "testing/testing.h"

namespace palpate::gui {

class FakeClock : public Clock {
 public:
  std::int64_t monotonicUs() const override { return nowUs_; }
  std::int64_t wallUs() const override { return nowUs_; }
  void advanceMs(std::int64_t ms) { nowUs_ += ms * 1000; }

 private:
  std::int64_t nowUs_ = 5'000'000;
};

// A profile of the SDH-2 with one frame per stamp [ms]; frame i has the value 10 * (i + 1) counts in
// row 7, column 2 of finger 0 distal (matrix 1), and nothing else.
Profile profileWithStamps(const std::vector<std::int64_t>& stampsMs);
// As above with 20 frames, 50 ms apart.
Profile twentyFrames();
// One frame of the SDH-2, all zero.
TactileFrame emptyFrame();

// Files called *.dsa in `folder` "hold": good*.dsa twenty frames, gap*.dsa a gap of 10 s between
// frames 4 and 5, empty*.dsa no frame, rich*.dsa a synthetic recording with angles and temperatures,
// slip*.dsa a contact that moves (slip_fixture.h),
// slow*.dsa never ends until cancelled; others fail.
class WindowTest : public ::testing::Test {
 protected:
  WindowTest();
  ~WindowTest() override;

  // Makes the window anew, as after a restart of the program.
  MainWindow& start();
  MainWindow& window() { return *window_; }
  const Actions& actions() { return window_->actionList(); }
  PlaybackController& playback() { return window_->playback(); }
  // Makes an empty file, so that it exists; returns its path.
  std::string file(const std::string& name);
  // Opens by openFiles() and waits for the end of it.
  void open(const std::vector<std::string>& names);
  void waitUntilOpened();
  void press(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier);
  template <class Widget>
  Widget* find(const char* name) {
    return window_->findChild<Widget*>(name);
  }
  QString bannerText();
  QString settingsFile() const;

  testing::TemporaryFolder folder_;
  FakeClock clock_;
  std::atomic<int> reads_ = 0;
  std::unique_ptr<MainWindow> window_;
};

}  // namespace palpate::gui
