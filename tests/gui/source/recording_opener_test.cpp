#include "gui/source/recording_opener.h"

#include <QSignalSpy>
#include <latch>
#include <memory>
#include <new>

#include <gtest/gtest.h>

#include <palpate/core/error.h>
#include <palpate/emulator/synthetic_profile.h>

#include "gui/testing/sample_profiles.h"
#include "testing/testing.h"

namespace palpate::gui::recording_opener_test {
namespace {

constexpr int kPatienceMs = 10'000;

struct Heard {
  explicit Heard(RecordingOpener& opener)
      : opened(&opener, &RecordingOpener::opened),
        failed(&opener, &RecordingOpener::failed),
        cancelled(&opener, &RecordingOpener::cancelled),
        progressed(&opener, &RecordingOpener::progressed),
        finished(&opener, &RecordingOpener::finished) {}
  QSignalSpy opened, failed, cancelled, progressed, finished;
};

TEST(RecordingOpener, DeliversTheRecordingWithItsSignals) {
  RecordingOpener opener([](const auto&, const Progress& progress) {
    progress(0.5);
    return Recording{twentyFrames()};
  });
  Heard heard(opener);
  opener.open("a.dsa");
  EXPECT_TRUE(opener.busy());
  ASSERT_TRUE(heard.finished.wait(kPatienceMs));
  EXPECT_FALSE(opener.busy());
  ASSERT_EQ(heard.opened.size(), 1);
  const auto recording = heard.opened[0][0].value<OpenedRecordingPtr>();
  EXPECT_EQ(recording->path, "a.dsa");
  ASSERT_EQ(recording->whole.size(), 20u);
  // Frame i holds one taxel of 10 * (i + 1) counts in matrix 1.
  EXPECT_EQ(recording->whole[4].maximum, 50.0);
  EXPECT_EQ(recording->at(4, 1).sum, 50.0);
  EXPECT_EQ(recording->at(4, 6).sum, 50.0) << "the whole hand";
  EXPECT_EQ(recording->maximum, 200.0);
  EXPECT_EQ(recording->saturatedFrames, 0u);
  EXPECT_EQ(recording->touched, (std::vector<bool>{false, true, false, false, false, false}));
  EXPECT_NEAR(recording->timeS[19], 0.95, 1e-9);
  EXPECT_GT(heard.progressed.size(), 0);
  for (const auto& step : heard.progressed) {
    EXPECT_GE(step[0].toDouble(), 0.0);
    EXPECT_LE(step[0].toDouble(), 1.0);
  }
}

TEST(RecordingOpener, TellsWhatIsWrongAndGoesOnWithTheNext) {
  RecordingOpener opener([](const std::filesystem::path& path, const Progress&) {
    if (path == "bad.dsa") throw FormatError(path, "cut short", 12);
    if (path == "big.dsa") throw std::bad_alloc();
    return Recording{twentyFrames()};
  });
  Heard heard(opener);
  for (const char* name : {"bad.dsa", "big.dsa", "good.dsa"}) opener.open(name);
  ASSERT_TRUE(heard.finished.wait(kPatienceMs));
  ASSERT_EQ(heard.failed.size(), 2);
  EXPECT_EQ(heard.failed[0][1].toString(), "bad.dsa: cut short (at byte 12)");
  EXPECT_TRUE(heard.failed[1][1].toString().contains("memory"));
  EXPECT_EQ(heard.opened.size(), 1);
}

Recording endless(const std::filesystem::path&, const Progress& progress) {
  while (progress(0.3)) {
  }
  throw Cancelled();
}

TEST(RecordingOpener, CancelGivesUpWhatIsInWorkAndWhatWaits) {
  RecordingOpener opener(&endless);
  Heard heard(opener);
  for (const char* name : {"a.dsa", "b.dsa", "c.dsa"}) opener.open(name);
  EXPECT_EQ(opener.numWaiting(), 2u);
  opener.cancel();
  ASSERT_TRUE(heard.finished.wait(kPatienceMs));
  EXPECT_EQ(heard.cancelled.size(), 1);
  EXPECT_EQ(heard.opened.size(), 0);
  EXPECT_EQ(heard.failed.size(), 0);
  // It can be used again.
  opener.open("d.dsa");
  EXPECT_TRUE(opener.busy());
  opener.cancel();
  ASSERT_TRUE(heard.finished.wait(kPatienceMs));
  EXPECT_EQ(heard.cancelled.size(), 2);
}

TEST(RecordingOpener, CanBeDestroyedWhileItWorks) {
  for (int i = 0; i < 20; ++i) {
    RecordingOpener opener(&endless);
    opener.open("a.dsa");
  }
}

// Window F7.
TEST(RecordingOpener, LeavingDoesNotWaitForAFileThatDoesNotAnswer) {
  const auto end = std::make_shared<std::latch>(1);
  {
    RecordingOpener opener([end](const auto&, const Progress&) {
      end->wait();
      return Recording{twentyFrames()};
    });
    opener.open("a.dsa");
  }
  EXPECT_FALSE(Abandonable::awaitThreads(std::chrono::milliseconds(1))) << "it still hangs";
  end->count_down();
  EXPECT_TRUE(Abandonable::awaitThreads(std::chrono::milliseconds(kPatienceMs)));
}

TEST(RecordingOpener, CancelReachesTheComputationOfSignals) {
  const Profile profile = synthesize({.durationS = 20.0});
  EXPECT_THROW(makeOpenedRecording("a", profile, [](double) { return false; }), Cancelled);
  EXPECT_THROW(makeOpenedRecording("a", profile, [](double done) { return done < 0.6; }),
               Cancelled);
}

TEST(RecordingOpener, ReadsARealFile) {
  const auto recordings = testing::recordingsFolder();
  PALPATE_NEED(recordings);
  RecordingOpener opener;
  Heard heard(opener);
  opener.open(*recordings / "slip-detection/slip_test.dsa");
  ASSERT_TRUE(heard.finished.wait(60'000));
  ASSERT_EQ(heard.opened.size(), 1);
  const auto recording = heard.opened[0][0].value<OpenedRecordingPtr>();
  // Its gap of minutes (reference/dsa_format.md).
  ASSERT_EQ(recording->timing.gaps.size(), 1u);
  const double begin = recording->timeS[recording->timing.gaps[0].frame];
  EXPECT_NE(recording->gapAt(begin + 1.0), nullptr);
  EXPECT_EQ(recording->gapAt(begin), nullptr);
}

}  // namespace
}  // namespace palpate::gui::recording_opener_test
