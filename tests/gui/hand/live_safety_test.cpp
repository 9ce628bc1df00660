// The hand stays safe whatever the window does.

#include "gui/hand/stop_in_the_window.h"
#include "testing/testing.h"

namespace palpate::gui::live_safety_test {
namespace {

TEST(LiveSafety, EscapeAtRandomMomentsIsOnTheWireWithinTwentyMilliseconds) {
  escapeAtRandomMoments(15, 400'000);
}

}  // namespace
}  // namespace palpate::gui::live_safety_test
