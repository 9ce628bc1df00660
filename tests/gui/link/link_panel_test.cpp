#include "gui/link/link_panel.h"

#include <QApplication>
#include <QCheckBox>
#include <QLabel>
#include <QPlainTextEdit>
#include <QSignalSpy>

#include "testing/testing.h"

namespace palpate::gui::link_panel_test {
namespace {

LinkHealth goodHealth() {
  LinkHealth health;
  health.device.tactile.state = PortState::kStreaming;
  health.device.tactile.port = "/dev/ttyUSB0";
  health.frames.frames = 1234;
  health.frames.rateHz = 31.7;
  health.frames.meanRateHz = 31.66;
  health.frames.ageMs = 18.4;
  health.queues.tactile = {3, 17, 8192};
  health.freeBytes = 118'000'000'000;
  health.diskHours = 1820.0;
  return health;
}

const Fact& fact(const std::vector<Fact>& facts, const QString& name) {
  for (const Fact& each : facts)
    if (each.name == name) return each;
  throw std::runtime_error("no row " + name.toStdString());
}

TEST(LinkPanel, SaysHowTheLinkDoesInUnits) {
  const auto facts = factsOf(goodHealth());
  EXPECT_EQ(fact(facts, "tactile").value, "streaming · /dev/ttyUSB0");
  EXPECT_EQ(fact(facts, "rate").value, "31.7 frames/s (mean 31.7)");
  EXPECT_EQ(fact(facts, "frame age").value, "18 ms");
  EXPECT_EQ(fact(facts, "queue").value, "3 of 8192, most 17");
  EXPECT_EQ(fact(facts, "disk").value, "118.0 GB free, 76 days");
  for (const Fact& each : facts) EXPECT_FALSE(each.warning) << each.name.toStdString();
}

TEST(LinkPanel, TellsOfTheClocksOfSenders) {
  LinkHealth health = goodHealth();
  health.clocks = {{"frames", {.restarts = 1, .driftPpm = 12.3, .delaySpreadMs = 41.0}},
                   {"wrist", {}}};
  const auto facts = factsOf(health);
  EXPECT_EQ(fact(facts, "clock").value,
            "drift 12.3 ppm, delays vary by 41.0 ms, 1 restart, error 0.00 ms (at most 0.00)");
  EXPECT_TRUE(fact(facts, "clock of wrist").value.startsWith("drift not known yet"));
}

TEST(LinkPanel, WarnsOfWhatIsWrong) {
  LinkHealth health = goodHealth();
  health.device.tactile.state = PortState::kLost;
  health.device.motion = PortStatus{};
  health.frames.ageMs = 2300.0;
  health.lost = 3;
  health.badChecksums = 1;
  health.device.tactile.reconnects = 2;
  health.diskHours = 0.5;
  const auto facts = factsOf(health);
  EXPECT_TRUE(fact(facts, "tactile").warning);
  EXPECT_TRUE(fact(facts, "motion").warning);
  EXPECT_EQ(fact(facts, "frame age").value, "2.3 s");
  for (const char* name : {"frame age", "lost", "bad checksums", "reconnects"})
    EXPECT_TRUE(fact(facts, name).warning) << name;
  EXPECT_EQ(fact(facts, "disk").value, "118.0 GB free, 30 minutes");
  health.frames.ageMs.reset();
  EXPECT_EQ(fact(factsOf(health), "frame age").value, "no frame yet");
}

TEST(LinkPanel, OneLineBeforeARun) {
  applyTheme(*qApp, Theme::kDark);
  LinkPanel panel;
  const auto* line = panel.findChild<QLabel*>("preflight");
  EXPECT_TRUE(line->text().contains("Ctrl+K"));
  PreflightCheck check;
  check.ready = true;
  check.text = "ready: 31.7 frames/s";
  panel.showHealth(goodHealth(), check);
  EXPECT_EQ(line->text(), "ready: 31.7 frames/s");
  EXPECT_TRUE(line->styleSheet().contains(colorsOf(Theme::kDark).accent.name()));
  // Blind matrices don't hinder a recording, but whoever grasps must know.
  panel.setUnmeasurable({"", "0 distal can't measure it: no taxel of it is scanned"});
  EXPECT_EQ(line->text(), "ready: 31.7 frames/s; 1 matrix can't measure the limit of a grasp");
  EXPECT_TRUE(line->styleSheet().contains(colorsOf(Theme::kDark).warning.name()));
  panel.setUnmeasurable({"a", "b"});
  EXPECT_TRUE(line->text().contains("; 2 matrices can't"));
  panel.setUnmeasurable({});
  EXPECT_EQ(line->text(), "ready: 31.7 frames/s");
  check.doubtful = true;
  panel.showHealth(goodHealth(), check);
  EXPECT_TRUE(line->styleSheet().contains(colorsOf(Theme::kDark).warning.name()));
  check.ready = check.doubtful = false;
  panel.showHealth(goodHealth(), check);
  EXPECT_TRUE(line->styleSheet().contains(colorsOf(Theme::kDark).danger.name()));
  panel.clear();
  EXPECT_TRUE(line->text().contains("Ctrl+K"));
}

TEST(LinkPanel, LogsWhatHappenedAndListsAlarms) {
  LinkPanel panel;
  panel.addEvent({1, 1, "link", {}, "tactile port\nconnected", ""});
  panel.log("recording begins");
  const QString log = panel.findChild<QPlainTextEdit*>("linkLog")->toPlainText();
  EXPECT_TRUE(log.contains("link: tactile port connected"));
  ASSERT_EQ(log.split('\n').size(), 2);
  EXPECT_TRUE(log.split('\n')[0].contains("recording begins")) << "the newest line comes first";
  const auto* alarms = panel.findChild<QLabel*>("linkAlarms");
  EXPECT_EQ(alarms->text(), "none");
  panel.showAlarms({"no frame for 2 s", "disk full"});
  EXPECT_EQ(alarms->text(), "no frame for 2 s\ndisk full");
  applyTheme(*qApp, Theme::kLight);
  EXPECT_EQ(alarms->text(), "no frame for 2 s\ndisk full");
}

TEST(LinkPanel, SoundCanBeSwitchedOff) {
  LinkPanel panel;
  QSignalSpy muted(&panel, &LinkPanel::mutedChanged);
  panel.findChild<QCheckBox*>("alarmSound")->click();
  ASSERT_EQ(muted.size(), 1);
  EXPECT_TRUE(muted[0][0].toBool());
}

TEST(LinkPanel, ASensorHasItsStateAndWhatCantBeRead) {
  SeriesSource sensor({.name = "wrist", .source = "udp:0.0.0.0:0"});
  const std::vector<Fact> facts = factsOf(sensor);
  EXPECT_EQ(fact(facts, "wrist").value, "closed · udp:0.0.0.0:0");
  EXPECT_TRUE(fact(facts, "wrist").warning);
  EXPECT_EQ(facts.back().name, "wrist: senders") << "any machine can send";
  std::vector<Fact> all = factsOf(goodHealth());
  EXPECT_TRUE(std::ranges::none_of(all, [](const Fact& each) { return each.name == "wrist"; }));
}

}  // namespace
}  // namespace palpate::gui::link_panel_test
