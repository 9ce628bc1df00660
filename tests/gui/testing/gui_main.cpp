// Runs the tests of the window: under the display that is there, else drawing to memory. Settings
// go to a temporary folder.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "gui/desktop/application.h"
#include "gui/source/abandonable.h"
#include "gui/testing/thrown_at_events.h"
#include "testing/test_run.h"
#include "testing/test_selection.h"
#include "testing/testing.h"

int main(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc + 1);
  try {
    // Without a test to run no window system is asked for anything.
    if (!palpate::testing::selectTests(argc, argv)) return RUN_ALL_TESTS();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  const palpate::testing::TemporaryFolder home;
  for (const char* variable :
       {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME", "XDG_CACHE_HOME", "XDG_RUNTIME_DIR"})
    ::setenv(variable, home.path().c_str(), 1);
  // A variable that is set but empty says nothing.
  const auto says = [](const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value;
  };
  if (!says("DISPLAY") && !says("WAYLAND_DISPLAY") && !says("QT_QPA_PLATFORM"))
    ::setenv("QT_QPA_PLATFORM", "offscreen", 1);
  const auto application = palpate::gui::makeApplication(argc, argv);
  ::testing::UnitTest::GetInstance()->listeners().Append(new palpate::testing::ThrownAtEvents);
  const int result = palpate::testing::runTests(arguments.data());
  // No thread may see the application being destroyed.
  palpate::gui::Abandonable::awaitThreads(std::chrono::seconds(20));
  return result;
}
