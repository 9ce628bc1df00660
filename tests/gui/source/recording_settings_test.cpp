#include "gui/source/recording_settings.h"

#include <QDir>
#include <QFile>

#include <sys/stat.h>
#include <unistd.h>

#include <palpate/core/error.h>

#include "testing/testing.h"

namespace palpate::gui::recording_settings_test {
namespace {
namespace fs = std::filesystem;

// 2014-11-27 12:00 UTC: the same day wherever the machine stands (but for UTC+12 and more).
constexpr std::int64_t kNoonUs = 1'417'089'600'000'000;

std::string messageOf(const RecordingSettings& settings) {
  try {
    nextPath(settings, kNoonUs);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

class RecordingSettingsTest : public ::testing::Test {
 protected:
  RecordingSettingsTest() {
    settings_.folder = QString::fromStdString(folder_.path().string());
    settings_.object = "foam ball";
  }
  QString file() const { return QString::fromStdString((folder_ / "palpate.ini").string()); }

  const testing::TemporaryFolder folder_;
  RecordingSettings settings_;
};

TEST_F(RecordingSettingsTest, WhatWasSavedComesBack) {
  settings_.nameTemplate = "{object}-{run}";
  settings_.operatorName = "Zo\u00eb, \"the\" operator";
  settings_.notes = "two\nlines; 22 \u00b0C = warm";
  settings_.askEachTime = false;
  settings_.withMcap = true;
  settings_.countdownS = 7;
  settings_.startOnContact = true;
  settings_.stopWithoutContactS = 2.5;
  settings_.contactThreshold = 300.0;
  settings_.limits = {.stopAfterS = 12.5, .splitMinutes = 0.5, .splitMb = 200.0};
  settings_.markLabels[0] = "zero";
  settings_.markLabels[7] = "";  // taken away on purpose: no default comes back
  {
    QSettings store(file(), QSettings::IniFormat);
    saveRecordingSettings(settings_, store);
  }
  const RecordingSettings loaded = loadRecordingSettings(QSettings(file(), QSettings::IniFormat));
  EXPECT_EQ(loaded.folder, settings_.folder);
  EXPECT_EQ(loaded.nameTemplate, "{object}-{run}");
  EXPECT_EQ(loaded.operatorName, settings_.operatorName);
  EXPECT_EQ(loaded.object, "foam ball");
  EXPECT_EQ(loaded.notes, settings_.notes);
  EXPECT_FALSE(loaded.askEachTime);
  EXPECT_TRUE(loaded.withMcap);
  EXPECT_EQ(loaded.limits, settings_.limits);
  const RecordingOptions options = recordingOptions(loaded, folder_ / "a.palpate");
  EXPECT_EQ(options.stopAfterS, 12.5);
  EXPECT_EQ(options.splitS, 30.0);
  EXPECT_EQ(loaded.countdownS, 7);
  EXPECT_TRUE(options.startOnContact);
  EXPECT_EQ(options.stopWithoutContactS, 2.5);
  EXPECT_EQ(options.contact.threshold, 300.0);
  EXPECT_EQ(options.splitBytes, 200'000'000);
  EXPECT_TRUE(recordingOptions(loaded, folder_ / "a.palpate").mcap);
  EXPECT_EQ(loaded.markLabels, settings_.markLabels);
}

TEST_F(RecordingSettingsTest, TheFirstDayHasSensibleOnesAndMakesNoFolder) {
  const RecordingSettings first = loadRecordingSettings(QSettings(file(), QSettings::IniFormat));
  EXPECT_TRUE(QDir::isAbsolutePath(first.folder)) << first.folder.toStdString();
  EXPECT_EQ(QDir(first.folder).dirName(), "Palpate recordings");
  EXPECT_EQ(first.nameTemplate, "{date}_{object}_{run}");
  EXPECT_TRUE(first.askEachTime);
  EXPECT_EQ(first.limits, RecordingLimits());
  EXPECT_EQ(first.markLabels[1], "contact");
  EXPECT_EQ(first.markLabels[2], "slip");
  EXPECT_EQ(first.markLabels[3], "release");
}

TEST_F(RecordingSettingsTest, WhatMakesNoSenseInTheFileIsReplaced) {
  QSettings store(file(), QSettings::IniFormat);
  store.setValue("recording/folder", "not/a/whole/path");
  store.setValue("recording/template", "  ");
  store.setValue("recording/stop_after_s", -3.0);
  store.setValue("recording/split_min", "soon");
  store.setValue("recording/countdown_s", 1000);
  store.setValue("recording/stop_without_contact_s", 0.0);
  store.setValue("recording/contact_threshold", "much");
  store.setValue("recording/split_mb", 1e12);
  store.setValue("recording/label1", QString(500, 'x') + "\n\t y");
  const RecordingSettings odd = loadRecordingSettings(store);
  EXPECT_EQ(odd.folder, defaultRecordingsFolder());
  EXPECT_EQ(odd.nameTemplate, "{date}_{object}_{run}");
  EXPECT_EQ(odd.limits, RecordingLimits());
  EXPECT_EQ(odd.countdownS, 0);
  EXPECT_FALSE(odd.stopWithoutContactS);
  EXPECT_EQ(odd.contactThreshold, 0.0);
  EXPECT_EQ(odd.markLabels[1], QString(60, 'x'));
}

TEST_F(RecordingSettingsTest, ATypedFolderBecomesAWholePath) {
  EXPECT_EQ(folderFromText("~"), QDir::homePath());
  EXPECT_EQ(folderFromText(" ~/runs/ "), QDir::homePath() + "/runs");
  EXPECT_EQ(folderFromText("/data//runs/../hand/"), "/data/hand");
  EXPECT_EQ(folderFromText("  "), "");
}

TEST_F(RecordingSettingsTest, TheNextPathCountsOn) {
  EXPECT_EQ(nextPath(settings_, kNoonUs), folder_ / "2014-11-27_foam_ball_001.palpate");
  testing::writeFile(folder_ / "2014-11-27_foam_ball_006.palpate", "");
  EXPECT_EQ(nextPath(settings_, kNoonUs), folder_ / "2014-11-27_foam_ball_007.palpate");
  EXPECT_EQ(previewNextPath(settings_, kNoonUs).path, folder_ / "2014-11-27_foam_ball_007.palpate");
}

TEST_F(RecordingSettingsTest, TheFolderIsMadeOnlyWhenItIsNeeded) {
  settings_.folder += "/of the day/hand 1";
  const NextRecording next = previewNextPath(settings_, kNoonUs);
  EXPECT_TRUE(next.folderWillBeMade);
  EXPECT_EQ(next.path, folder_ / "of the day/hand 1/2014-11-27_foam_ball_001.palpate");
  EXPECT_EQ(next.problem, "");
  EXPECT_FALSE(fs::exists(folder_ / "of the day"));
  EXPECT_EQ(nextPath(settings_, kNoonUs), next.path);
  EXPECT_TRUE(fs::is_directory(folder_ / "of the day/hand 1"));
  EXPECT_FALSE(previewNextPath(settings_, kNoonUs).folderWillBeMade);
}

TEST_F(RecordingSettingsTest, ATemplateThatMakesNoSenseIsSaidAndMakesNothing) {
  settings_.folder += "/new";
  settings_.nameTemplate = "{date}_{objekt}";
  EXPECT_NE(messageOf(settings_).find("{objekt} isn't known; use {date}"), std::string::npos)
      << messageOf(settings_);
  EXPECT_EQ(messageOf(settings_).find("RecordingName"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "new"));
  const NextRecording next = previewNextPath(settings_, kNoonUs);
  EXPECT_EQ(next.problem.toStdString(), messageOf(settings_));
  EXPECT_TRUE(next.path.empty());
}

TEST_F(RecordingSettingsTest, AFolderThatCantBeUsedIsSaid) {
  const auto refused = [this](const std::string& folder, const char* because) {
    settings_.folder = QString::fromStdString(folder);
    const std::string said = messageOf(settings_);
    EXPECT_NE(said.find(because), std::string::npos) << folder << ": " << said;
    EXPECT_EQ(previewNextPath(settings_, kNoonUs).problem.toStdString(), said);
  };
  refused("", "choose a folder");
  refused("runs", "isn't an absolute path");
  testing::writeFile(folder_ / "a file", "");
  refused((folder_ / "a file").string(), "is a file, not a folder");
  refused((folder_ / "a file/below").string(), "is a file, not a folder");
}

TEST_F(RecordingSettingsTest, AFolderThatCantBeMadeIsSaid) {
  fs::create_symlink(folder_ / "nowhere/at/all", folder_ / "dangling");
  for (const std::string& folder :
       {(folder_ / "dangling").string(), std::string("/proc/palpate")}) {
    settings_.folder = QString::fromStdString(folder);
    EXPECT_NE(messageOf(settings_).find("choose another folder"), std::string::npos)
        << messageOf(settings_);
  }
  EXPECT_FALSE(fs::exists(folder_ / "nowhere"));
}

TEST_F(RecordingSettingsTest, AFolderThatMayNotBeWrittenIsSaid) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  ASSERT_EQ(::chmod(folder_.path().c_str(), 0555), 0);
  EXPECT_NE(messageOf(settings_).find("no permission to write there"), std::string::npos);
  settings_.folder += "/new";
  EXPECT_NE(messageOf(settings_).find("no permission to write there"), std::string::npos);
  ASSERT_EQ(::chmod(folder_.path().c_str(), 0755), 0);
}

}  // namespace
}  // namespace palpate::gui::recording_settings_test
