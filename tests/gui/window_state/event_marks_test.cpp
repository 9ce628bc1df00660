#include "gui/window_state/event_marks.h"

#include <gtest/gtest.h>

#include <palpate/recognition/grasp_segments.h>

#include "gui/testing/sample_profiles.h"

namespace palpate::gui::event_marks_test {
namespace {

constexpr std::int64_t kStartUs = 1'400'000'000'000'000;

Event event(const char* kind, double fromS, double toS, const std::string& text) {
  return {.tUs = kStartUs + static_cast<std::int64_t>(fromS * 1e6),
          .t1Us = kStartUs + static_cast<std::int64_t>(toS * 1e6),
          .kind = kind,
          .matrix = {},
          .text = text,
          .json = {}};
}

const GraspSegment kFound{.begin = 4, .end = 9, .fingers = {0, 2}, .quality = 0.75};

class EventMarksTest : public ::testing::Test {
 protected:
  OpenedRecordingPtr recording_ = makeOpenedRecording("x.dsa", twentyFrames());
};

TEST_F(EventMarksTest, ShowsWhatWasFoundAndWhatIsNoted) {
  const std::vector<Event> events = {event("label", 0.2, 0.2, "touch"),
                                     event("note", 0.3, 0.5, "slow"),
                                     event("settings", 0.1, 0.1, "threshold 100"),
                                     event("gap", 0.1, 0.4, "")};
  const auto marks = marksOf(*recording_, events, std::vector{kFound});
  ASSERT_EQ(marks.size(), 4u) << "a gap of the recorder is shown by the stamps alone";
  EXPECT_EQ(marks[0].lane, EventLane::kGrasps);
  EXPECT_EQ(marks[0].text, "1");
  EXPECT_DOUBLE_EQ(marks[0].fromS, 0.2);
  EXPECT_DOUBLE_EQ(marks[0].toS, 0.45);
  EXPECT_TRUE(marks[0].detail.contains("0, 2")) << marks[0].detail.toStdString();
  EXPECT_TRUE(marks[0].detail.contains("0.75"));
  EXPECT_EQ(marks[1].lane, EventLane::kLabels);
  EXPECT_EQ(marks[1].event, 0u);
  EXPECT_TRUE(marks[1].editable);
  EXPECT_EQ(marks[2].lane, EventLane::kNotes);
  EXPECT_DOUBLE_EQ(marks[2].toS, 0.5);
  EXPECT_EQ(marks[3].lane, EventLane::kOthers);
  EXPECT_FALSE(marks[3].editable) << "what happened is not changed";
}

TEST_F(EventMarksTest, CorrectedGraspsTakeThePlaceOfThoseFound) {
  const std::vector<Event> events = {event("segment", 0.5, 0.9, "grasp"),
                                     event("segment", 0.1, 0.3, "pinch")};
  const auto marks = marksOf(*recording_, events, std::vector{kFound});
  ASSERT_EQ(marks.size(), 2u);
  EXPECT_EQ(marks[0].text, "pinch");
  EXPECT_EQ(marks[1].text, "2") << "numbered by time";
}

TEST_F(EventMarksTest, ARecordingCanBeSaidToHaveNoGrasp) {
  const Event none = removedGraspEvent(*recording_);
  EXPECT_TRUE(isRemovedGrasp(none));
  EXPECT_FALSE(isRemovedGrasp(event("segment", 0.1, 0.3, "grasp")));
  EXPECT_TRUE(marksOf(*recording_, std::vector{none}, std::vector{kFound}).empty());
}

TEST_F(EventMarksTest, AFoundGraspAsAnEvent) {
  const Event segment = segmentOf(*recording_, kFound);
  EXPECT_EQ(segment.kind, "segment");
  EXPECT_EQ(segment.tUs, kStartUs + 200'000);
  EXPECT_EQ(segment.t1Us, kStartUs + 450'000);
  EXPECT_NE(segment.json.find("\"quality\""), std::string::npos);
}

TEST(EventMarks, GapsAreThoseOfTheStamps) {
  const auto recording =
      makeOpenedRecording("x.dsa", profileWithStamps({0, 50, 100, 150, 9'000, 9'050}));
  const auto marks = marksOf(*recording, {}, {});
  ASSERT_EQ(marks.size(), 1u);
  EXPECT_EQ(marks[0].lane, EventLane::kGaps);
  EXPECT_DOUBLE_EQ(marks[0].fromS, 0.15);
  EXPECT_DOUBLE_EQ(marks[0].toS, 9.0);
  EXPECT_TRUE(marks[0].detail.contains("nothing was recorded"));
}

// A recovered recording notes what was lost, of frames and of joint angles.
TEST(EventMarks, AGapTellsWhatTheRecordingSaysOfIt) {
  OpenedRecording opened =
      *makeOpenedRecording("x.palpate", profileWithStamps({0, 50, 100, 150, 9'000, 9'050}));
  const std::int64_t startUs = opened.profile.frameTimeUs(0);
  opened.events.events = {
      {startUs + 60'000, startUs + 120'000, "gap", {}, "3 angle samples lost", {}},
      {startUs + 160'000,
       startUs + 8'990'000,
       "gap",
       {},
       "177 frames lost: the file was damaged",
       {}}};
  const auto marks = marksOf(opened, opened.events.events, {});
  ASSERT_EQ(marks.size(), 2u);
  EXPECT_EQ(marks[0].lane, EventLane::kGaps);
  EXPECT_TRUE(marks[0].detail.contains("3 angle samples lost")) << marks[0].detail.toStdString();
  EXPECT_EQ(marks[1].lane, EventLane::kGaps);
  EXPECT_TRUE(marks[1].detail.contains("177 frames lost: the file was damaged"));
  EXPECT_FALSE(marks[1].detail.contains("nothing was recorded"));
}

// A tool tip is read by people: what an event holds as JSON is told in words.
TEST(EventMarks, DetailsOfAnEventAreToldInWords) {
  const OpenedRecording opened = *makeOpenedRecording("x.palpate", profileWithStamps({0, 50, 100}));
  const std::int64_t startUs = opened.profile.frameTimeUs(0);
  const std::vector<Event> events = {
      {startUs + 10'000,
       startUs + 40'000,
       "gap",
       {},
       "3 angle samples lost: the file was damaged",
       R"({"stream":"angles","lost":3,"reason":"the file was damaged"})"},
      {startUs + 60'000,
       startUs + 60'000,
       "settings",
       {},
       "sensitivity changed",
       R"({"by_hand":true,"matrices":[{"sensitivity":0.5,"threshold_counts":150},{"sensitivity":1}]})"},
      {startUs + 70'000, startUs + 70'000, "link", {}, "lost", "{damaged"}};
  const auto marks = marksOf(opened, events, {});
  ASSERT_EQ(marks.size(), 3u);
  EXPECT_EQ(marks[0].detail,
            "gap: 3 angle samples lost: the file was damaged\n0.01 – 0.04 s (0.03 s)");
  EXPECT_EQ(marks[1].detail,
            "settings: sensitivity changed\nat 0.06 s\nby hand: yes\n"
            "matrices: sensitivity 0.5, threshold counts 150; sensitivity 1");
  EXPECT_EQ(marks[2].detail, "link: lost\nat 0.07 s");
}

}  // namespace
}  // namespace palpate::gui::event_marks_test
