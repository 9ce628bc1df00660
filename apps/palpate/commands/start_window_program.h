// The program `palpate` starts in a few milliseconds because it loads neither Qt nor OpenCV, Ceres
// or HDF5. Where a command needs them, or the window is wanted, it becomes `palpate_window`.
#pragma once

#include <filesystem>
#include <string>

#include "commands/commands.h"

namespace palpate::commands {

// Replaces the program of this process (execv): the process, its streams and its signals stay the
// same. Does not return; throws Error when palpate_window can't be started. `name` and `words` as
// for OtherCommands.
int startWindowProgram(const std::string& name, const Arguments& words);

// Whether a command may write HDF5: a word of its line (or what follows the word's '=') is the
// ending of such a file or ends so. To read HDF5 is the work of palpate_hdf5.
bool needsHdf5(const Arguments& words);

// Where palpate_window lies: next to `program` in a build folder, otherwise where the installation
// has it. `program` is the path of this executable, links followed.
std::filesystem::path windowProgramOf(const std::filesystem::path& program);

}  // namespace palpate::commands
