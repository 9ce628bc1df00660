// The command `palpate compare A B [--align HOW]` prints two recordings side by side, frame by
// frame, as CSV.
#include <cstdint>
#include <cstdio>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/recording/recording.h"
#include "palpate/signals/characteristic_signals.h"
#include "palpate/signals/frame_difference.h"

#include "commands/command_line.h"
#include "commands/commands.h"

namespace palpate::commands {
namespace {

constexpr double kFurthestS = 1e9;
constexpr int kMicroseconds = 6;  // decimals: the resolution of time stamps

TimedProfile opened(const std::string& file, bool quiet) {
  ProgressLine progress("reading " + file, quiet);
  return timedProfile(openRecording(file, progress.callback()), {}, progress.callback());
}

double offsetFor(const CommandLine& given, const TimedProfile& a, const TimedProfile& b) {
  if (const auto offsetS = given.number("offset", -kFurthestS, kFurthestS)) {
    if (given.has("align")) throw UsageError("give --align or --offset, not both");
    return *offsetS;
  }
  const std::string word = given.choice("align", {"contact", "start", "clock"}).value_or("contact");
  if (const auto offsetS = offsetBetween(a, b, *alignmentFrom(word))) return *offsetS;
  for (std::size_t i = 0; i < 2; ++i) {
    const TimedProfile& side = i == 0 ? a : b;
    if (side.profile.numFrames() == 0) throw Error(given.words()[i] + ": has no frames");
    if (!side.contact)
      throw Error(given.words()[i] +
                  ": no lasting contact (3 taxels in 3 frames in a row); use --align start");
  }
  throw Error("these two recordings can't be aligned; try --align start");
}

void compareAppendRow(std::string& line,
                      const FramePair& pair,
                      std::size_t matrix,
                      double meanA,
                      double meanB,
                      const DifferenceStatistics& difference) {
  line += fixedText(pair.timeS, kMicroseconds);
  for (const std::size_t whole : {pair.frameA, pair.frameB, matrix}) {
    line += ',';
    appendNumber(line, static_cast<std::int64_t>(whole));
  }
  for (const double value : {meanA, meanB, difference.mean, difference.rms}) {
    line += ',';
    appendNumber(line, value);
  }
  line += '\n';
}

}  // namespace

int compareCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate compare A B [--align contact|start|clock] [--offset S]",
       .purpose = "Aligns two recordings in time. For every frame of A it takes the frame of B at "
                  "the same time (or the last one before it) and prints of each matrix: the mean "
                  "of the active taxels in A and in B, and mean and root mean square of A - B over "
                  "the taxels that are active in either. The first contact is the first of three "
                  "frames in a row in which at least 3 taxels are active. Matrices whose number of "
                  "rows or columns differs in B are left out.",
       .options = {{"align",
                    "HOW",
                    "contact (default): first contacts; start; clock: by host time"},
                   {"offset", "S", "instead: when B begins, in seconds from A's first frame"}},
       .example = "palpate compare run_1.dsa run_2.dsa > differences.csv",
       .minArguments = 2,
       .maxArguments = 2},
      words);
  if (given.helpShown()) return kDone;
  const TimedProfile a = opened(given.words()[0], given.quiet());
  const TimedProfile b = opened(given.words()[1], given.quiet());
  const double offsetS = offsetFor(given, a, b);
  const FrameComparison comparison(a.profile.hand().layout, b.profile.hand().layout);
  StandardOutput out;
  out.write("time_s,frame_a,frame_b,matrix,mean_a,mean_b,difference_mean,difference_rms\n");
  ProgressLine progress("comparing", given.quiet());
  std::string line;
  std::size_t pairs = 0;
  visitFramePairs(
      a,
      b,
      offsetS,
      1,
      [&](const FramePair& pair, const TactileFrame& inA, const TactileFrame& inB) {
        ++pairs;
        line.clear();
        const auto differences = comparison.statistics(inA, inB);
        for (std::size_t m = 0; m + 1 < differences.size(); ++m) {
          if (!comparison.compared(m)) continue;
          const auto mean = [m](const TactileFrame& frame) {
            return characteristicSignals(frame.matrix(m), frame.layout->matrix(m)).mean;
          };
          compareAppendRow(line, pair, m, mean(inA), mean(inB), differences[m]);
        }
        out.write(line);
      },
      progress.callback());
  out.finish();
  if (pairs == 0 && !given.quiet())
    std::fprintf(stderr, "palpate: the two have no moment in common at this alignment\n");
  return kDone;
}

}  // namespace palpate::commands
