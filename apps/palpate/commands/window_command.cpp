// The command without a name, `palpate [FILE...]`, also with --demo or --screenshot, starts the
// window.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "palpate/core/error.h"
#include "palpate/model/hand_file.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/display.h"
#include "commands/filter_options.h"
#include "commands/hand_options.h"
#include "commands/picture_size.h"
#include "commands/remote_recording.h"
#include "gui/appearance/theme.h"
#include "gui/hand3d/gl_probe.h"
#include "gui/shell/run_window.h"

namespace palpate::commands {
namespace {

// The filters of the options; nothing when there are none, and the window then uses those of its
// last run.
std::optional<Recipe> filtersOf(const CommandLine& given) {
  Recipe recipe = recipeOf(given);
  return recipe.steps.empty() ? std::nullopt : std::optional(std::move(recipe));
}

constexpr OptionRange kAfterS{0.0, 3600.0, "s"};
constexpr QSize kSmallestWindow{800, 500};

// The angles of --angles, of the hand of --hand.
std::vector<double> assumedAnglesOf(const CommandLine& given) {
  return anglesOf(given, handOf(given).value_or(defaultHand())).value_or(std::vector<double>());
}

int screenshot(const CommandLine& given) {
  gui::ScreenshotOptions options;
  options.out = *given.text("screenshot");
  if (const auto size = given.text("size")) options.size = parsedSize(*size, kSmallestWindow);
  if (const auto frame = given.integer("frame", kFrameOption))
    options.frame = static_cast<std::size_t>(*frame);
  options.afterS = given.number("after", kAfterS).value_or(0.0);
  options.docks = given.texts("dock");
  for (const std::string& text : given.texts("press"))
    options.presses.push_back(gui::parsedPress(text));
  if (const auto settings = given.text("settings")) options.settings = *settings;
  options.theme = given.text("theme").value_or("dark");
  options.demo = given.has("demo");
  options.dataFolder = dataFolder();
  options.force = given.has("force");
  options.openGl = !given.has("no-gl");
  options.assumedAnglesDeg = assumedAnglesOf(given);
  options.recipe = filtersOf(given);
  if (options.out.extension() != ".png")
    throw UsageError("--screenshot: the picture's name must end in .png, not '" +
                     options.out.string() + "'");
  if (given.words().size() > 2)
    throw UsageError("--screenshot takes one FILE, or two that are compared");
  if (!given.words().empty()) options.file = given.words()[0];
  if (given.words().size() > 1) options.comparedWith = given.words()[1];
  if (options.demo && options.file) throw UsageError("give FILE or --demo, not both");
  if (options.demo && options.frame)
    throw UsageError("--frame needs a FILE: a demo has no frames yet");
  if (!options.demo && !options.file && (options.frame || given.has("after") || given.has("dock")))
    throw UsageError("--frame, --after and --dock need a FILE or --demo");
  const RuntimeFolder runtime;
  if (!hasDisplay()) drawWithoutDisplay();
  std::string name = "palpate";
  char* arguments[] = {name.data(), nullptr};
  int count = 1;
  return gui::takeScreenshot(count, arguments, options);
}

// Tests OpenGL. The window runs this in another process of this program, because drivers may crash;
// it is not listed in the help.
int probeOpenGl() {
  const RuntimeFolder runtime;
  if (!hasDisplay()) {
    std::puts("there is no display");
    return kFailed;
  }
  std::string name = "palpate";
  char* arguments[] = {name.data(), nullptr};
  int count = 1;
  return gui::answerOpenGlProbe(count, arguments);
}

}  // namespace

int windowCommand(const Arguments& words) {
  if (words == Arguments{"--probe-opengl"}) return probeOpenGl();
  const CommandLine given(
      {.synopsis = "palpate [FILE...] | palpate --demo | palpate --screenshot OUT.png ..",
       .purpose = "Opens the window: on recordings, on a demonstration, or on its start page.",
       .options =
           {{"demo", "", "open on the emulated hand, which grasps a ball"},
            {"screenshot", "OUT.png", "save a picture of the window and exit"},
            {"size", "WxH", "with --screenshot: size in pixels, default 1600x1000"},
            rangedWhole(
                "frame", "N", "with --screenshot", kFrameOption, "the frame of largest sum"),
            ranged("after", "S", "with --screenshot: let the source play first", kAfterS, "0"),
            {"dock",
             "NAME",
             "with --screenshot: show this dock ('Calibrate/Noise': a page of it); may be "
             "repeated"},
            {"press",
             "KEY[@S]",
             "with --screenshot: press a key listed under F1, or the button with this text, S "
             "seconds after the window shows its content; may be repeated. If that opens a "
             "dialogue, the picture shows the dialogue"

            },
            {"settings", "INI", "with --screenshot: settings file of the window; it isn't changed"},
            worded("theme", "NAME", "with --screenshot", gui::kThemeWords, "dark"),
            {"gl", "", "draw the hand in 3-D with OpenGL, even by the processor"},
            {"no-gl", "", "draw the hand in 3-D without OpenGL"},
            {"angles", "A0,A1,..", "joint angles [deg; mm] assumed for recordings without any"},
            {"hand", "NAME|FOLDER", "the hand that --angles are of; default the SDH-2"},
            {"filter", "SPEC", "show filtered, as median:size=3; may be repeated"},
            {"recipe", "R.json", "show filtered with a recipe"},
            remoteOption(),
            socketOption(),
            {"force", "", "with --screenshot: replace OUT.png"}},
       .example = "palpate foam_ball.dsa"},
      words);
  if (given.helpShown()) return kDone;
  if (given.has("screenshot")) return screenshot(given);
  for (const char* option :
       {"size", "frame", "after", "dock", "press", "settings", "theme", "force"})
    if (given.has(option)) throw UsageError("--" + std::string(option) + " needs --screenshot");
  if (given.has("demo") && !given.words().empty())
    throw UsageError("give FILE or --demo, not both");
  if (given.has("socket") && !given.has("remote")) throw UsageError("--socket needs --remote");
  if (given.has("gl") && given.has("no-gl")) throw UsageError("give --gl or --no-gl, not both");
  const std::vector<double> assumed = assumedAnglesOf(given);
  const auto filters = filtersOf(given);
  if (!hasDisplay())
    throw Error("no display: run it on a desktop, or use a command ('palpate --help' lists them)");
  // Must be determined before RuntimeFolder sets a temporary folder.
  std::optional<std::filesystem::path> remote;
  if (given.has("remote")) remote = remoteSocketOf(given);
  const RuntimeFolder runtime;
  gui::WindowOptions options;
  options.files.assign(given.words().begin(), given.words().end());
  options.demo = given.has("demo");
  options.dataFolder = dataFolder();
  options.openGl = given.has("no-gl") ? gui::OpenGlChoice::kNever
                   : given.has("gl")  ? gui::OpenGlChoice::kAlways
                                      : gui::OpenGlChoice::kFast;
  options.assumedAnglesDeg = assumed;
  options.recipe = filters;
  options.remote = remote;
  std::string name = "palpate";
  char* arguments[] = {name.data(), nullptr};
  int count = 1;
  return gui::runWindow(count, arguments, options);
}

}  // namespace palpate::commands
