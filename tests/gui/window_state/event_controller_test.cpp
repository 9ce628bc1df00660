// Events of open recordings: marks follow the editor, and nothing unsaved is lost without a
// question.
#include "gui/window_state/event_controller.h"

#include <QSignalSpy>

#include "gui/window_state/window_state_fixture.h"

namespace palpate::gui::event_controller_test {
namespace {

class EventControllerTest : public WindowStateTest {
 protected:
  EventControllerTest() : desk_(windowState_->events) {
    shown_ = recording((folder_ / "a.dsa").string());
    windowState_->displayed.show(shown_);
  }
  Event label(const std::string& text) const {
    const std::int64_t us = shown_->profile.frameTimeUs(3);
    return {us, us, kLabelKind, std::nullopt, text, {}};
  }
  EventController& desk_;
  OpenedRecordingPtr shown_;
};

TEST_F(EventControllerTest, MarksFollowTheEditor) {
  QSignalSpy changed(&desk_, &EventController::changed);
  const std::size_t before = desk_.marks().size();
  desk_.add(label("lift"), "a label");
  EXPECT_EQ(desk_.marks().size(), before + 1);
  EXPECT_GE(changed.count(), 1);
  EXPECT_TRUE(desk_.hasUnsaved(shown_));
  desk_.editor()->undoStack().undo();
  EXPECT_EQ(desk_.marks().size(), before);
  EXPECT_FALSE(desk_.hasUnsaved(shown_));
}

TEST_F(EventControllerTest, WhatOthersFoundStandsAmongTheMarks) {
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

TEST_F(EventControllerTest, OneOfAKindIsKeptAtATime) {
  desk_.keep("tare", label("first"), "the zero");
  desk_.keep("tare", label("second"), "the zero");
  // Of the kind "label": what was kept under another kind isn't touched.
  EXPECT_EQ(desk_.editor()->events().size(), 2u);
  Event tare = label("third");
  tare.kind = "tare";
  desk_.keep("tare", tare, "the zero");
  desk_.keep("tare", tare, "the zero");
  EXPECT_EQ(desk_.editor()->events().size(), 3u);
  desk_.keep("tare", std::nullopt, "the zero");
  EXPECT_EQ(desk_.editor()->events().size(), 2u);
}

TEST_F(EventControllerTest, NothingUnsavedGoesWithoutAQuestion) {
  EXPECT_TRUE(desk_.settle({shown_}));
  EXPECT_TRUE(ask_.choices.asked.isEmpty()) << "nothing was changed";
  desk_.add(label("lift"), "a label");
  EXPECT_FALSE(desk_.settle({shown_})) << "cancelled";
  ASSERT_EQ(ask_.choices.asked.size(), 1);
  EXPECT_TRUE(ask_.choices.asked[0].endsWith("not saved:\na.dsa"));
  ask_.choices = {"Discard"};
  EXPECT_TRUE(desk_.settle({shown_}));
  EXPECT_TRUE(desk_.hasUnsaved(shown_)) << "somebody else may still cancel: it is there until then";
  desk_.discardAll();
  EXPECT_FALSE(desk_.hasUnsaved(shown_));
}

TEST_F(EventControllerTest, WhatCannotBeSavedIsSaidAndKept) {
  QSignalSpy failed(&windowState_->messages, &Messages::failed);
  desk_.add(label("lift"), "a label");
  ask_.choices = {"Save"};
  std::filesystem::create_directory(folder_ / "a.dsa");  // no file can be written there
  EXPECT_FALSE(desk_.settle({shown_}));
  EXPECT_EQ(failed.count(), 1);
  EXPECT_TRUE(desk_.hasUnsaved(shown_));
}

TEST_F(EventControllerTest, AnotherRecordingHasItsOwn) {
  desk_.add(label("lift"), "a label");
  const OpenedRecordingPtr other = recording("b");
  windowState_->displayed.show(other);
  EXPECT_TRUE(desk_.editor()->events().empty());
  windowState_->displayed.show(shown_);
  EXPECT_EQ(desk_.editor()->events().size(), 1u);
}

}  // namespace
}  // namespace palpate::gui::event_controller_test
