// The command `palpate demo -o DIR` shows without a window what the program can do; it prints one
// line for each step.
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/interruption.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/demo_run.h"

namespace palpate::commands {
namespace fs = std::filesystem;
namespace {

void runWholeDemo(DemoRun& run) {
  run.graspAndRecord();
  run.lookAtTheBall();
  run.findSlip();
  run.recognise();
  run.draw();
  run.report();
}

void sayWhatIsNext(const fs::path& folder, bool failed) {
  const std::string in = escapedLine(folder.string()) + "/";
  if (failed) {
    std::printf("A step failed; the results so far are in %s, see %sreport.html.\n",
                escapedLine(folder.string()).c_str(),
                in.c_str());
    return;
  }
  std::printf(
      "\nLook at next:\n"
      "  %sreport.html    all of this as a page, with its pictures\n"
      "  %swindow.png     the window on the grasp of the ball\n"
      "  %sslip.png       the window while the pen slips\n"
      "On a display, 'palpate %sgrasp.palpate' opens that window, 'palpate --demo' one on an "
      "emulated hand.\n",
      in.c_str(),
      in.c_str(),
      in.c_str(),
      in.c_str());
}

}  // namespace

int demoCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate demo -o DIR",
       .purpose = "Runs a tour on emulated hands without a window, in about 15 seconds. Six hands "
                  "grasp an object each, and a pen slips between the fingers of a seventh. The "
                  "tour records them over their ports, replays and exports the recordings, detects "
                  "the slip, recognises the objects and compares the answers with the truth, draws "
                  "the window, and shows everything in report.html. It writes into DIR, or into "
                  "DIR-2, DIR-3, .. if DIR exists, and prints a line per step: ok, skipped or "
                  "failed, and a figure. Ctrl-C ends the tour and removes the folder that it made.",
       .options = {{"output,o", "DIR", "folder to make, default palpate-demo"}},
       .example = "palpate demo -o tour",
       .maxArguments = 0},
      words);
  if (given.helpShown()) return kDone;
  const fs::path folder = makeDemoFolder(given.text("output").value_or("palpate-demo"));
  Interruption interruption;  // before the first thread starts
  std::atomic<bool> interrupted = false;
  const DemoContinue goOn = [&] {
    if (interruption.waitForSignal(0)) interrupted = true;
    return !interrupted.load();
  };
  bool failed = false;
  try {
    if (!given.quiet()) {
      std::puts("A tour on emulated hands: no real one is touched.");
      std::fflush(stdout);
    }
    DemoRun run(folder, goOn);
    runWholeDemo(run);
    failed = run.failed();
  } catch (const Cancelled&) {
    // The demo created this folder, so that everything in it can be removed.
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    throw Error("interrupted: the files of the tour were removed");
  }
  if (!given.quiet()) sayWhatIsNext(folder, failed);
  return failed ? kFailed : kDone;
}

}  // namespace palpate::commands
