// The command `palpate verify PATH...` checks every byte of recordings and prints one line for each
// file.
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "palpate/core/escaped_line.h"
#include "palpate/core/result_table.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/recording_list.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

struct VerifiedFile {
  std::string file;
  std::string state;
  std::string message;
};

std::unique_ptr<ResultTable> verifiedTable(std::vector<VerifiedFile> files) {
  std::vector<ColumnOf<VerifiedFile>> columns{
      columnOf<VerifiedFile>("file", "", "", &VerifiedFile::file),
      columnOf<VerifiedFile>("state", "", "sound, damaged, unreadable", &VerifiedFile::state),
      columnOf<VerifiedFile>("message", "", "what can be read", &VerifiedFile::message)};
  return std::make_unique<RowTable<VerifiedFile>>(
      "verification", std::move(columns), std::move(files));
}

// The exit code of a state, and its word.
std::pair<int, const char*> codeAndWord(VerifyReport::State state) {
  switch (state) {
    case VerifyReport::State::kSound:
      return {kDone, "sound"};
    case VerifyReport::State::kDamaged:
      return {kPartlyDone, "damaged"};
    case VerifyReport::State::kUnreadable:
      break;
  }
  return {kFailed, "unreadable"};
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
      {.synopsis = "palpate verify PATH... [-o OUT.csv]",
       .purpose =
           "Checks every byte of recordings; one line per file says sound, damaged (and how much "
           "can still be read) or unreadable. Exit code: 0 all sound, 3 damaged but partly "
           "readable, 1 nothing readable; with several files the worst. PATH is a recording, or a "
           "folder: every recording below it. With --quiet it gives only the exit code.",
       .options = withOutputOptions({}, "OUT.csv", "write a table to this file, or .json"),
       .example = "palpate verify foam_ball.dsa hockey_ball.dsa",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  const bool toFile = given.has("output");
  formOf(given);
  std::vector<VerifiedFile> files;
  int worst = kDone;
  const int code =
      forEachVerified(recordingsIn(given.words()),
                      given.quiet(),
                      [&](const std::filesystem::path& file, const VerifyReport& report) {
                        const auto [stateCode, state] = codeAndWord(report.state);
                        worst = worse(worst, stateCode);
                        FileOutcome outcome;
                        if (toFile)
                          files.push_back({file.string(), state, report.message});
                        else if (!given.quiet())
                          outcome.said = escapedLine(file.string()) + ": " + state + ": " +
                                         escapedLine(report.message);
                        return outcome;
                      });
  // Without any file the table of an earlier call stays.
  if (!files.empty()) worst = worse(worst, writeTable(given, *verifiedTable(std::move(files))));
  return worse(worst, code);
}

}  // namespace palpate::commands
