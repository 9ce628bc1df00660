// Finds and calls the program ffmpeg, which encodes pictures as a movie. It is optional: Palpate
// runs without it.
#pragma once

#include <QSize>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <palpate/core/child_program.h>

namespace palpate::gui {

// The program named by $PALPATE_FFMPEG, else ffmpeg in $PATH; nothing when there is no such
// program.
std::optional<std::filesystem::path> findFfmpeg();
// One line that tells why ffmpeg is missing and what to do.
std::string ffmpegMissing();

// The encoder to use, from the output of `ffmpeg -encoders`: "libx264" (H.264), else "mpeg4"
// (MPEG-4 part 2). Empty: neither is available.
std::string encoderFrom(const std::string& printed);
// Runs the program to find its encoder. Throws Error: it can't be started or has neither encoder;
// Cancelled.
std::string encoderOf(const std::filesystem::path& ffmpeg,
                      const ChildProgram::KeepGoing& keepGoing = {});

// Arguments of the program. It reads pictures of `size` (width and height even) from standard
// input, row by row, four bytes per pixel (blue, green, red, unused), and writes an MP4 to the
// descriptor ChildProgram::kPassedAs. The colours are converted and tagged as BT.709, so that
// players show them as painted.
std::vector<std::string> ffmpegArguments(const std::string& encoder,
                                         const QSize& size,
                                         double picturesPerS,
                                         const std::string& title);
// The line of the program's output that tells why it failed; empty: there is no output.
std::string lastError(const std::string& said);

}  // namespace palpate::gui
