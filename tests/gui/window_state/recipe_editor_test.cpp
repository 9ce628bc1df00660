#include "gui/window_state/recipe_editor.h"

#include <QSignalSpy>
#include <cmath>

#include "testing/testing.h"

namespace palpate::gui::recipe_editor_test {
namespace {

std::string textOf(const RecipeEditor& editor) { return recipeText(editor.recipe()); }

TEST(RecipeEditor, EveryChangeIsUndoneAndRedone) {
  RecipeEditor editor;
  editor.insert(0, {.name = "median"});
  editor.insert(1, {.name = "kalman"});
  editor.insert(1, {.name = "box"});
  editor.move(0, 2);
  EXPECT_EQ(textOf(editor), "box | kalman | median");
  editor.setEnabled(1, false);
  editor.setOption(2, "size", 5);
  editor.setMatrices(2, {1, 3});
  editor.remove(0);
  EXPECT_EQ(textOf(editor), "(kalman) | median:size=5,matrices=1+3");
  const char* const back[] = {"box | (kalman) | median:size=5,matrices=1+3",
                              "box | (kalman) | median:size=5",
                              "box | (kalman) | median",
                              "box | kalman | median",
                              "median | box | kalman",
                              "median | kalman",
                              "median",
                              ""};
  for (const char* text : back) {
    ASSERT_TRUE(editor.canUndo());
    editor.undo();
    EXPECT_EQ(textOf(editor), text);
  }
  EXPECT_FALSE(editor.canUndo());
  while (editor.canRedo()) editor.redo();
  EXPECT_EQ(textOf(editor), "(kalman) | median:size=5,matrices=1+3");
}

TEST(RecipeEditor, AnOptionOnItsWayIsOneChange) {
  RecipeEditor editor;
  editor.insert(0, {.name = "gaussian"});
  for (const int size : {5, 7, 9, 11}) editor.setOption(0, "size", size);
  editor.setOption(0, "sigma", 2.5);
  editor.undo();
  EXPECT_EQ(textOf(editor), "gaussian:size=11");
  editor.undo();
  EXPECT_EQ(textOf(editor), "gaussian");
  editor.setOption(0, "sigma", 2.5);
  editor.setOption(0, "sigma", std::nan(""));  // automatic again
  EXPECT_EQ(textOf(editor), "gaussian");
}

TEST(RecipeEditor, OptionsThatDependOnEachOtherGoAlong) {
  RecipeEditor editor;
  editor.insert(0, parseFilterStep("savitzky-golay:window=7,order=4,derivative=2"));
  editor.setOption(0, "window", 3);
  EXPECT_EQ(textOf(editor), "savitzky-golay:window=3,derivative=2");  // order 2
  editor.setOption(0, "order", 6);
  EXPECT_EQ(editor.recipe().steps[0].integer("window"), 9);
  editor.setOption(0, "order", 0);
  EXPECT_EQ(editor.recipe().steps[0].integer("derivative"), 0);
  editor.setOption(0, "derivative", 1);
  EXPECT_EQ(editor.recipe().steps[0].integer("order"), 1);
  editor.setRecipe({});
  editor.insert(0, parseFilterStep("median3d:window=201"));
  editor.setOption(0, "size", 7);
  EXPECT_EQ(textOf(editor), "median3d:size=7,window=39");  // 49 * 39 = 1911
  editor.setOption(0, "window", 1001);
  EXPECT_EQ(textOf(editor), "median3d:size=1,window=1001");
  editor.setRecipe({});
  editor.insert(0, parseFilterStep("band-pass:low=2,high=4"));
  editor.setOption(0, "low", 6);
  EXPECT_EQ(textOf(editor), "band-pass:low=6,high=12");
  editor.setOption(0, "high", 3);
  EXPECT_EQ(textOf(editor), "band-pass:low=1.5,high=3");
  editor.setOption(0, "low", 10'000);
  EXPECT_EQ(textOf(editor), "band-pass:low=5000,high=10000");
  editor.setOption(0, "order", 8);
  EXPECT_EQ(textOf(editor), "band-pass:low=5000,high=10000,order=8");
  editor.setRecipe({});
  editor.insert(0, parseFilterStep("temporal-min:window=4"));
  editor.setOption(0, "centred", 1);
  EXPECT_EQ(editor.recipe().steps[0].integer("window"), 5);
}

TEST(RecipeEditor, WhatDoesNotExistIsRefusedAndNothingChanges) {
  RecipeEditor editor;
  editor.insert(0, {.name = "median"});
  const QSignalSpy changes(&editor, &RecipeEditor::changed);
  EXPECT_THROW(editor.remove(1), std::out_of_range);
  EXPECT_THROW(editor.move(0, 1), std::out_of_range);
  EXPECT_THROW(editor.insert(0, {.name = "blur"}), std::invalid_argument);
  EXPECT_THROW(editor.setOption(0, "size", 4), std::invalid_argument);
  EXPECT_EQ(textOf(editor), "median");
  EXPECT_EQ(changes.size(), 0);
}

TEST(RecipeEditor, TheSpanOfARestStaysASpan) {
  RecipeEditor editor;
  editor.setRecipe(parseRecipe(std::vector<std::string>{"baseline:rest=1/2"}));
  editor.setOption(0, "from", 3.0);
  EXPECT_EQ(textOf(editor), "baseline:from=3,to=4") << "it is taken of the recording";
  editor.setOption(0, "to", 2.0);
  EXPECT_EQ(textOf(editor), "baseline:from=1,to=2");
  editor.setOption(0, "to", 0.0);
  EXPECT_EQ(textOf(editor), "baseline");
}

}  // namespace
}  // namespace palpate::gui::recipe_editor_test
