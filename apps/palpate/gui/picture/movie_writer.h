// Writes frames of a recording as an MP4 movie, with the program ffmpeg.
#pragma once

#include <cstddef>
#include <filesystem>

#include <palpate/core/output_file.h>
#include <palpate/core/progress.h>
#include <palpate/playback/movie_timing.h>

#include "gui/picture/exported_view.h"
#include "gui/picture/picture_export.h"

namespace palpate::gui {

// The frames of a movie and their times.
struct Movie {
  FrameSpan frames;
  // Its frame indices count from frames.first.
  MovieTiming timing;
  double picturesPerS = 30.0;
};
// Plans a movie. timeUs: time stamp of a frame [us], called for every frame of the span. Throws
// std::invalid_argument (options), Cancelled.
Movie plannedMovie(const FrameSpan& frames,
                   const FramePictures::TimeUs& timeUs,
                   const MovieOptions& options,
                   const Progress& progress = {});

// Size of the movie [pixels]: that of a PNG, made even by up to one row and one column of
// background, because the chroma coding needs even sizes.
QSize moviePixels(const PicturePaper& paper);

// Writes the movie; each frame is painted once, even if several pictures show it. The file is
// complete or doesn't exist: it gets its name only at the end. Needs a QGuiApplication; may run in
// any thread. Throws FileError: the file exists already, ffmpeg is missing or reports an error;
// Cancelled.
void writeMovie(const std::filesystem::path& path,
                const Movie& movie,
                const FramePictures::Paint& paint,
                const PicturePaper& paper,
                Overwrite overwrite = Overwrite::kRefuse,
                const Progress& progress = {});

}  // namespace palpate::gui
