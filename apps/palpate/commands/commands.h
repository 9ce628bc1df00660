// The command line of Palpate: `palpate COMMAND ..` runs a command; without a command the window
// starts.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpate::commands {

// Exit codes, the same for every command. kDone: success.
constexpr int kDone = 0;
// Failed; one line on stderr says what failed, where, and what to do.
constexpr int kFailed = 1;
// Wrong usage; one line on stderr.
constexpr int kWrongUsage = 2;
// Done in part: damaged input, or only some of several files; the output says what is missing and
// how much.
constexpr int kPartlyDone = 3;

using Arguments = std::vector<std::string>;

// Where `palpate --help` lists a command, in this order.
enum class CommandGroup { kLook, kCompute, kExport, kRecognise, kHand, kLaboratory };

// An entry of the list of commands.
struct Command {
  const char* name;
  CommandGroup group;
  // One line of `palpate --help`.
  const char* summary;
  // The function of the command; it gets the words after the command's name. Null: the command
  // needs Qt, OpenCV or Ceres, and only the program `palpate_window` has it (window_commands.h).
  int (*run)(const Arguments& words);
};

// Runs a command of which Command::run is null; with an empty name the window. Returns the exit
// code, and throws as the commands do.
using OtherCommands = int (*)(const std::string& name, const Arguments& words);

// One function and one file for each command. They report errors as exceptions, which run()
// converts to exit codes.
int adaptCommand(const Arguments& words);
int calibrateCommand(const Arguments& words);
int classifyCommand(const Arguments& words);
int compareCommand(const Arguments& words);
int columnsCommand(const Arguments& words);
int contactCommand(const Arguments& words);
int convertCommand(const Arguments& words);
int demoCommand(const Arguments& words);
int emulateCommand(const Arguments& words);
int evaluateCommand(const Arguments& words);
int featuresCommand(const Arguments& words);
int filterCommand(const Arguments& words);
int ghostsCommand(const Arguments& words);
int graspCommand(const Arguments& words);
int graspsCommand(const Arguments& words);
int handsCommand(const Arguments& words);
int importCommand(const Arguments& words);
int infoCommand(const Arguments& words);
int kinematicsCommand(const Arguments& words);
int labelsCommand(const Arguments& words);
int portsCommand(const Arguments& words);
int recordCommand(const Arguments& words);
int recoverCommand(const Arguments& words);
int remoteCommand(const Arguments& words);
int renderCommand(const Arguments& words);
int deriveCommand(const Arguments& words);
int signalsCommand(const Arguments& words);
int slipBenchmarkCommand(const Arguments& words);
int stepBenchmarkCommand(const Arguments& words);
int slipCommand(const Arguments& words);
int spectrumCommand(const Arguments& words);
int streamCommand(const Arguments& words);
int synthesizeCommand(const Arguments& words);
int trainCommand(const Arguments& words);
int verifyCommand(const Arguments& words);
// Starts the window, with files to open, --demo or --screenshot.
int windowCommand(const Arguments& words);

// All commands, by name.
const std::vector<Command>& allCommands();
// Whether words of a command line need formats that the program does without.
using NeedsOthers = bool (*)(const Arguments& words);
// Runs the whole program; returns its exit code. Where `needsOthers` says so, `others` runs every
// command.
int run(int argc, char** argv, OtherCommands others, NeedsOthers needsOthers = nullptr);
// The folder of the program's own data (example recordings): $PALPATE_DATA, else the folder
// relative to this executable: share/palpate in a build folder, otherwise that of the installation
// to which it belongs.
std::filesystem::path dataFolder();

}  // namespace palpate::commands
