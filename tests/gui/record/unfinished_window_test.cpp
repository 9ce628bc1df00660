// What an earlier day left unfinished is offered when the window opens.
#include <QPushButton>
#include <QToolButton>

#include <palpate/recording/recording.h>

#include "gui/record/record_feature.h"
#include "gui/source/recording_settings.h"
#include "gui/testing/window_fixture.h"
#include "gui/widgets/offer_strip.h"
#include "recording/palpate_samples.h"

namespace palpate::gui::unfinished_window_test {
namespace {
namespace fs = std::filesystem;

class UnfinishedWindowTest : public WindowTest {
 protected:
  UnfinishedWindowTest() {
    QSettings settings(settingsFile(), QSettings::IniFormat);
    RecordingSettings recording;
    recording.folder = QString::fromStdString((folder_ / "runs").string());
    saveRecordingSettings(recording, settings);
    fs::create_directories(folder_ / "runs");
  }
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 20'000);
  }
  // Waits for the answer: how many there are.
  qsizetype look() {
    QSignalSpy found(&window().feature<RecordFeature>().unfinished(), &RecoveryFinder::found);
    window().feature<RecordFeature>().offerUnfinished();
    return found.wait(20'000) ? found[0][0].toStringList().size() : -1;
  }
  QString offered() {
    const auto* strip = window().findChild<OfferStrip*>();
    return strip->isVisible() ? strip->text() : QString();
  }
};

TEST_F(UnfinishedWindowTest, IsRecoveredIntoANewFileAndOpened) {
  const fs::path lost = folder_ / "runs/good_run.palpate";
  testing::writeSamples(lost, 70, false);
  const std::string before = testing::readFile(lost);
  start();
  window().feature<RecordFeature>().offerUnfinished();
  ASSERT_TRUE(await([&] { return offered().contains("good_run.palpate"); }));
  EXPECT_TRUE(offered().contains("never finished"));
  QTest::mouseClick(find<QPushButton>("offerAccept"), Qt::LeftButton);
  ASSERT_TRUE(await([&] { return offered().contains("good_run_recovered.palpate"); }));
  EXPECT_EQ(testing::readFile(lost), before) << "what was there stays as it was";
  EXPECT_EQ(verifyRecording(folder_ / "runs/good_run_recovered.palpate").state,
            VerifyReport::State::kSound);
  QTest::mouseClick(find<QPushButton>("offerAccept"), Qt::LeftButton);
  EXPECT_TRUE(await([&] { return reads_ > 0; }));
}

TEST_F(UnfinishedWindowTest, ClosedItIsNotOfferedAgain) {
  testing::writeSamples(folder_ / "runs/run.palpate", 70, false);
  start();
  window().feature<RecordFeature>().offerUnfinished();
  ASSERT_TRUE(await([&] { return offered().contains("run.palpate"); }));
  QTest::mouseClick(find<QToolButton>("offerClose"), Qt::LeftButton);
  EXPECT_EQ(window().state().messages.flashed(),
            "This will not be offered again; later, use File > Recover… to finish it");
  start();
  EXPECT_EQ(look(), 0);
  EXPECT_EQ(offered(), "");
}

TEST_F(UnfinishedWindowTest, NothingUnfinishedNothingSaid) {
  start();
  EXPECT_EQ(look(), 0);
  EXPECT_EQ(offered(), "");
  EXPECT_EQ(bannerText(), "");
}

}  // namespace
}  // namespace palpate::gui::unfinished_window_test
