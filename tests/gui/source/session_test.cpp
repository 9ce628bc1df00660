#include "gui/source/session.h"

#include "gui/open/session_storage.h"
#include "gui/testing/window_fixture.h"
#include "gui/timeline/timeline_feature.h"
#include "gui/timeline/timeline_panel.h"

namespace palpate::gui::session_test {
namespace {

class SessionTest : public WindowTest {};

TEST_F(SessionTest, IsStoredAndReadBack) {
  QSettings settings(settingsFile() + "2", QSettings::IniFormat);
  const Session session{
      .files = {{"/a/b.dsa", {.frame = 7, .seen = TimeSpan{0.1, 1.0 / 3.0}, .selection = {}}},
                {"/c, d.palpate", {.frame = 0, .seen = {}, .selection = TimeSpan{2.0, 2.5}}}},
      .current = 1};
  saveSession(session, settings);
  EXPECT_EQ(loadSession(settings), session);
  saveSession({}, settings);
  EXPECT_EQ(loadSession(settings), Session());
}

TEST_F(SessionTest, WhatMakesNoSenseIsLeftOut) {
  QSettings settings(settingsFile() + "2", QSettings::IniFormat);
  settings.setValue("session/current", 44);
  settings.beginWriteArray("session/files", 2);
  settings.setArrayIndex(1);
  settings.setValue("path", "x.dsa");
  settings.setValue("seen", QStringList{"5", "nan"});
  settings.setValue("selection", "word");
  settings.endArray();
  const Session session = loadSession(settings);
  ASSERT_EQ(session.files.size(), 1u);
  EXPECT_EQ(session.current, -1);
  EXPECT_FALSE(session.files[0].viewPosition.seen || session.files[0].viewPosition.selection);
}

TEST_F(SessionTest, FilesCursorRangeAndSelectionComeBack) {
  open({"good1.dsa", "rich.dsa", "good2.dsa"});
  press(Qt::Key_Tab, Qt::ControlModifier);  // rich.dsa
  ASSERT_EQ(window().state().displayed.unfilteredRecording()->path.filename(), "rich.dsa");
  auto& chart = window().feature<TimelineFeature>().panel().chart();
  playback().seekFrame(50);
  chart.setVisibleRange(1.0, 2.5);
  chart.setSelection(TimeSpan{1.2, 1.7});
  window().close();
  start();
  restoreSession(window().state());
  waitUntilOpened();
  ASSERT_EQ(window().state().recordings.all().size(), 3u);
  EXPECT_EQ(window().state().displayed.unfilteredRecording()->path.filename(), "rich.dsa");
  EXPECT_EQ(playback().frame(), 50u);
  EXPECT_EQ(window().feature<TimelineFeature>().panel().chart().selection(), (TimeSpan{1.2, 1.7}));
  EXPECT_NEAR(window().feature<TimelineFeature>().panel().chart().seen().lower, 1.0, 1e-9);
  EXPECT_NEAR(window().feature<TimelineFeature>().panel().chart().seen().upper, 2.5, 1e-9);
}

TEST_F(SessionTest, WhereOneWasInEachRecordingIsKeptWhileItIsOpen) {
  open({"good1.dsa", "good2.dsa"});
  playback().seekFrame(11);
  window().feature<TimelineFeature>().panel().chart().setSelection(TimeSpan{0.2, 0.3});
  press(Qt::Key_Tab, Qt::ControlModifier);
  EXPECT_EQ(playback().frame(), 0u);
  EXPECT_FALSE(window().feature<TimelineFeature>().panel().chart().selection());
  press(Qt::Key_Tab, Qt::ControlModifier);
  EXPECT_EQ(playback().frame(), 11u);
  EXPECT_EQ(window().feature<TimelineFeature>().panel().chart().selection(), (TimeSpan{0.2, 0.3}));
}

// As after palpate --demo.
TEST_F(SessionTest, ARunWithoutRecordingsCanLeaveWhatWasOpenBefore) {
  open({"good1.dsa", "good2.dsa"});
  window().close();
  start();
  window().state().keepsSession = true;
  window().close();
  start();
  restoreSession(window().state());
  waitUntilOpened();
  EXPECT_EQ(window().state().recordings.all().size(), 2u);
  window().close();
  start();
  window().state().keepsSession = true;
  open({"rich.dsa"});
  window().close();
  start();
  restoreSession(window().state());
  waitUntilOpened();
  EXPECT_EQ(window().state().recordings.all().size(), 1u) << "one was opened";
}

TEST_F(SessionTest, WhatIsGoneIsSaid) {
  open({"good1.dsa", "good2.dsa"});
  window().close();
  std::filesystem::remove(folder_ / "good1.dsa");
  start();
  restoreSession(window().state());
  waitUntilOpened();
  EXPECT_EQ(window().state().recordings.all().size(), 1u);
  EXPECT_TRUE(bannerText().contains("good1.dsa")) << bannerText().toStdString();
}

}  // namespace
}  // namespace palpate::gui::session_test
