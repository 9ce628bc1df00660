// Starts the window, or takes a picture of it; called by the commands of the program.
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

// kFast: OpenGL only with a graphics card; kAlways: also where the processor emulates it, without
// the probe in another process.
enum class OpenGlChoice { kFast, kAlways, kNever };

struct WindowOptions {
  // Files to open; the first one is shown.
  std::vector<std::filesystem::path> files;
  // Connect to the emulated hand with the demo scene.
  bool demo = false;
  // Folder of the program's data.
  std::filesystem::path dataFolder;
  // OpenGL for the hand in 3-D.
  OpenGlChoice openGl = OpenGlChoice::kFast;
  // Joint angles assumed for recordings that have none [deg]; empty: none.
  std::vector<double> assumedAnglesDeg = {};
  // Recipe to switch on; nothing: that of the last session.
  std::optional<Recipe> recipe = {};
  // Path of the socket of the remote control; nothing: it is off until the user switches it on.
  std::optional<std::filesystem::path> remote = {};
};

// Shows the window and runs the event loop until it is closed. Returns the exit code. Creates a
// QApplication unless there is one. Needs a display (or a QT_QPA_PLATFORM that needs none).
int runWindow(int& argc, char** argv, const WindowOptions& options);

struct ScreenshotOptions {
  // Path of the PNG.
  std::filesystem::path out;
  // Size of the window [px].
  QSize size{1600, 1000};
  // Frame to show; default: the frame of largest sum.
  std::optional<std::size_t> frame;
  // Time to play before the picture [s].
  double afterS = 0.0;
  // Names of the docks to show; empty: the default ones.
  std::vector<std::string> docks;
  // What is pressed before the picture.
  std::vector<ScreenshotPress> presses = {};
  // INI file with which the window starts; it isn't changed.
  std::optional<std::filesystem::path> settings = {};
  std::string theme = "dark";  // "dark" or "light"
  // Recording to show; nothing: the start page, or the demo.
  std::optional<std::filesystem::path> file;
  // Shows the comparison of `file` (A) with this recording (B).
  std::optional<std::filesystem::path> comparedWith;
  // Connect to the emulated hand with the demo scene.
  bool demo = false;
  // Folder of the program's data.
  std::filesystem::path dataFolder;
  // Replaces `out` when it exists.
  bool force = false;
  // As in WindowOptions.
  bool openGl = true;
  // As in WindowOptions.
  std::vector<double> assumedAnglesDeg = {};
  std::optional<Recipe> recipe = {};
};

// Shows the real window, saves a picture of it (or of the dialogue that is open in the end) and
// closes it; the user's settings are neither read nor changed. Returns the exit code 0. Throws
// Error (leaves included) for a recording that can't be read, a frame or dock that doesn't exist, a
// press that finds nothing, an unknown theme, or a file that can't be written.
int takeScreenshot(int& argc, char** argv, const ScreenshotOptions& options);

}  // namespace palpate::gui
