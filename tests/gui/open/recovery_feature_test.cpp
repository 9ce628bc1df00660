// A damaged recording opens as far as it can be read, says so, and is recovered from the window.
#include "gui/open/recovery_feature.h"

#include <QPushButton>
#include <QToolButton>

#include <palpate/emulator/synthetic_profile.h>
#include <palpate/recording/palpate_writer.h>
#include <palpate/recording/recording.h>

#include "gui/testing/window_fixture.h"
#include "gui/widgets/offer_strip.h"
#include "recording/palpate_samples.h"

namespace palpate::gui::recovery_feature_test {
namespace {
namespace fs = std::filesystem;

class RecoveryFeatureTest : public WindowTest {
 protected:
  RecoveryFeatureTest() { environment_.read = {}; }
  // A recording of 24 s in which the values of a block are changed; its frames.
  std::size_t writeDamaged(const fs::path& path) {
    const Profile profile = synthesize({.durationS = 24.0, .grasps = 4, .noiseCounts = 3.0});
    writePalpate(profile, {}, path);
    const std::string sound = testing::readFile(path);
    // Blocks of frames and of joint angles lie in turn: the first place that costs frames.
    for (std::size_t percent = 50; percent < 95; ++percent) {
      std::string bytes = sound;
      const std::size_t at = bytes.size() * percent / 100;
      for (std::size_t i = at; i < at + 20; ++i) bytes[i] ^= 0x5a;
      testing::writeFile(path, bytes);
      if (verifyRecording(path).message.find("lost frame") != std::string::npos) break;
    }
    return profile.numFrames();
  }
  QString offered() {
    const auto* accept = find<QPushButton>("recoverAccept");
    if (!accept->isVisible()) return {};
    return static_cast<const OfferStrip*>(accept->parentWidget())->text();
  }
  OpenedRecordingPtr displayed() { return window().state().displayed.recorded(); }
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 20'000);
  }
};

TEST_F(RecoveryFeatureTest, ADamagedRecordingIsShownAsFarAsItCanBeRead) {
  const std::size_t all = writeDamaged(folder_ / "run.palpate");
  open({"run.palpate"});
  ASSERT_TRUE(displayed());
  EXPECT_LT(displayed()->profile.numFrames(), all);
  EXPECT_GT(displayed()->profile.numFrames(), all / 2);
  EXPECT_EQ(bannerText(), "");
  EXPECT_TRUE(offered().startsWith("run.palpate is damaged; only its readable part is shown. "))
      << offered().toStdString();
  EXPECT_TRUE(offered().contains("lost frame")) << offered().toStdString();
  EXPECT_FALSE(offered().contains("palpate recover"));
  // The span without frames is a gap, however short.
  ASSERT_EQ(displayed()->timing.gaps.size(), 1u);
  const std::size_t lost = all - displayed()->profile.numFrames();
  EXPECT_NEAR(displayed()->timing.gaps[0].seconds, static_cast<double>(lost + 1) / 31.7, 0.05);
}

TEST_F(RecoveryFeatureTest, RecoversIntoANewFileAndOpensIt) {
  const fs::path path = folder_ / "run.palpate";
  writeDamaged(path);
  const std::string before = testing::readFile(path);
  open({"run.palpate"});
  const QString proposed = pathText(folder_ / "run_recovered.palpate");
  ask_.newFiles = {proposed};
  QTest::mouseClick(find<QPushButton>("recoverAccept"), Qt::LeftButton);
  EXPECT_EQ(ask_.newFiles.began, QStringList(proposed));
  ASSERT_TRUE(await([&] { return displayed() && displayed()->path.filename() != "run.palpate"; }));
  EXPECT_EQ(displayed()->path.filename(), "run_recovered.palpate");
  EXPECT_EQ(displayed()->damage, "");
  EXPECT_EQ(offered(), "");
  EXPECT_EQ(testing::readFile(path), before);
  EXPECT_EQ(verifyRecording(proposed.toStdString()).state, VerifyReport::State::kSound);
}

// What was found to be lost is among the events that are shown, but not in the file.
TEST_F(RecoveryFeatureTest, LabelsOfADamagedRecordingAreSavedAndRecovered) {
  const fs::path path = folder_ / "run.palpate";
  writeDamaged(path);
  open({"run.palpate"});
  ASSERT_EQ(displayed()->notInFile.size(), 1u);
  const std::int64_t us = displayed()->profile.frameTimeUs(20);
  const auto label = [&](const char* text) {
    window().state().events.add(
        {.tUs = us, .t1Us = us, .kind = "label", .matrix = {}, .text = text, .json = {}}, "label");
  };
  const auto labelsOf = [](const fs::path& file) {
    std::vector<std::string> texts;
    for (const Event& event : readEvents(file).events)
      if (event.kind == "label") texts.push_back(event.text);
    return texts;
  };
  label("first");
  press(Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(bannerText(), "");
  EXPECT_FALSE(window().state().events.editor()->unsaved());
  EXPECT_EQ(labelsOf(path), std::vector<std::string>{"first"});
  label("second");
  const QString proposed = pathText(folder_ / "run_recovered.palpate");
  ask_.newFiles = {proposed};
  QTest::mouseClick(find<QPushButton>("recoverAccept"), Qt::LeftButton);
  ASSERT_TRUE(await([&] { return displayed() && displayed()->path.filename() != "run.palpate"; }));
  EXPECT_EQ(labelsOf(folder_ / "run_recovered.palpate"),
            (std::vector<std::string>{"first", "second"}));
}

TEST_F(RecoveryFeatureTest, ACutDsaOpensWithItsReadableFrames) {
  saveRecording(
      synthesize({.durationS = 60.0, .grasps = 8, .noiseCounts = 30.0}), {}, folder_ / "whole.dsa");
  const std::string bytes = testing::readFile(folder_ / "whole.dsa");
  testing::writeFile(folder_ / "cut.dsa", bytes.substr(0, bytes.size() * 3 / 4));
  open({"cut.dsa"});
  ASSERT_TRUE(displayed()) << bannerText().toStdString();
  EXPECT_GT(displayed()->profile.numFrames(), 300u);
  EXPECT_TRUE(offered().contains("Readable: ")) << offered().toStdString();
}

TEST_F(RecoveryFeatureTest, AnUnfinishedRecordingSaysSo) {
  testing::writeSamples(folder_ / "run.palpate", 70, false);
  open({"run.palpate"});
  ASSERT_TRUE(displayed());
  EXPECT_TRUE(offered().contains("was never finished")) << offered().toStdString();
}

TEST_F(RecoveryFeatureTest, ClosedItIsNotOfferedAgainAndASoundOneNever) {
  writeDamaged(folder_ / "run.palpate");
  writePalpate(synthesize({.durationS = 4.0, .grasps = 1}), {}, folder_ / "sound.palpate");
  open({"run.palpate", "sound.palpate"});
  EXPECT_NE(offered(), "");
  actions().at("nextRecording")->trigger();
  EXPECT_EQ(offered(), "");
  actions().at("nextRecording")->trigger();
  EXPECT_NE(offered(), "");
  QTest::mouseClick(find<QToolButton>("recoverClose"), Qt::LeftButton);
  actions().at("nextRecording")->trigger();
  actions().at("nextRecording")->trigger();
  EXPECT_EQ(offered(), "");
}

TEST_F(RecoveryFeatureTest, WithoutADamagedOneTheActionAsksForAFile) {
  writeDamaged(folder_ / "bad.palpate");
  ask_.files = {pathText(folder_ / "bad.palpate")};
  ask_.newFiles = {pathText(folder_ / "bad_recovered.palpate")};
  actions().at("recover")->trigger();
  ASSERT_TRUE(await([&] { return displayed() != nullptr; }));
  EXPECT_EQ(displayed()->path.filename(), "bad_recovered.palpate");
}

TEST_F(RecoveryFeatureTest, NothingReadableIsSaidInTheWordsOfTheWindow) {
  testing::writeFile(folder_ / "text.palpate", "no recording at all");
  open({"text.palpate"});
  EXPECT_FALSE(displayed());
  EXPECT_NE(bannerText(), "");
  EXPECT_FALSE(bannerText().contains("palpate recover")) << bannerText().toStdString();
}

}  // namespace
}  // namespace palpate::gui::recovery_feature_test
