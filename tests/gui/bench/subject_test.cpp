// What is looked at: state first, then each signal once, and everything stands where it was left.
#include "gui/bench/subject.h"

#include <QSignalSpy>
#include <QStringList>

#include "gui/bench/bench_fixture.h"

namespace palpate::gui::subject_test {
namespace {

using Kind = Subject::Kind;

class SubjectTest : public BenchTest {
 protected:
  SubjectTest() : subject_(bench_->subject) {
    const auto note = [this](const char* name) { return [this, name] { heard_.append(name); }; };
    QObject::connect(&subject_, &Subject::changed, note("changed"));
    QObject::connect(&subject_, &Subject::seenChanged, note("seen"));
    QObject::connect(&subject_, &Subject::valuesChanged, note("values"));
    QObject::connect(&subject_, &Subject::shown, note("shown"));
  }
  QStringList heard() { return std::exchange(heard_, {}); }

  Subject& subject_;
  QStringList heard_;
};

TEST_F(SubjectTest, NothingIsLookedAtAtFirst) {
  EXPECT_EQ(subject_.kind(), Kind::kNothing);
  EXPECT_EQ(subject_.hand(), nullptr);
  EXPECT_EQ(subject_.recorded(), nullptr);
  EXPECT_FALSE(subject_.hasFrames());
}

TEST_F(SubjectTest, EachSignalComesOnceAndInOrder) {
  subject_.show(recording("a"));
  EXPECT_EQ(heard(), QStringList({"changed", "seen", "shown"}));
  subject_.show(recording("b"));
  EXPECT_EQ(heard(), QStringList({"changed", "seen", "shown"}));
  subject_.show(subject_.behind());
  EXPECT_EQ(heard(), QStringList()) << "the same one again";
  subject_.setSeen(recording("b filtered"));
  EXPECT_EQ(heard(), QStringList({"seen", "values", "shown"}));
}

TEST_F(SubjectTest, WhoHearsOfItFindsEverythingNew) {
  subject_.show(recording("a"));
  const OpenedRecordingPtr next = recording("b");
  bool looked = false;
  QObject::connect(&subject_, &Subject::changed, [&] {
    looked = true;
    EXPECT_EQ(subject_.kind(), Kind::kRecording);
    EXPECT_EQ(subject_.recorded(), next);
    EXPECT_EQ(subject_.seen(), next);
    EXPECT_EQ(subject_.hand(), &next->profile.hand());
    EXPECT_EQ(bench_->selection.span(), std::nullopt);
    EXPECT_FALSE(bench_->playback.hasFrames()) << "nobody asks it for the old one's frame";
  });
  subject_.show(next);
  EXPECT_TRUE(looked);
  EXPECT_TRUE(subject_.hasFrames());
}

TEST_F(SubjectTest, ComesBackToTheFrameAndSpanWhereItWasLeft) {
  const OpenedRecordingPtr first = recording("a");
  subject_.show(first);
  bench_->playback.seekFrame(7);
  bench_->selection.setSpan(TimeSpan{0.2, 0.4});
  subject_.show(recording("b"));
  EXPECT_EQ(bench_->playback.frame(), 0u);
  EXPECT_EQ(bench_->selection.span(), std::nullopt);
  subject_.show(first);
  EXPECT_EQ(bench_->playback.frame(), 7u);
  EXPECT_EQ(bench_->selection.span(), (TimeSpan{0.2, 0.4}));
}

TEST_F(SubjectTest, FilteredValuesLeaveTheFrameWhereItIs) {
  subject_.show(recording("a"));
  bench_->playback.seekFrame(5);
  QSignalSpy frames(&bench_->moment, &Moment::frameChanged);
  subject_.setSeen(recording("a filtered"));
  EXPECT_EQ(bench_->playback.frame(), 5u);
  EXPECT_EQ(frames.count(), 1) << "the moment is read once";
}

TEST_F(SubjectTest, AClosedOneIsForgotten) {
  const OpenedRecordingPtr first = recording("a");
  subject_.show(first);
  bench_->playback.seekFrame(7);
  subject_.replace(first, nullptr);
  subject_.show(nullptr);
  EXPECT_EQ(subject_.kind(), Kind::kNothing);
  subject_.show(recording("a"));
  EXPECT_EQ(bench_->playback.frame(), 0u) << "opened anew it stands at its begin";
}

TEST_F(SubjectTest, LiveAndBackTheRecordingStandsWhereItWas) {
  const OpenedRecordingPtr first = recording("a");
  subject_.show(first);
  bench_->playback.seekFrame(9);
  heard();
  connectEmulated();
  EXPECT_EQ(heard(), QStringList({"changed", "seen", "shown"}));
  EXPECT_TRUE(subject_.isLive());
  EXPECT_EQ(subject_.recorded(), nullptr);
  EXPECT_EQ(subject_.behind(), first);
  ASSERT_NE(subject_.hand(), nullptr);
  EXPECT_EQ(subject_.hand()->name, bench_->live.source()->session->device().hand().name);
  subject_.showLive();
  EXPECT_EQ(heard(), QStringList()) << "it is looked at already";
  disconnect();
  EXPECT_EQ(subject_.recorded(), first);
  EXPECT_EQ(bench_->playback.frame(), 9u);
  EXPECT_EQ(heard(), QStringList({"changed", "seen", "shown"}));
}

TEST_F(SubjectTest, BehindWhatIsLiveAFileThatIsReadAnewIsTheNewOne) {
  const OpenedRecordingPtr first = recording("a"), anew = recording("a");
  subject_.show(first);
  connectEmulated();
  subject_.replace(first, anew);
  EXPECT_EQ(subject_.behind(), anew);
  disconnect();
  EXPECT_EQ(subject_.recorded(), anew);
}

TEST_F(SubjectTest, WithoutARecordingLeftWhatIsConnectedIsLookedAt) {
  connectEmulated();
  const OpenedRecordingPtr first = recording("a");
  subject_.show(first);
  EXPECT_FALSE(subject_.isLive());
  subject_.replace(first, nullptr);
  subject_.show(nullptr);
  EXPECT_TRUE(subject_.isLive());
  disconnect();
  EXPECT_EQ(subject_.kind(), Kind::kNothing);
}

}  // namespace
}  // namespace palpate::gui::subject_test
