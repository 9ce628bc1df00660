// The commands of the program `palpate_window`: those that need Qt, OpenCV or Ceres.
#pragma once

#include <string>

#include "commands/commands.h"

namespace palpate::commands {

// Runs the command `name`, one of those without a function in allCommands(); without a name the
// window. Throws as the commands do.
int runWindowCommand(const std::string& name, const Arguments& words);

}  // namespace palpate::commands
