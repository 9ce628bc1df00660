#include "gui/source/event_editor.h"

#include <QSignalSpy>
#include <stdexcept>

#include <palpate/core/error.h>

#include "testing/testing.h"

namespace palpate::gui::event_editor_test {
namespace {

Event label(std::int64_t tUs, const std::string& text) {
  return {.tUs = tUs, .t1Us = tUs, .kind = "label", .matrix = {}, .text = text, .json = {}};
}

class EventEditorTest : public ::testing::Test {
 protected:
  EventEditor editor_{EventsReport{{label(10, "a"), label(30, "c")}, 0},
                      [this](const EventsReport& asRead, const std::vector<Event>& now) {
                        if (refuse_) throw FileError("x.palpate", "is read-only");
                        asRead_ = asRead.events;
                        saved_ = now;
                      }};
  std::vector<Event> asRead_, saved_;
  bool refuse_ = false;
  std::string texts() {
    std::string out;
    for (const Event& event : editor_.events()) out += event.text;
    return out;
  }
};

TEST_F(EventEditorTest, KeepsEventsInOrderOfTime) {
  editor_.add(label(20, "b"), "a label");
  EXPECT_EQ(texts(), "abc");
  Event later = editor_.events()[0];
  later.tUs = later.t1Us = 40;
  editor_.change(0, later, "moving");
  EXPECT_EQ(texts(), "bca");
  editor_.remove(1, "deleting");
  EXPECT_EQ(texts(), "ba");
  EXPECT_THROW(editor_.remove(2, "x"), std::out_of_range);
}

// Bars of one span would change their places when one of them is named.
TEST_F(EventEditorTest, AmongEventsOfOneTimeAChangedOneKeepsItsPlace) {
  editor_.add(label(10, "b"), "a label");
  Event named = editor_.events()[0];
  named.text = "x";
  editor_.change(0, named, "naming");
  EXPECT_EQ(texts(), "xbc");
  editor_.undoStack().undo();
  EXPECT_EQ(texts(), "abc");
}

TEST_F(EventEditorTest, EveryChangeIsUndoneAndRedone) {
  editor_.add(label(20, "b"), "a label");
  editor_.remove(0, "deleting");
  EXPECT_EQ(texts(), "bc");
  EXPECT_EQ(editor_.undoStack().undoText(), "deleting");
  editor_.undoStack().undo();
  EXPECT_EQ(texts(), "abc");
  editor_.undoStack().undo();
  EXPECT_EQ(texts(), "ac");
  EXPECT_FALSE(editor_.unsaved());
  editor_.undoStack().redo();
  editor_.undoStack().redo();
  EXPECT_EQ(texts(), "bc");
}

TEST_F(EventEditorTest, ChangesTogetherAreUndoneTogether) {
  editor_.changeTogether("both", [&] {
    editor_.add(label(20, "b"), "one");
    editor_.add(label(40, "d"), "two");
  });
  EXPECT_EQ(texts(), "abcd");
  editor_.undoStack().undo();
  EXPECT_EQ(texts(), "ac");
}

TEST_F(EventEditorTest, ManyAddedAtOnceAreOneChange) {
  editor_.add(std::vector{label(40, "d"), label(20, "b"), label(10, "A")}, "importing labels");
  EXPECT_EQ(texts(), "aAbcd");
  EXPECT_EQ(editor_.undoStack().count(), 1);
  editor_.undoStack().undo();
  EXPECT_EQ(texts(), "ac");
  editor_.undoStack().redo();
  EXPECT_EQ(texts(), "aAbcd");
  editor_.add(std::vector<Event>(), "importing labels");
  EXPECT_EQ(editor_.undoStack().count(), 1);
}

TEST_F(EventEditorTest, AChangeThatChangesNothingIsNone) {
  editor_.change(0, editor_.events()[0], "nothing");
  EXPECT_FALSE(editor_.undoStack().canUndo());
}

TEST_F(EventEditorTest, SavingTellsWhatWasReadAndIsCleanAfterwards) {
  editor_.add(label(20, "b"), "a label");
  EXPECT_TRUE(editor_.unsaved());
  editor_.save();
  EXPECT_FALSE(editor_.unsaved());
  EXPECT_EQ(asRead_.size(), 2u);
  EXPECT_EQ(saved_.size(), 3u);
  editor_.undoStack().undo();
  EXPECT_TRUE(editor_.unsaved()) << "the file has it now";
  editor_.save();
  EXPECT_EQ(asRead_.size(), 3u) << "what the file has since";
  EXPECT_EQ(saved_.size(), 2u);
}

TEST_F(EventEditorTest, WhatCantBeSavedStays) {
  editor_.add(label(20, "b"), "a label");
  refuse_ = true;
  EXPECT_THROW(editor_.save(), FileError);
  EXPECT_TRUE(editor_.unsaved());
  EXPECT_EQ(texts(), "abc");
}

TEST_F(EventEditorTest, TellsOfChanges) {
  QSignalSpy changed(&editor_, &EventEditor::changed);
  editor_.add(label(20, "b"), "a label");
  EXPECT_GE(changed.size(), 1);
  changed.clear();
  editor_.undoStack().undo();
  EXPECT_GE(changed.size(), 1);
}

}  // namespace
}  // namespace palpate::gui::event_editor_test
