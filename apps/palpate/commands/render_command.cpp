// palpate render FILE --frame N -o OUT.{png,svg,pdf}: a picture of one frame.
#include <QGuiApplication>
#include <cstdio>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/filter/characteristic_signals.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/display.h"
#include "commands/picture_size.h"
#include "gui/picture_export.h"

namespace palpate::commands {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> colorMapNames() {
  std::vector<std::string> names;
  for (gui::ColorMapName map : gui::kAllColorMaps) names.emplace_back(gui::nameOf(map));
  return names;
}

// "MIN,MAX"
void parseRange(const std::string& text, gui::MatricesPictureOptions& options) {
  const auto comma = text.find(',');
  if (comma != std::string::npos) {
    const auto least = parseDouble(text.substr(0, comma));
    const auto most = parseDouble(text.substr(comma + 1));
    if (least && most && *least < *most) {
      options.rangeMin = *least;
      options.rangeMax = *most;
      return;
    }
  }
  throw UsageError("--range must be MIN,MAX with MIN below MAX, not '" + text + "'");
}

std::size_t chosenFrame(const CommandLine& given, const std::string& file, const Profile& profile) {
  if (profile.numFrames() == 0) throw Error(file + ": has no frame to draw");
  const auto frame = given.integer("frame", 0, INT64_MAX);
  if (!frame) return SignalTable::of(profile).frameOfLargestSum();
  if (static_cast<std::uint64_t>(*frame) >= profile.numFrames())
    throw Error(file + ": has no frame " + std::to_string(*frame) + ", only 0.." +
                std::to_string(profile.numFrames() - 1));
  return static_cast<std::size_t>(*frame);
}

}  // namespace

int renderCommand(const Words& words) {
  const CommandLine given(
      {.synopsis = "palpate render FILE [--frame N] -o OUT.{png,svg,pdf}",
       .purpose =
           "Draws the heat maps of one frame. The ending of OUT chooses the form; SVG and PDF "
           "are vector\ngraphics with text as text.",
       .options = {{"frame", "N", "default: the frame of largest sum"},
                   {"output,o", "OUT", "where to write the picture"},
                   {"view", "matrices", "what to draw; default matrices"},
                   {"size",
                    "WxH",
                    "in pixels (96 per inch), default 900x720; PNG has twice as many"},
                   {"map",
                    "NAME",
                    "colour map: inferno (default), viridis, magma, plasma, cividis, "
                    "turbo, grey"},
                   {"range",
                    "MIN,MAX",
                    "counts of the lowest and the highest colour; default 0 to "
                    "the frame's maximum"},
                   {"interpolated", "", "smooth between the taxels"},
                   {"values", "", "print the value of every active taxel"},
                   {"theme", "dark|light", "default light"},
                   {"force", "", "replace OUT"}},
       .example = "palpate render foam_ball.dsa --frame 2411 -o frame.svg --values",
       .fewestWords = 1,
       .mostWords = 1},
      words);
  if (given.helpShown()) return kDone;
  const auto out = given.text("output");
  if (!out) throw UsageError("render needs -o OUT.png, OUT.svg or OUT.pdf");
  if (!gui::pictureFormOf(*out))
    throw UsageError("the picture's name must end in .png, .svg or .pdf, not '" + *out + "'");
  given.choice("view", {"matrices"});
  gui::MatricesPictureOptions options;
  if (const auto size = given.text("size")) options.size = parsedSize(*size);
  if (const auto map = given.choice("map", colorMapNames())) options.map = *gui::colorMapFrom(*map);
  if (const auto range = given.text("range")) parseRange(*range, options);
  options.interpolated = given.has("interpolated");
  options.values = given.has("values");
  options.theme = given.choice("theme", {"dark", "light"}).value_or("light") == "dark"
                      ? gui::Theme::kDark
                      : gui::Theme::kLight;
  const Overwrite overwrite = given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse;

  const std::string& file = given.words()[0];
  const Profile profile = [&] {
    ProgressLine progress("reading " + file, given.quiet());
    return openRecording(file, progress.callback());
  }();
  const std::size_t frame = chosenFrame(given, file, profile);
  const double seconds =
      static_cast<double>(profile.frameTimeUs(frame) - profile.frameTimeUs(0)) * 1e-6;
  options.title = QString::fromStdString(fs::path(file).filename().string());
  options.caption = QString::fromStdString("frame " + std::to_string(frame) + " of " +
                                           std::to_string(profile.numFrames()) + ", " +
                                           fixedText(seconds, 2) + " s");

  drawWithoutDisplay(true);
  std::string name = "palpate";
  char* arguments[] = {name.data(), nullptr};
  int count = 1;
  const RuntimeFolder runtime;
  const QGuiApplication application(count, arguments);
  options.font = QGuiApplication::font();
  gui::writeMatricesPicture(*out, profile.frame(frame), profile.hand(), options, overwrite);
  if (!given.quiet()) std::printf("%s: frame %zu\n", out->c_str(), frame);
  return kDone;
}

}  // namespace palpate::commands
