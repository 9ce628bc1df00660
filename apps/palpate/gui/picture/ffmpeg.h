// The program ffmpeg, which makes movies of pictures. It is used where it is; Palpate runs without
// it.
#pragma once

#include <QSize>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gui/picture/child_program.h"

namespace palpate::gui {

// $PALPATE_FFMPEG, else ffmpeg in $PATH; nothing when that is no program.
std::optional<std::filesystem::path> findFfmpeg();
// Why there is none and what to do, in one line.
std::string ffmpegMissing();

// Which way of coding it has: "libx264" (H.264), else "mpeg4" (MPEG-4 part 2); from what `ffmpeg
// -encoders` prints. Empty: neither.
std::string encoderFrom(const std::string& printed);
// Asks the program. Throws Error: it can't be started, has none of them; Cancelled.
std::string encoderOf(const std::filesystem::path& ffmpeg,
                      const ChildProgram::KeepGoing& keepGoing = {});

// Arguments of the program: from standard input come pictures of `size` (both even), four bytes a
// pixel (blue, green, red, none), row by row; an MP4 goes to the descriptor
// ChildProgram::kPassedAs. Its colours are BT.709's, and said to be: players show the colours that
// were painted.
std::vector<std::string> ffmpegArguments(const std::string& encoder,
                                         const QSize& size,
                                         double picturesPerS,
                                         const std::string& title);
// The line that says why it failed, of all that it said; empty: it said nothing.
std::string lastError(const std::string& said);

}  // namespace palpate::gui
