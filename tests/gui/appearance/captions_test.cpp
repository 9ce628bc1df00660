#include "gui/appearance/captions.h"

#include <gtest/gtest.h>

namespace palpate::gui::captions_test {
namespace {

// The library names commands and options; the window names its own menus.
TEST(Captions, MessagesNameMenusInsteadOfCommands) {
  EXPECT_EQ(inWindowWords("a.dsa: is cut; 'palpate recover' may save what is left"),
            "a.dsa: is cut; File > Recover… may save what is left");
  EXPECT_EQ(inWindowWords("a.csv: exists already; give another name, or --force to replace it"),
            "a.csv: exists already; choose another name");
  EXPECT_EQ(inWindowWords("import its tables ('palpate import')"),
            "import its tables (File > Import…)");
  EXPECT_EQ(inWindowWords("as x, y, z of each taxel; --components planar: all x, then all y"),
            "as x, y, z of each taxel; choose another order under Components: all x, then all y");
  EXPECT_EQ(inWindowWords("nothing to change"), "nothing to change");
}

TEST(Captions, ACountHasTheNumberOfItsNoun) {
  EXPECT_EQ(numberOf(0, "frame"), "0 frames");
  EXPECT_EQ(numberOf(1, "frame"), "1 frame");
  EXPECT_EQ(numberOf(2, "frame"), "2 frames");
}

}  // namespace
}  // namespace palpate::gui::captions_test
