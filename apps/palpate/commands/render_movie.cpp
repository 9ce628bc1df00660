#include "commands/render_movie.h"

#include <cstdio>
#include <filesystem>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/file_name.h"
#include "palpate/core/interruption.h"
#include "palpate/core/number_text.h"

#include "commands/commands.h"
#include "gui/picture/ffmpeg.h"
#include "gui/picture/movie_writer.h"

namespace palpate::commands {
namespace {

void printMovie(const std::string& out, const gui::Movie& movie) {
  std::printf("%s: %s s, %zu pictures, frames %zu..%zu",
              escapedLine(out).c_str(),
              fixedText(movie.timing.seconds, 1).c_str(),
              movie.timing.numPictures,
              movie.frames.first,
              movie.frames.last);
  if (movie.timing.numGaps > 0)
    std::printf("; gaps shortened: %zu, by %s s",
                movie.timing.numGaps,
                fixedText(movie.timing.shortenedS, 1).c_str());
  std::printf("\n");
}

}  // namespace

bool isMovieName(const std::string& out) { return lowerEndingOf(out) == ".mp4"; }

void checkMovieUsage(const CommandLine& given) {
  const bool isMovie = isMovieName(given.text("output").value_or(""));
  if (isMovie && given.has("frame"))
    throw UsageError("a movie has many frames: give --from and --to, not --frame");
  for (const char* name : {"speed", "fps"})
    if (given.has(name) && !isMovie)
      throw UsageError("--" + std::string(name) + " needs a movie: -o OUT.mp4");
}

void requireMovie(const std::string& out, Overwrite overwrite) {
  if (!gui::findFfmpeg()) throw Error(gui::ffmpegMissing());
  requireWritable(out, overwrite);
}

gui::Movie writeChosenMovie(const MovieOptions& options,
                            const std::filesystem::path& out,
                            const Profile& profile,
                            const gui::FrameSpan& span,
                            const gui::FramePictures::Paint& paint,
                            const gui::PicturePaper& paper,
                            Overwrite overwrite,
                            const Progress& progress) {
  const auto timeUs = [&](std::size_t frame) { return profile.frameTimeUs(frame); };
  const gui::Movie movie = gui::plannedMovie(span, timeUs, options, progress);
  gui::writeMovie(out, movie, paint, paper, overwrite, progress);
  return movie;
}

int drawMovie(const CommandLine& given,
              const MovieOptions& options,
              const Profile& profile,
              const gui::FrameSpan& span,
              const gui::FramePictures::Paint& paint,
              const gui::PicturePaper& paper,
              Overwrite overwrite) {
  const std::string out = *given.text("output");
  Interruption interruption;
  gui::Movie movie;
  try {
    ProgressLine progress("drawing", given.quiet());
    const Progress show = progress.callback();
    const auto goOn = [&](double fraction) {
      return !interruption.waitForSignal(0) && (!show || show(fraction));
    };
    movie = writeChosenMovie(options, out, profile, span, paint, paper, overwrite, goOn);
  } catch (const Cancelled&) {
    sayLine("interrupted: " + out + " was not written");
    return kPartlyDone;
  }
  if (!given.quiet()) printMovie(out, movie);
  return kDone;
}

}  // namespace palpate::commands
