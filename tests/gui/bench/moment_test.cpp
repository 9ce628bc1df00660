// The one frame that is seen, and whether it is of now.
#include "gui/bench/moment.h"

#include <QSignalSpy>

#include <palpate/model/profile_builder.h>

#include "gui/bench/bench_fixture.h"

namespace palpate::gui::moment_test {
namespace {

class MomentTest : public BenchTest {
 protected:
  MomentTest() : moment_(bench_->moment) {}
  // Sample frames have 10 * (i + 1) counts in this place.
  float value() const { return moment_.frame().matrix(1)(7, 2); }
  Moment& moment_;
};

TEST_F(MomentTest, IsTheFrameAtWhichThePlaybackStands) {
  EXPECT_FALSE(moment_.hasFrame());
  bench_->subject.show(recording("a"));
  EXPECT_EQ(value(), 10.0F);
  bench_->playback.seekFrame(4);
  EXPECT_EQ(value(), 50.0F);
  EXPECT_EQ(moment_.index(), 4u);
  bench_->subject.replace(bench_->subject.behind(), nullptr);
  bench_->subject.show(nullptr);
  EXPECT_FALSE(moment_.hasFrame());
}

TEST_F(MomentTest, CountsSaturatedTaxelsAsRecordedWhateverTheFiltersMakeOfThem) {
  ProfileBuilder builder(sdh2().layout);
  TactileFrame frame = emptyFrame();
  frame.matrix(1)(7, 2) = static_cast<float>(sdh2().saturationCounts);
  builder.addFrame(1'000'000, frame.values);
  const auto full = makeOpenedRecording("full", builder.finish({}));
  bench_->subject.show(full);
  EXPECT_EQ(moment_.saturated(), 1);
  bench_->subject.setSeen(recording("full, filtered"));
  EXPECT_EQ(value(), 10.0F);
  EXPECT_EQ(moment_.saturated(), 1);
}

TEST_F(MomentTest, AHeldLivePictureStandsStillAndSaysSo) {
  connectEmulated();
  EXPECT_EQ(moment_.old().notice, "");
  QSignalSpy first(&moment_, &Moment::firstFrameCame);
  moment_.hold(true);
  EXPECT_TRUE(moment_.old().held);
  EXPECT_TRUE(moment_.old().notice.contains("held"));
  QSignalSpy frames(&moment_, &Moment::frameChanged);
  QTest::qWait(300);
  EXPECT_EQ(frames.count(), 0);
  moment_.hold(false);
  EXPECT_EQ(moment_.old().notice, "");
  EXPECT_TRUE(frames.wait(10'000)) << "it goes on";
  EXPECT_EQ(first.count(), 0) << "it is the same source";
}

TEST_F(MomentTest, WhatIsNotConnectedAnyMoreDoesNotLookLikeNow) {
  connectEmulated();
  QStringList notices;
  QObject::connect(&moment_, &Moment::oldChanged, [&] { notices.append(moment_.old().notice); });
  disconnect();
  EXPECT_TRUE(notices.contains("not connected any more")) << notices.join("; ").toStdString();
  EXPECT_EQ(moment_.old().notice, "") << "nothing is shown by now";
}

TEST_F(MomentTest, HoldingEndsWithItsSource) {
  connectEmulated();
  moment_.hold(true);
  disconnect();
  EXPECT_FALSE(moment_.held());
}

}  // namespace
}  // namespace palpate::gui::moment_test
