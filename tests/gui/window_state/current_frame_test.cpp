// The one frame that is seen, and whether it is of now.
#include "gui/window_state/current_frame.h"

#include <QRegularExpression>
#include <QSignalSpy>

#include "palpate/device/sdh2.h"
#include <palpate/model/profile_builder.h>

#include "gui/window_state/window_state_fixture.h"
#include "testing/damaged_profile.h"

namespace palpate::gui::current_frame_test {
namespace {

class CurrentFrameTest : public WindowStateTest {
 protected:
  CurrentFrameTest() : currentFrame_(windowState_->currentFrame) {}
  // Sample frames have 10 * (i + 1) counts in this place.
  float value() const { return currentFrame_.frame().matrix(1)(7, 2); }
  CurrentFrame& currentFrame_;
};

TEST_F(CurrentFrameTest, IsTheFrameAtWhichThePlaybackStands) {
  EXPECT_FALSE(currentFrame_.hasFrame());
  windowState_->displayed.show(recording("a"));
  EXPECT_EQ(value(), 10.0F);
  windowState_->playback.seekFrame(4);
  EXPECT_EQ(value(), 50.0F);
  EXPECT_EQ(currentFrame_.index(), 4u);
  windowState_->displayed.replace(windowState_->displayed.unfilteredRecording(), nullptr);
  windowState_->displayed.show(nullptr);
  EXPECT_FALSE(currentFrame_.hasFrame());
}

TEST_F(CurrentFrameTest, CountsSaturatedTaxelsAsRecordedWhateverTheFiltersMakeOfThem) {
  ProfileBuilder builder(sdh2().layout);
  TactileFrame frame = emptyFrame();
  frame.matrix(1)(7, 2) = static_cast<float>(sdh2().saturationCounts);
  builder.addFrame(1'000'000, frame.values);
  const auto full = makeOpenedRecording("full", builder.finish({}));
  windowState_->displayed.show(full);
  EXPECT_EQ(currentFrame_.saturated(), 1);
  windowState_->displayed.setFilteredRecording(recording("full, filtered"));
  EXPECT_EQ(value(), 10.0F);
  EXPECT_EQ(currentFrame_.saturated(), 1);
}

TEST_F(CurrentFrameTest, AHeldLivePictureStandsStillAndSaysSo) {
  connectEmulated();
  EXPECT_EQ(currentFrame_.old().notice, "");
  QSignalSpy first(&currentFrame_, &CurrentFrame::firstFrameReceived);
  currentFrame_.hold(true);
  EXPECT_TRUE(currentFrame_.old().held);
  EXPECT_TRUE(currentFrame_.old().notice.contains("on hold"));
  QSignalSpy frames(&currentFrame_, &CurrentFrame::frameChanged);
  QTest::qWait(300);
  EXPECT_EQ(frames.count(), 0);
  currentFrame_.hold(false);
  EXPECT_EQ(currentFrame_.old().notice, "");
  EXPECT_TRUE(frames.wait(10'000)) << "it goes on";
  EXPECT_EQ(first.count(), 0) << "it is the same source";
}

// The alarm above the views says why, and what to do.
TEST_F(CurrentFrameTest, OfSilenceOnlyTheDurationIsTold) {
  connectEmulated();
  windowState_->live.source()->emulated->mute(true);
  const QRegularExpression duration("^no frame for [0-9.]+ s$");
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        return windowState_->live.health().device.tactile.message.find("power") !=
               std::string::npos;
      },
      20'000));
  QTest::qWait(200);
  EXPECT_TRUE(duration.match(currentFrame_.old().notice).hasMatch())
      << currentFrame_.old().notice.toStdString();
}

TEST_F(CurrentFrameTest, WhatIsNotConnectedAnyMoreDoesNotLookLikeNow) {
  connectEmulated();
  QStringList notices;
  QObject::connect(&currentFrame_, &CurrentFrame::staleNoticeChanged, [&] {
    notices.append(currentFrame_.old().notice);
  });
  disconnect();
  EXPECT_TRUE(notices.contains("not connected any more")) << notices.join("; ").toStdString();
  EXPECT_EQ(currentFrame_.old().notice, "") << "nothing is shown by now";
}

TEST_F(CurrentFrameTest, HoldingEndsWithItsSource) {
  connectEmulated();
  currentFrame_.hold(true);
  disconnect();
  EXPECT_FALSE(currentFrame_.held());
}

// It plays on over the damaged part, says once what is wrong, and shows the frames behind it.
TEST_F(CurrentFrameTest, PlayingGoesOnOverDamagedFrames) {
  constexpr std::size_t kAlwaysLong =
      1;  // short recordings are opened without their damaged frames
  windowState_->displayed.show(
      makeOpenedRecording("damaged", testing::withDamage(twentyFrames(), 8, 11), {}, kAlwaysLong));
  QStringList notices;
  QObject::connect(&currentFrame_, &CurrentFrame::staleNoticeChanged, [&] {
    notices.append(currentFrame_.old().notice);
  });
  windowState_->playback.play();
  for (std::size_t i = 1; i < 20; ++i) {
    clock_.advanceMs(50);
    windowState_->playback.tick();
    ASSERT_EQ(windowState_->playback.frame(), i);
    const bool lost = i >= 8 && i <= 11;
    EXPECT_EQ(currentFrame_.old().notice.contains("block 7 is damaged"), lost) << i;
    if (lost) continue;
    EXPECT_EQ(value(), 10.0F * static_cast<float>(i + 1));
  }
  EXPECT_FALSE(windowState_->playback.playing()) << "it is at its end";
  EXPECT_EQ(notices.size(), 2) << notices.join("; ").toStdString();
}

}  // namespace
}  // namespace palpate::gui::current_frame_test
