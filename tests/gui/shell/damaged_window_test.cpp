// A long recording with a damaged block in the real window: everything outside of the block works,
// and what is lost is said and counted.
#include <QClipboard>
#include <QLabel>
#include <QPushButton>

#include "gui/compare/compare_feature.h"
#include "gui/compare/compare_panel.h"
#include "gui/compare/compare_view.h"
#include "gui/export/export_controller.h"
#include "gui/export/export_feature.h"
#include "gui/shell/run_window.h"
#include "gui/slip/slip_panel.h"
#include "gui/testing/window_fixture.h"
#include "gui/timeline/timeline_chart.h"
#include "gui/widgets/facts_view.h"
#include "gui/widgets/offer_strip.h"
#include "recording/long_samples.h"

namespace palpate::gui::damaged_window_test {
namespace {

constexpr std::size_t kFrames = OpenedRecording::kLongFrom + 1'000;

class DamagedWindowTest : public WindowTest {
 protected:
  DamagedWindowTest() { environment_.read = {}; }
  // Shows the recording with damage behind this share of its file, once all of it has been read.
  void showDamaged(double share) {
    const std::filesystem::path path = folder_ / "long.palpate";
    testing::writeLong(path, kFrames, false);
    lost_ = testing::damageBlock(path, share);
    open({"long.palpate"});
    ASSERT_TRUE(displayed() && displayed()->isLong());
    ASSERT_TRUE(await([&] { return displayed()->overview->complete(); }));
    ASSERT_TRUE(await([&] { return !find<QLabel>("readingWords")->isVisible(); }));
  }
  OpenedRecordingPtr displayed() { return window().state().displayed.recorded(); }
  static bool await(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 20'000);
  }
  std::size_t numLost() const { return lost_.last - lost_.first + 1; }
  QString countText() const { return QString::number(numLost()) + " frames can't be read"; }
  float shown() { return window().state().currentFrame.frame().values.at(0); }
  QString notice() { return window().state().currentFrame.old().notice; }
  QString offered() {
    const auto* accept = find<QPushButton>("recoverAccept");
    return accept->isVisible() ? static_cast<const OfferStrip*>(accept->parentWidget())->text()
                               : QString();
  }
  QString fact(const char* name) {
    for (const Fact& each : find<FactsView>("recordingFacts")->facts())
      if (each.name == name) return each.value;
    return "no such fact";
  }
  testing::TemporaryFolder files_;
  UnreadableSamples::Run lost_;
};

class DamagedWindowAt : public DamagedWindowTest, public ::testing::WithParamInterface<double> {};

TEST_P(DamagedWindowAt, EveryOtherFrameIsShownAndTheLostOnesAreCounted) {
  showDamaged(GetParam());
  EXPECT_TRUE(offered().contains(countText())) << offered().toStdString();
  EXPECT_EQ(fact("unreadable frames"), QString::number(numLost()));
  EXPECT_EQ(fact("largest value"), "1000 counts");
  EXPECT_EQ(fact("saturated frames"), "0");
  EXPECT_EQ(bannerText(), "");
  for (const std::size_t frame : {std::size_t{5},
                                  kFrames / 2 + 2'000,
                                  kFrames - 2'000,
                                  lost_.first > 0 ? lost_.first - 1 : lost_.last + 1,
                                  lost_.last + 1 < kFrames ? lost_.last + 1 : lost_.first - 1}) {
    playback().seekFrame(frame);
    EXPECT_EQ(playback().frame(), frame);
    if (frame >= lost_.first && frame <= lost_.last) continue;
    EXPECT_EQ(shown(), testing::longValue(frame)) << frame;
    EXPECT_EQ(notice(), "") << frame;
  }
  playback().seekFrame((lost_.first + lost_.last) / 2);
  EXPECT_TRUE(notice().contains("damaged")) << notice().toStdString();
  QCoreApplication::processEvents();
}

INSTANTIATE_TEST_SUITE_P(Damage, DamagedWindowAt, ::testing::Values(0.0, 0.5, 0.97));

TEST_F(DamagedWindowTest, PlayingOverTheDamageGoesOn) {
  showDamaged(0.5);
  playback().seekFrame(lost_.first - 3);
  QSignalSpy notices(&window().state().currentFrame, &CurrentFrame::staleNoticeChanged);
  playback().play();
  while (playback().frame() < lost_.last + 3) {
    clock_.advanceMs(10);
    playback().tick();
    ASSERT_TRUE(playback().playing());
    QCoreApplication::processEvents();
  }
  EXPECT_EQ(shown(), testing::longValue(playback().frame()));
  EXPECT_EQ(notices.size(), 2) << "one when the damage begins, one when it ends";
  EXPECT_EQ(bannerText(), "");
}

TEST_F(DamagedWindowTest, IsComparedOutsideOfTheDamage) {
  showDamaged(0.5);
  std::filesystem::copy_file(folder_ / "long.palpate", folder_ / "other.palpate");
  open({"other.palpate"});
  press(Qt::Key_C, Qt::ControlModifier | Qt::ShiftModifier);
  ComparePanel& compare = window().feature<CompareFeature>().panel();
  ASSERT_TRUE(await([&] { return compare.hasPair() && compare.complete(); }));
  EXPECT_TRUE(compare.notice().contains("A is damaged: " + countText()))
      << compare.notice().toStdString();
  EXPECT_TRUE(compare.notice().contains("B is damaged: " + countText()));
  const auto& frames = compare.view().frames();
  playback().seekFrame(lost_.last + 20);
  ASSERT_FALSE(frames[0].frame.values.empty());
  EXPECT_EQ(frames[0].frame.values[0], testing::longValue(lost_.last + 20));
  EXPECT_EQ(frames[0].notice, "");
  playback().seekFrame(lost_.last - 20);
  EXPECT_TRUE(frames[0].frame.values.empty()) << "nothing old is shown";
  EXPECT_TRUE(frames[0].notice.contains("damaged")) << frames[0].notice.toStdString();
  playback().seekFrame(lost_.first - 20);
  EXPECT_EQ(frames[0].frame.values[0], testing::longValue(lost_.first - 20));
}

TEST_F(DamagedWindowTest, SlipIsComputedOutsideOfTheDamage) {
  showDamaged(0.5);
  press(Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier);
  auto* panel = find<SlipPanel>("SlipPanel");
  panel->settle();
  QCoreApplication::processEvents();
  ASSERT_TRUE(panel->found());
  EXPECT_EQ(panel->found()->timeS.size(), kFrames);
  EXPECT_EQ(panel->found()->unreadable.count, numLost());
  EXPECT_TRUE(find<QLabel>("slipNotes")->text().contains(countText()))
      << find<QLabel>("slipNotes")->text().toStdString();
}

TEST_F(DamagedWindowTest, ATableThatNeedsDamagedFramesIsNotCopied) {
  showDamaged(0.0);
  QApplication::clipboard()->setText("before");
  auto* chart = window().findChild<TimelineChart*>();
  // Until a frame that can be read is shown there is nothing to be copied.
  QTest::mouseClick(chart, Qt::LeftButton, {}, chart->rect().center());
  QTest::mouseClick(chart, Qt::LeftButton, {}, chart->rect().center());
  window().feature<ExportFeature>().exportController().copyTable();
  window().feature<ExportFeature>().exportController().settle();
  EXPECT_TRUE(bannerText().contains("damaged")) << bannerText().toStdString();
  EXPECT_EQ(QApplication::clipboard()->text().left(300).toStdString(), "before");
}

TEST_F(DamagedWindowTest, APictureOfTheWindowIsMade) {
  testing::writeLong(files_ / "long.palpate", kFrames, false);
  lost_ = testing::damageBlock(files_ / "long.palpate", 0.5);
  window_.reset();
  for (const std::size_t frame : {std::size_t{5}, lost_.first}) {
    ScreenshotOptions options;
    options.out = files_ / ("w" + std::to_string(frame) + ".png");
    options.size = QSize(1280, 800);
    options.dataFolder = files_.path();
    options.file = files_ / "long.palpate";
    options.frame = frame;
    std::string program = "palpate";
    char* arguments[] = {program.data(), nullptr};
    int count = 1;
    EXPECT_EQ(takeScreenshot(count, arguments, options), 0);
    EXPECT_TRUE(std::filesystem::exists(options.out));
  }
}

}  // namespace
}  // namespace palpate::gui::damaged_window_test
