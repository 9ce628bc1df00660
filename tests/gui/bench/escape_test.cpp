// Escape leaves one thing at a time, the most urgent first.
#include "gui/bench/escape.h"

#include <string>

#include "testing/testing.h"

namespace palpate::gui::escape_test {
namespace {

TEST(EscapeTest, LeavesTheMostUrgentThingThatIsThere) {
  Escape escape;
  bool busy = true, full = true;
  std::string left;
  const auto leave = [&](bool& state, const char* name) {
    return [&state, &left, name] {
      if (!state) return false;
      state = false;
      left += name;
      return true;
    };
  };
  escape.add(Escape::Order::kFullScreen, leave(full, "full screen;"));
  escape.add(Escape::Order::kWork, leave(busy, "work;"));
  escape.press();
  EXPECT_EQ(left, "work;");
  escape.press();
  EXPECT_EQ(left, "work;full screen;");
  escape.press();
  EXPECT_EQ(left, "work;full screen;") << "nothing is left to leave";
}

TEST(EscapeTest, OfTheSameOrderTheFirstThatWasAdded) {
  Escape escape;
  std::string asked;
  for (const char* name : {"a", "b", "c"})
    escape.add(Escape::Order::kComputation, [&asked, name] {
      asked += name;
      return asked == "ab";
    });
  escape.press();
  EXPECT_EQ(asked, "ab");
}

}  // namespace
}  // namespace palpate::gui::escape_test
