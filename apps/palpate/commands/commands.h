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

using Arguments = std::vector<std::string>;

struct Command {
  const char* name;
  const char* summary;                 // one line of `palpate --help`
  int (*run)(const Arguments& words);  // the words after the command's name
};

// One function per command, one file per command. They throw; run() turns that into exit codes.
int adaptCommand(const Arguments& words);
int calibrateCommand(const Arguments& words);
int classifyCommand(const Arguments& words);
int compareCommand(const Arguments& words);
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
int infoCommand(const Arguments& words);
int kinematicsCommand(const Arguments& words);
int portsCommand(const Arguments& words);
int recordCommand(const Arguments& words);
int recoverCommand(const Arguments& words);
int remoteCommand(const Arguments& words);
int renderCommand(const Arguments& words);
int signalsCommand(const Arguments& words);
int slipBenchmarkCommand(const Arguments& words);
int slipCommand(const Arguments& words);
int spectrumCommand(const Arguments& words);
int streamCommand(const Arguments& words);
int synthesizeCommand(const Arguments& words);
int trainCommand(const Arguments& words);
int verifyCommand(const Arguments& words);
// The window: files to open, --demo, --screenshot.
int windowCommand(const Arguments& words);

const std::vector<Command>& allCommands();
// Runs the whole program; returns its exit code.
int run(int argc, char** argv);
// Folder of the program's own data (example recordings): $PALPATE_DATA, else the one that belongs
// to this program, wherever it lies: ../share/palpate, in a build folder share/palpate.
std::filesystem::path dataFolder();

}  // namespace palpate::commands
