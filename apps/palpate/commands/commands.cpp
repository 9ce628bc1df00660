#include "commands/commands.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <new>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "palpate/core/error.h"

#include "commands/command_line.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace fs = std::filesystem;
namespace {

constexpr std::array kGroups{std::pair{"Look", CommandGroup::kLook},
                             std::pair{"Compute", CommandGroup::kCompute},
                             std::pair{"Export", CommandGroup::kExport},
                             std::pair{"Recognise", CommandGroup::kRecognise},
                             std::pair{"Hand", CommandGroup::kHand},
                             std::pair{"Laboratory", CommandGroup::kLaboratory}};

void commandsShowHelp() {
  std::cout
      << "Palpate " PALPATE_VERSION
         ": workbench for tactile robot hands\n\n"
         "Usage:\n"
         "  palpate [FILE...]       open recordings in the window\n"
         "  palpate --demo          open the window on an emulated hand that grasps a ball\n"
         "  palpate --screenshot OUT.png [--size WxH] [--frame N] [--after S] [--dock NAME]...\n"
         "                          [--theme dark|light] [FILE | --demo]\n"
         "  palpate COMMAND ...     work without a window\n"
         "  palpate help COMMAND    explain a command, as 'palpate COMMAND --help'\n"
         "  palpate help columns    explain every column of every table\n"
         "  palpate help commands   explain every option of every command\n\n"
         "Commands:\n\n";
  for (const auto& [heading, group] : kGroups) {
    std::cout << heading << ":\n";
    for (const Command& command : allCommands())
      if (command.group == group)
        std::cout << "  " << std::left << std::setw(14) << command.name << " " << command.summary
                  << "\n";
    std::cout << "\n";
  }
  std::cout << std::flush;
  std::puts(
      "Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done in part (damaged input, or some of\n"
      "several files failed).");
}

// Number of letters to insert, delete or change to make one word equal to the other.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

// Throws for a first word that is neither a command nor a file: it was probably meant as a command.
void refuseMistypedCommand(const std::string& word, bool mayBeFile = true) {
  std::error_code ignored;
  if (word.starts_with('-')) return;
  if (mayBeFile && (word.find_first_of("./") != std::string::npos || fs::exists(word, ignored)))
    return;
  const auto& all = allCommands();
  const auto nearest = std::min_element(all.begin(), all.end(), [&](const auto& a, const auto& b) {
    return distance(word, a.name) < distance(word, b.name);
  });
  std::string message =
      (mayBeFile ? "no command and no file is called '" : "no command is called '") + word + "'";
  if (distance(word, nearest->name) <= 2)
    message += "; did you mean '" + std::string(nearest->name) + "'?";
  else
    message += "; 'palpate --help' lists the commands";
  throw UsageError(message);
}

int dispatch(const Arguments& words, OtherCommands others, NeedsOthers needsOthers) {
  const auto runCommand = [&](const Command& command, const Arguments& rest) {
    if (!command.run || (needsOthers && needsOthers(rest))) return others(command.name, rest);
    return command.run(rest);
  };
  if (!words.empty()) {
    if (words[0] == "help" && words.size() >= 2) {
      Arguments rest(words.begin() + 2, words.end());
      // Only a calibration has kinds.
      if (!rest.empty() && words[1] != "calibrate")
        throw UsageError("help explains one command: '" + rest.front() + "' is too many");
      if (words[1] == "columns" || words[1] == "commands") return others("help", {words[1]});
      rest.emplace_back("--help");
      for (const Command& command : allCommands())
        if (words[1] == command.name) return runCommand(command, rest);
      refuseMistypedCommand(words[1], false);
    }
    if (words[0] == "--help" || words[0] == "-h" || words[0] == "help") {
      commandsShowHelp();
      return kDone;
    }
    if (words[0] == "--version") {
      std::puts("palpate " PALPATE_VERSION);
      return kDone;
    }
    for (const Command& command : allCommands())
      if (words[0] == command.name) return runCommand(command, {words.begin() + 1, words.end()});
    // Help is asked of a command, not of a file.
    const bool asksHelp = words.size() == 2 && (words[1] == "--help" || words[1] == "-h");
    refuseMistypedCommand(words[0], !asksHelp);
  }
  return others({}, words);
}

int fail(int code, std::string_view message) {
  sayLine(message);
  return code;
}

// Opens closed standard streams, because the next opened file would otherwise get their number and
// receive output meant for the terminal. Each is opened in the wrong direction, so that using it
// fails as it should.
void fillClosedStreams() {
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0)
      ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

int runCaught(const Arguments& words, OtherCommands others, NeedsOthers needsOthers) {
  try {
    return dispatch(words, others, needsOthers);
  } catch (const UsageError& error) {
    return fail(kWrongUsage, error.what());
  } catch (const DeviceError& error) {
    const bool missing =
        error.fault() == DeviceFault::kNotFound || error.fault() == DeviceFault::kSilent;
    return fail(kFailed,
                error.what() +
                    std::string(missing ? "; 'palpate ports' lists the device at each port" : ""));
  } catch (const std::bad_alloc&) {
    return fail(kFailed, "out of memory");
  } catch (const std::exception& error) {
    return fail(kFailed, error.what());
  }
}

}  // namespace

const std::vector<Command>& allCommands() {
  static const std::vector<Command> commands = {
      {"adapt",
       CommandGroup::kRecognise,
       "adapts a recognition model to the session of today",
       nullptr},
      {"calibrate",
       CommandGroup::kCompute,
       "calibrates counts to kPa and N: noise, steps, pressure, sensitivity, tare",
       nullptr},
      {"classify",
       CommandGroup::kRecognise,
       "names the grasped objects with a trained model",
       nullptr},
      {"compare",
       CommandGroup::kCompute,
       "compares two recordings frame by frame, as CSV",
       nullptr},
      {"contact",
       CommandGroup::kCompute,
       "measures where the hand touches and how large the object is, as CSV",
       nullptr},
      {"convert",
       CommandGroup::kExport,
       "converts recordings: .dsa, .palpate, .csv, .npz, .h5, .mat, .mcap, .jsonl",
       &convertCommand},
      {"demo",
       CommandGroup::kLook,
       "runs a tour without a window: emulated hands grasp and recognise objects",
       nullptr},
      {"derive",
       CommandGroup::kCompute,
       "computes curves from signals by formulas, as CSV",
       nullptr},
      {"emulate",
       CommandGroup::kHand,
       "runs an emulated hand on two ports until it is interrupted",
       nullptr},
      {"evaluate",
       CommandGroup::kRecognise,
       "measures how well grasps are recognised, as JSON",
       nullptr},
      {"features",
       CommandGroup::kRecognise,
       "computes the features of each grasp for recognition, as CSV",
       &featuresCommand},
      {"filter",
       CommandGroup::kCompute,
       "filters a recording with one or several filters",
       &filterCommand},
      {"ghosts",
       CommandGroup::kCompute,
       "counts falsely active taxels with and without filters, as CSV",
       &ghostsCommand},
      {"grasp",
       CommandGroup::kHand,
       "moves a connected hand: plain, reactive and slip-aware grasps",
       nullptr},
      {"grasps", CommandGroup::kCompute, "finds the grasps in recordings, as CSV", &graspsCommand},
      {"hands",
       CommandGroup::kLook,
       "lists the known hands, and checks the folder of a hand",
       &handsCommand},
      {"import",
       CommandGroup::kExport,
       "imports tables of other programs: CSV, NumPy, HDF5, MAT",
       nullptr},
      {"info", CommandGroup::kLook, "shows what recordings contain", &infoCommand},
      {"kinematics",
       CommandGroup::kCompute,
       "computes where the taxels are at given joint angles, as CSV",
       &kinematicsCommand},
      {"labels",
       CommandGroup::kLook,
       "prints or imports labels, notes and marked grasps, as CSV",
       &labelsCommand},
      {"ports", CommandGroup::kHand, "lists the ports and the device at each", &portsCommand},
      {"record", CommandGroup::kHand, "records a connected hand", nullptr},
      {"recover",
       CommandGroup::kExport,
       "saves what is readable in a damaged or unfinished recording",
       &recoverCommand},
      {"remote",
       CommandGroup::kHand,
       "controls a running palpate: status, start, stop, label, ..",
       &remoteCommand},
      {"render",
       CommandGroup::kLook,
       "draws frames as pictures (PNG, SVG, PDF) or as a movie (MP4)",
       nullptr},
      {"signals",
       CommandGroup::kCompute,
       "computes the characteristic signals of each matrix, as CSV",
       &signalsCommand},
      {"slip",
       CommandGroup::kCompute,
       "measures how contacts move on each matrix and detects slip, as CSV",
       &slipCommand},
      {"slip-benchmark",
       CommandGroup::kLaboratory,
       "measures the accuracy of every slip method on synthetic data, as JSON",
       &slipBenchmarkCommand},
      {"spectrum",
       CommandGroup::kCompute,
       "computes spectra of a taxel or a signal, as CSV",
       nullptr},
      {"step-benchmark",
       CommandGroup::kLaboratory,
       "measures the reliability of the intervals of step fits, as JSON",
       nullptr},
      {"stream",
       CommandGroup::kExport,
       "sends live signals or taxels to other programs (PlotJuggler, Foxglove)",
       nullptr},
      {"synthesize",
       CommandGroup::kLaboratory,
       "makes a synthetic recording with known content",
       &synthesizeCommand},
      {"train",
       CommandGroup::kRecognise,
       "trains a model that recognises grasped objects",
       nullptr},
      {"verify", CommandGroup::kLook, "checks every byte of recordings", &verifyCommand},
  };
  return commands;
}

fs::path dataFolder() {
  std::error_code ignored;
  if (const char* given = std::getenv("PALPATE_DATA"); given && *given) return given;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path built = program.parent_path() / "share/palpate";  // a link that the build makes
  if (fs::is_directory(built, ignored)) return built;
  // The prefix of the installation: above bin/palpate, and above the folder of palpate_window.
  const fs::path window(PALPATE_INSTALLED_WINDOW);
  fs::path prefix = program.parent_path().parent_path();
  if (program.filename() == window.filename())
    for (auto left = std::distance(window.begin(), window.end()); left > 2; --left)
      prefix = prefix.parent_path();
  return prefix / PALPATE_INSTALLED_DATA;
}

int run(int argc, char** argv, OtherCommands others, NeedsOthers needsOthers) {
  fillClosedStreams();
  const int code =
      partlyDoneAfterLoss(runCaught({argv + std::min(argc, 1), argv + argc}, others, needsOthers));
  // Output that was printed but not written (a full disk, a closed pipe) is a failure.
  std::cout.flush();
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
  return written || code == kFailed ? code : fail(kFailed, "standard output can't be written");
}

}  // namespace palpate::commands
