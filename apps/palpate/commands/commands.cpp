#include "commands/commands.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <iterator>
#include <new>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"

#include "commands/command_line.h"

namespace palpate::commands {
namespace fs = std::filesystem;
namespace {

void commandsShowHelp() {
  std::cout
      << "Palpate " PALPATE_VERSION
         ": workbench for tactile robot hands\n\n"
         "Usage:\n"
         "  palpate [FILE...]       open recordings in the window\n"
         "  palpate --demo          open the window on a demonstration\n"
         "  palpate --screenshot OUT.png [--size WxH] [--frame N] [--after S] [--dock NAME]...\n"
         "                          [--theme dark|light] [FILE | --demo]\n"
         "  palpate COMMAND ...     work without a window\n\n"
         "Commands:\n";
  for (const Command& command : allCommands())
    std::printf("  %-12s %s\n", command.name, command.summary);
  std::cout << std::flush;
  std::puts(
      "\n'palpate COMMAND --help' explains a command. Exit codes: 0 done, 1 failed, 2 wrong "
      "usage,\n"
      "3 done in part (damaged input, some of several files).");
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
void refuseMistypedCommand(const std::string& word) {
  std::error_code ignored;
  if (word.starts_with('-') || word.find_first_of("./") != std::string::npos ||
      fs::exists(word, ignored))
    return;
  const auto& all = allCommands();
  const auto nearest = std::min_element(all.begin(), all.end(), [&](const auto& a, const auto& b) {
    return distance(word, a.name) < distance(word, b.name);
  });
  std::string message = "no command and no file is called '" + word + "'";
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
    if (words[0] == "help" && words.size() == 2) {
      for (const Command& command : allCommands())
        if (words[1] == command.name) return runCommand(command, {"--help"});
      refuseMistypedCommand(words[1]);
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
    refuseMistypedCommand(words[0]);
  }
  return others({}, words);
}

int fail(int code, std::string_view message) {
  std::fprintf(stderr, "palpate: %s\n", escapedLine(message).c_str());
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
    return fail(
        kFailed,
        error.what() +
            std::string(missing ? "; 'palpate ports' tells what answers at each port" : ""));
  } catch (const std::bad_alloc&) {
    return fail(kFailed, "out of memory");
  } catch (const std::exception& error) {
    return fail(kFailed, error.what());
  }
}

}  // namespace

const std::vector<Command>& allCommands() {
  static const std::vector<Command> commands = {
      {"adapt", "adapts a recognition model to today, with labelled grasps", nullptr},
      {"calibrate",
       "calibrates counts to kPa and N: noise, steps, pressure, sensitivity, tare",
       nullptr},
      {"classify", "names what was grasped, with a trained model", nullptr},
      {"compare", "compares two recordings frame by frame, as CSV", &compareCommand},
      {"contact", "where a hand touches, and how large the held object is", nullptr},
      {"convert",
       "converts recordings: .dsa, .palpate, .csv, .npz, .h5, .mat, .mcap",
       &convertCommand},
      {"demo", "a tour without a window: emulated hands grasp objects, which are named", nullptr},
      {"derive", "curves that a formula makes of signals, as CSV", &deriveCommand},
      {"emulate", "runs the emulated hand on two ports, until it is interrupted", nullptr},
      {"evaluate", "measures how well grasps are recognised", nullptr},
      {"features", "features of each grasp for recognition, as CSV", &featuresCommand},
      {"filter", "filters a recording with a chain of filters", &filterCommand},
      {"ghosts",
       "counts false taxels, and what filters do to them and to contacts",
       &ghostsCommand},
      {"grasp", "moves a connected hand: plain and reactive grasps", nullptr},
      {"grasps", "where the grasps in recordings are, as CSV", &graspsCommand},
      {"hands", "lists the hands that are known, and checks the folder of one", &handsCommand},
      {"import", "imports tables of other programs: CSV, NumPy, HDF5", nullptr},
      {"info", "what is in a recording, or in each of a folder", &infoCommand},
      {"kinematics", "where the taxels are at a set of joint angles", &kinematicsCommand},
      {"labels",
       "labels, notes and marked grasps as CSV, out of recordings and into them",
       &labelsCommand},
      {"ports", "lists the ports and the device on each", &portsCommand},
      {"record", "records a connected hand", nullptr},
      {"recover", "saves what can be saved of a damaged or unfinished recording", &recoverCommand},
      {"remote", "controls a running palpate: status, start, stop, label, ..", &remoteCommand},
      {"render", "a picture of one frame: PNG, SVG or PDF", nullptr},
      {"signals", "characteristic signals of each matrix as CSV", &signalsCommand},
      {"slip", "how contacts move on every matrix, and whether that is slip, as CSV", &slipCommand},
      {"slip-benchmark",
       "how well every method measures slip, against synthetic truth, as JSON",
       &slipBenchmarkCommand},
      {"spectrum", "spectra of a taxel or a signal over time, as CSV", &spectrumCommand},
      {"step-benchmark",
       "how often the intervals of loading steps hold the truth, against synthetic steps, as JSON",
       nullptr},
      {"stream", "sends live signals or taxels to other programs (PlotJuggler)", nullptr},
      {"synthesize", "makes a synthetic recording with known content", &synthesizeCommand},
      {"train", "trains a model that recognises what is grasped", nullptr},
      {"verify", "checks every byte of recordings", &verifyCommand},
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
  const int code = runCaught({argv + std::min(argc, 1), argv + argc}, others, needsOthers);
  // Output that was printed but not written (a full disk, a closed pipe) is a failure.
  std::cout.flush();
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
  return written || code == kFailed ? code : fail(kFailed, "standard output can't be written");
}

}  // namespace palpate::commands
