// The window's front door: what the program's main and its commands call.
#pragma once

#include <QSize>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <palpate/filter/recipe.h>

#include "gui/shell/screenshot_presses.h"

namespace palpate::gui {

// kFast: where a graphics card has it; kAlways: where the processor draws it, too, without asking
// first.
enum class OpenGlChoice { kFast, kAlways, kNever };

struct WindowOptions {
  std::vector<std::filesystem::path> files;   // to open; the first one is shown
  bool demo = false;                          // play the demo recording of dataFolder, looping
  std::filesystem::path dataFolder;           // the program's own data
  OpenGlChoice openGl = OpenGlChoice::kFast;  // for the hand in space
  std::vector<double> assumedAnglesDeg = {};  // of recordings without joint angles; empty: none
  std::optional<Recipe> recipe = {};          // to look through; nothing: what was there last
  // Remote control is on, at this socket; nothing: off until it is switched on.
  std::optional<std::filesystem::path> remote = {};
};

// Shows the window and runs the event loop until it is closed. Returns the exit code. A
// QApplication is made unless there is one. Needs a display (or a QT_QPA_PLATFORM that does
// without).
int runWindow(int& argc, char** argv, const WindowOptions& options);

struct ScreenshotOptions {
  std::filesystem::path out;                  // PNG
  QSize size{1600, 1000};                     // of the window [px]
  std::optional<std::size_t> frame;           // default: the frame of largest sum
  double afterS = 0.0;                        // let it play for so long first [s]
  std::vector<std::string> docks;             // to show, by name; empty: the usual ones
  std::vector<ScreenshotPress> presses = {};  // before the picture
  // INI file the window starts with; it stays as it is
  std::optional<std::filesystem::path> settings = {};
  std::string theme = "dark";  // "dark" or "light"
  std::optional<std::filesystem::path> file;
  std::optional<std::filesystem::path> comparedWith;  // show Compare, `file` as A and this as B
  bool demo = false;
  std::filesystem::path dataFolder;
  bool force = false;                         // replace `out` when it exists
  bool openGl = true;                         // as WindowOptions
  std::vector<double> assumedAnglesDeg = {};  // as WindowOptions
  std::optional<Recipe> recipe = {};
};

// Shows the real window, saves its picture (of the dialogue, where one is open in the end) and
// closes it; the user's settings are neither used nor changed. Returns the exit code 0. Throws
// Error (leaves included) for a recording that can't be read, a frame or dock that isn't there,
// nothing to press, an unknown theme, or a file that can't be written.
int takeScreenshot(int& argc, char** argv, const ScreenshotOptions& options);

}  // namespace palpate::gui
