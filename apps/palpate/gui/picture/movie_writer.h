// A movie of frames, as MP4, by the program ffmpeg.
#pragma once

#include <cstddef>
#include <filesystem>

#include <palpate/capture/movie_timing.h>
#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>

#include "gui/picture/exported_view.h"
#include "gui/picture/picture_export.h"

namespace palpate::gui {

// What a movie shows, and when.
struct Movie {
  FrameSpan frames;
  MovieTiming timing;  // its frames count from frames.first
  double picturesPerS = 30.0;
};
// timeUs: stamp of a frame [us]; asked for all of the span. Throws std::invalid_argument (options),
// Cancelled.
Movie plannedMovie(const FrameSpan& frames,
                   const FramePictures::TimeUs& timeUs,
                   const MovieOptions& options,
                   const Progress& progress = {});

// A PNG's pixels made even, as the coding of colours needs it: up to a row and a column more, of
// background.
QSize moviePixels(const PicturePaper& paper);

// Paints each frame once, however many pictures show it. The file is whole or not there: until it
// is whole it has no name. Needs a QGuiApplication; may run in any thread. Throws FileError: exists
// already, no ffmpeg, what ffmpeg says; Cancelled.
void writeMovie(const std::filesystem::path& path,
                const Movie& movie,
                const FramePictures::Paint& paint,
                const PicturePaper& paper,
                Overwrite overwrite = Overwrite::kRefuse,
                const Progress& progress = {});

}  // namespace palpate::gui
