// palpate render .. -o OUT.mp4: a movie of the frames.
#pragma once

#include "palpate/core/output_file.h"
#include "palpate/model/profile.h"

#include "commands/command_line.h"
#include "gui/picture/exported_view.h"
#include "gui/picture/picture_export.h"

namespace palpate::commands {

// By the ending, in small or capital letters.
bool isMovieName(const std::string& out);
// What can be said without any file. Throws UsageError: --speed or --fps without a movie, --frame
// with one.
void checkMovieUsage(const CommandLine& given);
// Throws Error: no ffmpeg, OUT is there already or can't be a file.
void requireMovie(const std::string& out, Overwrite overwrite);

// --speed, --fps; returns the exit code. Throws Error.
int drawMovie(const CommandLine& given,
              const Profile& profile,
              const gui::FrameSpan& span,
              const gui::FramePictures::Paint& paint,
              const gui::PicturePaper& paper,
              Overwrite overwrite);

}  // namespace palpate::commands
