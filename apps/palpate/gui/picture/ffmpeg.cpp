#include "gui/picture/ffmpeg.h"

#include <QFileInfo>
#include <QStandardPaths>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include <palpate/core/error.h>
#include <palpate/core/escaped_line.h>
#include <palpate/core/number_text.h>

namespace palpate::gui {
namespace fs = std::filesystem;
namespace {

constexpr const char* kVariable = "PALPATE_FFMPEG";

// The value of $PALPATE_FFMPEG; empty: not set.
std::string chosenByHand() {
  const char* value = std::getenv(kVariable);
  return value ? value : "";
}

std::string outputName() { return "/proc/self/fd/" + std::to_string(ChildProgram::kPassedAs); }

}  // namespace

std::optional<fs::path> findFfmpeg() {
  if (const std::string chosen = chosenByHand(); !chosen.empty()) {
    const QFileInfo file(QString::fromStdString(chosen));
    if (!file.isFile() || !file.isExecutable()) return std::nullopt;
    return fs::absolute(chosen);
  }
  const QString found = QStandardPaths::findExecutable("ffmpeg");
  if (found.isEmpty()) return std::nullopt;
  return fs::path(found.toStdString());
}

std::string ffmpegMissing() {
  if (const std::string chosen = chosenByHand(); !chosen.empty())
    return std::string(kVariable) + " doesn't name a program: " + chosen;
  return "A movie needs the program ffmpeg, which isn't installed (sudo apt install ffmpeg). A PNG "
         "of each frame works without it.";
}

// Lines " V....D libx264    libx264 H.264 / AVC ..": six flags, then the name.
std::string encoderFrom(const std::string& printed) {
  std::string best;
  std::istringstream lines(printed);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string flags, name;
    words >> flags >> name;
    if (flags.empty() || flags.front() != 'V') continue;
    if (name == "libx264") return name;
    if (name == "mpeg4") best = name;
  }
  return best;
}

std::string encoderOf(const fs::path& ffmpeg, const ChildProgram::KeepGoing& keepGoing) {
  ChildProgram program(ffmpeg, {"-nostdin", "-hide_banner", "-encoders"});
  const int exitCode = program.finish(keepGoing);
  std::string encoder = encoderFrom(program.said());
  if (encoder.empty()) {
    const std::string line = exitCode == 0 ? std::string() : lastError(program.said());
    throw Error(ffmpeg.string() + " has neither the encoder libx264 nor mpeg4" +
                (line.empty() ? std::string() : ": " + line));
  }
  return encoder;
}

std::vector<std::string> ffmpegArguments(const std::string& encoder,
                                         const QSize& size,
                                         double picturesPerS,
                                         const std::string& title) {
  std::vector<std::string> words = {
      "-nostdin",
      "-hide_banner",
      "-nostats",
      "-loglevel",
      "error",
      "-y",
      "-f",
      "rawvideo",
      "-pix_fmt",
      "bgr0",
      "-s",
      std::to_string(size.width()) + "x" + std::to_string(size.height()),
      "-r",
      numberText(picturesPerS),
      "-i",
      "pipe:0",
      "-an",
      "-vf",
      "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+"
      "full_chroma_int+bicubic",
      "-c:v",
      encoder};
  const auto add = [&](std::initializer_list<const char*> more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  // Quality at which no difference is visible.
  if (encoder == "libx264")
    // "veryfast" takes a fifth less time than "medium" and its files are no larger.
    add({"-preset", "veryfast", "-crf", "18"});
  else
    add({"-q:v", "2"});
  add({"-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709"});
  add({"-color_trc", "bt709", "-color_range", "tv", "-movflags", "+faststart"});
  if (!title.empty()) {
    add({"-metadata"});
    words.push_back("title=" + title);
  }
  add({"-f", "mp4"});
  words.push_back(outputName());
  return words;
}

std::string lastError(const std::string& said) {
  std::string last;
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);) {
    const std::string_view words = trimmed(line, " \t\r");
    // "Conversion failed!" doesn't tell the cause.
    if (!words.empty() && words != "Conversion failed!") last = words;
  }
  // ffmpeg knows the movie only by its descriptor.
  const std::string name = outputName();
  if (const auto at = last.find(name); at != std::string::npos)
    last.replace(at, name.size(), "the movie");
  return last;
}

}  // namespace palpate::gui
