// The command `palpate verify PATH...` checks every byte of recordings and prints one line for each
// file.
#include <filesystem>

#include "palpate/core/escaped_line.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

int exitCode(VerifyReport::State state) {
  switch (state) {
    case VerifyReport::State::kSound:
      return kDone;
    case VerifyReport::State::kDamaged:
      return kPartlyDone;
    case VerifyReport::State::kUnreadable:
      break;
  }
  return kFailed;
}

const char* word(VerifyReport::State state) {
  switch (state) {
    case VerifyReport::State::kSound:
      return "sound";
    case VerifyReport::State::kDamaged:
      return "damaged";
    case VerifyReport::State::kUnreadable:
      break;
  }
  return "unreadable";
}

// The worse of two exit codes: kFailed (nothing readable) is worse than kPartlyDone, although its
// number is smaller.
int worse(int a, int b) {
  const auto rank = [](int code) { return code == kFailed ? 2 : code == kPartlyDone ? 1 : 0; };
  return rank(a) >= rank(b) ? a : b;
}

}  // namespace

int verifyCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate verify PATH...",
       .purpose =
           "Checks every byte of recordings; one line per file says sound, damaged (and how much "
           "can still be read) or unreadable. Exit code: 0 all sound, 3 damaged but partly "
           "readable, 1 nothing readable; with several files the worst. PATH is a recording, or a "
           "folder: every recording below it. With --quiet it gives only the exit code.",
       .options = {},
       .example = "palpate verify foam_ball.dsa hockey_ball.dsa",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  int worst = kDone;
  const int code =
      forEachVerified(recordingsIn(given.words()),
                      given.quiet(),
                      [&](const std::filesystem::path& file, const VerifyReport& report) {
                        worst = worse(worst, exitCode(report.state));
                        FileOutcome outcome;
                        if (!given.quiet())
                          outcome.said = escapedLine(file.string()) + ": " + word(report.state) +
                                         ": " + escapedLine(report.message);
                        return outcome;
                      });
  return worse(worst, code);
}

}  // namespace palpate::commands
