#include "gui/picture/movie_writer.h"

#include <span>
#include <string>
#include <vector>

#include <sys/stat.h>

#include <palpate/core/child_program.h>
#include <palpate/core/error.h>

#include "gui/picture/ffmpeg.h"

namespace palpate::gui {
namespace fs = std::filesystem;
namespace {

std::string endOf(int exitCode) {
  constexpr int kKilled = 128;
  return exitCode > kKilled ? "it was ended by signal " + std::to_string(exitCode - kKilled)
                            : "it ended with code " + std::to_string(exitCode);
}

[[noreturn]] void throwFailed(const fs::path& path, int exitCode, const std::string& said) {
  const std::string line = lastError(said);
  throw FileError(path,
                  "ffmpeg could not make the movie: " + (line.empty() ? endOf(exitCode) : line));
}

bool isEmpty(int descriptor) {
  struct stat facts {};
  return ::fstat(descriptor, &facts) != 0 || facts.st_size == 0;
}

// The same paper with an even number of pixels in both directions.
PicturePaper evenPaper(const PicturePaper& paper) {
  PicturePaper even = paper;
  even.size = QSizeF(moviePixels(paper)) / paper.scale();
  return even;
}

std::span<const std::byte> bytesOf(const QImage& image) {
  return std::as_bytes(std::span(image.constBits(), static_cast<std::size_t>(image.sizeInBytes())));
}

}  // namespace

Movie plannedMovie(const FrameSpan& frames,
                   const FramePictures::TimeUs& timeUs,
                   const MovieOptions& options,
                   const Progress& progress) {
  constexpr std::size_t kAskAfter = 4096;
  std::vector<std::int64_t> stampsUs;
  stampsUs.reserve(frames.count());
  for (std::size_t frame = frames.first; frame <= frames.last; ++frame) {
    if (progress && stampsUs.size() % kAskAfter == 0 && !progress(0.0)) throw Cancelled();
    stampsUs.push_back(timeUs(frame));
  }
  return {.frames = frames,
          .timing = movieTiming(stampsUs, options),
          .picturesPerS = options.picturesPerS};
}

QSize moviePixels(const PicturePaper& paper) {
  const QSize pixels = paper.pixels();
  return {pixels.width() + pixels.width() % 2, pixels.height() + pixels.height() % 2};
}

void writeMovie(const fs::path& path,
                const Movie& movie,
                const FramePictures::Paint& paint,
                const PicturePaper& paper,
                Overwrite overwrite,
                const Progress& progress) {
  const auto ffmpeg = findFfmpeg();
  if (!ffmpeg) throw FileError(path, ffmpegMissing());
  OutputFile file(path, overwrite);
  double done = 0.0;
  const auto keepGoing = [&] { return !progress || progress(done); };
  const QSize size = moviePixels(paper);
  const std::string encoder = encoderOf(*ffmpeg, keepGoing);
  ChildProgram program(
      *ffmpeg,
      ffmpegArguments(encoder, size, movie.picturesPerS, paper.title.toStdString()),
      {file.descriptor()});
  const PicturePaper even = evenPaper(paper);
  std::size_t shown = 0;
  for (const MovieFrame& shot : movie.timing.shots) {
    if (!keepGoing()) throw Cancelled();
    const std::size_t frame = movie.frames.first + shot.frame;
    const QImage image = pictureImage([&](QPainter& painter) { paint(painter, frame); }, even);
    if (image.isNull()) throw FileError(path, "not enough memory for a picture of this size");
    for (std::size_t i = 0; i < shot.numPictures; ++i) {
      if (!program.write(bytesOf(image), keepGoing))
        throwFailed(path, program.finish(keepGoing), program.said());
      ++shown;
      done = static_cast<double>(shown) / static_cast<double>(movie.timing.numPictures + 1);
    }
  }
  const int exitCode = program.finish(keepGoing);
  if (exitCode != 0) throwFailed(path, exitCode, program.said());
  if (isEmpty(file.descriptor())) throw FileError(path, "ffmpeg wrote nothing, and didn't say why");
  file.commit();
  if (progress) progress(1.0);
}

}  // namespace palpate::gui
