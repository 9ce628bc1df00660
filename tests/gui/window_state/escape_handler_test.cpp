// Escape leaves one thing at a time, the most urgent first.
#include "gui/window_state/escape_handler.h"

#include <string>

#include "testing/testing.h"

namespace palpate::gui::escape_handler_test {
namespace {

TEST(EscapeHandlerTest, LeavesTheMostUrgentThingThatIsThere) {
  EscapeHandler escapeHandler;
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
  escapeHandler.add(EscapeHandler::Order::kFullScreen, leave(full, "full screen;"));
  escapeHandler.add(EscapeHandler::Order::kWork, leave(busy, "work;"));
  escapeHandler.press();
  EXPECT_EQ(left, "work;");
  escapeHandler.press();
  EXPECT_EQ(left, "work;full screen;");
  escapeHandler.press();
  EXPECT_EQ(left, "work;full screen;") << "nothing is left to leave";
}

TEST(EscapeHandlerTest, OfTheSameOrderTheFirstThatWasAdded) {
  EscapeHandler escapeHandler;
  std::string asked;
  for (const char* name : {"a", "b", "c"})
    escapeHandler.add(EscapeHandler::Order::kComputation, [&asked, name] {
      asked += name;
      return asked == "ab";
    });
  escapeHandler.press();
  EXPECT_EQ(asked, "ab");
}

}  // namespace
}  // namespace palpate::gui::escape_handler_test
