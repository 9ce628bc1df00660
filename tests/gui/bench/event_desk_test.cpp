// Events of open recordings: marks follow the editor, and nothing unsaved is lost without a
// question.
#include "gui/bench/event_desk.h"

#include <QSignalSpy>

#include "gui/bench/bench_fixture.h"

namespace palpate::gui::event_desk_test {
namespace {

class EventDeskTest : public BenchTest {
 protected:
  EventDeskTest() : desk_(bench_->events) {
    bench_->questions.unsaved = [this](const QString& names) {
      asked_.append(names);
      return answer_;
    };
    shown_ = recording((folder_ / "a.dsa").string());
    bench_->subject.show(shown_);
  }
  RecordingEvent label(const std::string& text) const {
    const std::int64_t us = shown_->profile.frameTimeUs(3);
    return {us, us, kLabelKind, std::nullopt, text, {}};
  }
  EventDesk& desk_;
  OpenedRecordingPtr shown_;
  QStringList asked_;
  Questions::Unsaved answer_ = Questions::Unsaved::kCancel;
};

TEST_F(EventDeskTest, MarksFollowTheEditor) {
  QSignalSpy changed(&desk_, &EventDesk::changed);
  const std::size_t before = desk_.marks().size();
  desk_.add(label("lift"), "a label");
  EXPECT_EQ(desk_.marks().size(), before + 1);
  EXPECT_GE(changed.count(), 1);
  EXPECT_TRUE(desk_.hasUnsaved(shown_));
  desk_.editor()->undoStack().undo();
  EXPECT_EQ(desk_.marks().size(), before);
  EXPECT_FALSE(desk_.hasUnsaved(shown_));
}

TEST_F(EventDeskTest, WhatOthersFoundStandsAmongTheMarks) {
  desk_.addFound([this](const OpenedRecordingPtr& of, std::vector<EventMark>& marks) {
    EXPECT_EQ(of, shown_);
    EventMark mark;
    mark.lane = EventLane::kSlips;
    mark.text = "slip";
    marks.push_back(mark);
  });
  desk_.renewMarks();
  ASSERT_FALSE(desk_.marks().empty());
  EXPECT_EQ(desk_.marks().back().text, "slip");
}

TEST_F(EventDeskTest, OneOfAKindIsKeptAtATime) {
  desk_.keep("tare", label("first"), "the zero");
  desk_.keep("tare", label("second"), "the zero");
  // Of the kind "label": what was kept under another kind isn't touched.
  EXPECT_EQ(desk_.editor()->events().size(), 2u);
  RecordingEvent tare = label("third");
  tare.kind = "tare";
  desk_.keep("tare", tare, "the zero");
  desk_.keep("tare", tare, "the zero");
  EXPECT_EQ(desk_.editor()->events().size(), 3u);
  desk_.keep("tare", std::nullopt, "the zero");
  EXPECT_EQ(desk_.editor()->events().size(), 2u);
}

TEST_F(EventDeskTest, NothingUnsavedGoesWithoutAQuestion) {
  EXPECT_TRUE(desk_.settle({shown_}));
  EXPECT_TRUE(asked_.isEmpty()) << "nothing was changed";
  desk_.add(label("lift"), "a label");
  EXPECT_FALSE(desk_.settle({shown_})) << "cancelled";
  EXPECT_EQ(asked_, QStringList("a.dsa"));
  answer_ = Questions::Unsaved::kDiscard;
  EXPECT_TRUE(desk_.settle({shown_}));
  EXPECT_TRUE(desk_.hasUnsaved(shown_)) << "somebody else may still cancel: it is there until then";
  desk_.discardAll();
  EXPECT_FALSE(desk_.hasUnsaved(shown_));
}

TEST_F(EventDeskTest, WhatCannotBeSavedIsSaidAndKept) {
  QSignalSpy failed(&bench_->messages, &Messages::failed);
  desk_.add(label("lift"), "a label");
  answer_ = Questions::Unsaved::kSave;
  std::filesystem::create_directory(folder_ / "a.dsa");  // no file can be written there
  EXPECT_FALSE(desk_.settle({shown_}));
  EXPECT_EQ(failed.count(), 1);
  EXPECT_TRUE(desk_.hasUnsaved(shown_));
}

TEST_F(EventDeskTest, AnotherRecordingHasItsOwn) {
  desk_.add(label("lift"), "a label");
  const OpenedRecordingPtr other = recording("b");
  bench_->subject.show(other);
  EXPECT_TRUE(desk_.editor()->events().empty());
  bench_->subject.show(shown_);
  EXPECT_EQ(desk_.editor()->events().size(), 1u);
}

}  // namespace
}  // namespace palpate::gui::event_desk_test
