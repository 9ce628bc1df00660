// The command line of Palpate: `palpate COMMAND ..` or, without a command, the window.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpate::commands {

// Exit codes, the same for every command.
constexpr int kDone = 0;
constexpr int kFailed = 1;      // one line on stderr: what, where, what to do
constexpr int kWrongUsage = 2;  // one line on stderr
constexpr int kPartlyDone = 3;  // damaged input, some of several files: says what and how much

using Words = std::vector<std::string>;

struct Command {
  const char* name;
  const char* summary;             // one line of `palpate --help`
  int (*run)(const Words& words);  // the words after the command's name
};

// One function per command, one file per command. They throw; run() turns that into exit codes.
int adaptCommand(const Words& words);
int calibrateCommand(const Words& words);
int classifyCommand(const Words& words);
int compareCommand(const Words& words);
int contactCommand(const Words& words);
int convertCommand(const Words& words);
int demoCommand(const Words& words);
int emulateCommand(const Words& words);
int evaluateCommand(const Words& words);
int featuresCommand(const Words& words);
int filterCommand(const Words& words);
int ghostsCommand(const Words& words);
int graspCommand(const Words& words);
int graspsCommand(const Words& words);
int infoCommand(const Words& words);
int kinematicsCommand(const Words& words);
int portsCommand(const Words& words);
int recordCommand(const Words& words);
int recoverCommand(const Words& words);
int remoteCommand(const Words& words);
int renderCommand(const Words& words);
int signalsCommand(const Words& words);
int slipBenchmarkCommand(const Words& words);
int slipCommand(const Words& words);
int spectrumCommand(const Words& words);
int streamCommand(const Words& words);
int synthesizeCommand(const Words& words);
int trainCommand(const Words& words);
int verifyCommand(const Words& words);
// The window: files to open, --demo, --screenshot.
int workbenchCommand(const Words& words);

const std::vector<Command>& allCommands();
// Runs the whole program; returns its exit code.
int run(int argc, char** argv);
// Folder of the program's own data (example recordings): $PALPATE_DATA, else the one that belongs
// to this program, wherever it lies: ../share/palpate, in a build folder share/palpate.
std::filesystem::path dataFolder();

}  // namespace palpate::commands
