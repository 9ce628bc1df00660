// The long form of R18 with the window open: a thousand times Escape.
#include "gui/hand/stop_in_the_window.h"
#include "testing/testing.h"

namespace palpate::gui::live_safety_slow_test {
namespace {

TEST(LiveSafetyLong, EscapeAtAThousandRandomMomentsIsOnTheWireWithinTwentyMilliseconds) {
  escapeAtRandomMoments(1000, 400'000);
}

}  // namespace
}  // namespace palpate::gui::live_safety_slow_test
