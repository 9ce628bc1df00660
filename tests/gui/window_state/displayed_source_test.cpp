// What is looked at: state first, then each signal once, and everything stands where it was left.
#include "gui/window_state/displayed_source.h"

#include <QSignalSpy>
#include <QStringList>
#include <stdexcept>

#include "gui/window_state/window_state_fixture.h"

namespace palpate::gui::displayed_source_test {
namespace {

using Kind = DisplayedSource::Kind;

class DisplayedSourceTest : public WindowStateTest {
 protected:
  DisplayedSourceTest() : displayed_(windowState_->displayed) {
    const auto note = [this](const char* name) { return [this, name] { heard_.append(name); }; };
    QObject::connect(&displayed_, &DisplayedSource::changed, note("changed"));
    QObject::connect(&displayed_, &DisplayedSource::filteredRecordingChanged, note("seen"));
    QObject::connect(&displayed_, &DisplayedSource::valuesChanged, note("values"));
    QObject::connect(&displayed_, &DisplayedSource::shown, note("shown"));
  }
  QStringList heard() { return std::exchange(heard_, {}); }

  DisplayedSource& displayed_;
  QStringList heard_;
};

TEST_F(DisplayedSourceTest, NothingIsLookedAtAtFirst) {
  EXPECT_EQ(displayed_.kind(), Kind::kNothing);
  EXPECT_EQ(displayed_.hand(), nullptr);
  EXPECT_EQ(displayed_.recorded(), nullptr);
  EXPECT_FALSE(displayed_.hasFrames());
}

TEST_F(DisplayedSourceTest, EachSignalComesOnceAndInOrder) {
  displayed_.show(recording("a"));
  EXPECT_EQ(heard(), QStringList({"changed", "seen", "shown"}));
  displayed_.show(recording("b"));
  EXPECT_EQ(heard(), QStringList({"changed", "seen", "shown"}));
  displayed_.show(displayed_.unfilteredRecording());
  EXPECT_EQ(heard(), QStringList()) << "the same one again";
  displayed_.setFilteredRecording(recording("b filtered"));
  EXPECT_EQ(heard(), QStringList({"seen", "values", "shown"}));
}

TEST_F(DisplayedSourceTest, AFailureBeforeTheChangeLeavesEverythingAsItWas) {
  displayed_.show(recording("a"));
  const OpenedRecordingPtr before = displayed_.recorded();
  heard();
  displayed_.filtered = [](const OpenedRecordingPtr&) -> OpenedRecordingPtr {
    throw std::runtime_error("no filters");
  };
  EXPECT_THROW(displayed_.show(recording("b")), std::runtime_error);
  EXPECT_EQ(displayed_.kind(), Kind::kRecording);
  EXPECT_EQ(displayed_.recorded(), before);
  EXPECT_EQ(displayed_.filteredRecording(), before);
  EXPECT_TRUE(windowState_->playback.hasFrames());
  EXPECT_EQ(heard(), QStringList());
}

TEST_F(DisplayedSourceTest, WhoHearsOfItFindsEverythingNew) {
  displayed_.show(recording("a"));
  const OpenedRecordingPtr next = recording("b");
  bool looked = false;
  QObject::connect(&displayed_, &DisplayedSource::changed, [&] {
    looked = true;
    EXPECT_EQ(displayed_.kind(), Kind::kRecording);
    EXPECT_EQ(displayed_.recorded(), next);
    EXPECT_EQ(displayed_.filteredRecording(), next);
    EXPECT_EQ(displayed_.hand(), &next->profile.hand());
    EXPECT_EQ(windowState_->selection.span(), std::nullopt);
    EXPECT_FALSE(windowState_->playback.hasFrames()) << "nobody asks it for the old one's frame";
  });
  displayed_.show(next);
  EXPECT_TRUE(looked);
  EXPECT_TRUE(displayed_.hasFrames());
}

TEST_F(DisplayedSourceTest, ComesBackToTheFrameAndSpanWhereItWasLeft) {
  const OpenedRecordingPtr first = recording("a");
  displayed_.show(first);
  windowState_->playback.seekFrame(7);
  windowState_->selection.setSpan(TimeSpan{0.2, 0.4});
  displayed_.show(recording("b"));
  EXPECT_EQ(windowState_->playback.frame(), 0u);
  EXPECT_EQ(windowState_->selection.span(), std::nullopt);
  displayed_.show(first);
  EXPECT_EQ(windowState_->playback.frame(), 7u);
  EXPECT_EQ(windowState_->selection.span(), (TimeSpan{0.2, 0.4}));
}

TEST_F(DisplayedSourceTest, FilteredValuesLeaveTheFrameWhereItIs) {
  displayed_.show(recording("a"));
  windowState_->playback.seekFrame(5);
  QSignalSpy frames(&windowState_->currentFrame, &CurrentFrame::frameChanged);
  displayed_.setFilteredRecording(recording("a filtered"));
  EXPECT_EQ(windowState_->playback.frame(), 5u);
  EXPECT_EQ(frames.count(), 1) << "the moment is read once";
}

TEST_F(DisplayedSourceTest, AClosedOneIsForgotten) {
  const OpenedRecordingPtr first = recording("a");
  displayed_.show(first);
  windowState_->playback.seekFrame(7);
  displayed_.replace(first, nullptr);
  EXPECT_EQ(displayed_.kind(), Kind::kNothing) << "also until show() is called";
  EXPECT_EQ(displayed_.recorded(), nullptr);
  displayed_.show(nullptr);
  EXPECT_EQ(displayed_.kind(), Kind::kNothing);
  displayed_.show(recording("a"));
  EXPECT_EQ(windowState_->playback.frame(), 0u) << "opened anew it stands at its begin";
}

TEST_F(DisplayedSourceTest, LiveAndBackTheRecordingStandsWhereItWas) {
  const OpenedRecordingPtr first = recording("a");
  displayed_.show(first);
  windowState_->playback.seekFrame(9);
  heard();
  connectEmulated();
  EXPECT_EQ(heard(), QStringList({"changed", "seen", "shown"}));
  EXPECT_TRUE(displayed_.isLive());
  EXPECT_EQ(displayed_.recorded(), nullptr);
  EXPECT_EQ(displayed_.unfilteredRecording(), first);
  ASSERT_NE(displayed_.hand(), nullptr);
  EXPECT_EQ(displayed_.hand()->name, windowState_->live.source()->session->device().hand().name);
  displayed_.showLive();
  EXPECT_EQ(heard(), QStringList()) << "it is looked at already";
  disconnect();
  EXPECT_EQ(displayed_.recorded(), first);
  EXPECT_EQ(windowState_->playback.frame(), 9u);
  EXPECT_EQ(heard(), QStringList({"changed", "seen", "shown"}));
}

TEST_F(DisplayedSourceTest, BehindWhatIsLiveAFileThatIsReadAnewIsTheNewOne) {
  const OpenedRecordingPtr first = recording("a"), anew = recording("a");
  displayed_.show(first);
  connectEmulated();
  displayed_.replace(first, anew);
  EXPECT_EQ(displayed_.unfilteredRecording(), anew);
  disconnect();
  EXPECT_EQ(displayed_.recorded(), anew);
}

TEST_F(DisplayedSourceTest, WithoutARecordingLeftWhatIsConnectedIsLookedAt) {
  connectEmulated();
  const OpenedRecordingPtr first = recording("a");
  displayed_.show(first);
  EXPECT_FALSE(displayed_.isLive());
  displayed_.replace(first, nullptr);
  displayed_.show(nullptr);
  EXPECT_TRUE(displayed_.isLive());
  disconnect();
  EXPECT_EQ(displayed_.kind(), Kind::kNothing);
}

}  // namespace
}  // namespace palpate::gui::displayed_source_test
