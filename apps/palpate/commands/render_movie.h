// `palpate render .. -o OUT.mp4`: writes a movie of the frames.
#pragma once

#include <filesystem>

#include "palpate/core/output_file.h"
#include "palpate/core/progress.h"
#include "palpate/model/profile.h"

#include "commands/command_line.h"
#include "gui/picture/exported_view.h"
#include "gui/picture/movie_writer.h"
#include "gui/picture/picture_export.h"

namespace palpate::commands {

// Whether the ending is that of a movie, in small or capital letters.
bool isMovieName(const std::string& out);
// Checks the options without reading a file. Throws UsageError for --speed or --fps without a
// movie, and for --frame with one.
void checkMovieUsage(const CommandLine& given);
// Throws Error when ffmpeg is missing, or when OUT exists already or cannot be a file.
void requireMovie(const std::string& out, Overwrite overwrite);

// Writes the movie with the options --speed and --fps. Throws as gui::writeMovie().
gui::Movie writeChosenMovie(const MovieOptions& options,
                            const std::filesystem::path& out,
                            const Profile& profile,
                            const gui::FrameSpan& span,
                            const gui::FramePictures::Paint& paint,
                            const gui::PicturePaper& paper,
                            Overwrite overwrite,
                            const Progress& progress);
// The same with its progress on standard error; returns the exit code. Throws Error.
int drawMovie(const CommandLine& given,
              const MovieOptions& options,
              const Profile& profile,
              const gui::FrameSpan& span,
              const gui::FramePictures::Paint& paint,
              const gui::PicturePaper& paper,
              Overwrite overwrite);

}  // namespace palpate::commands
