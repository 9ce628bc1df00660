// The command `palpate signals PATH... [--matrix M] [--filter SPEC..]` prints characteristic
// signals as CSV.
#include <cstdint>
#include <filesystem>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"
#include "palpate/core/text_table.h"
#include "palpate/core/time.h"
#include "palpate/signals/characteristic_signals.h"
#include "palpate/signals/signal_filter.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/filter_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

// The values in the order of the columns.
SignalValues columnsOf(const CharacteristicSignals& row) {
  return {row.mean,
          row.filteredMean,
          row.minimum,
          row.maximum,
          row.sum,
          static_cast<double>(row.active),
          row.areaMm2};
}
// The same for filtered signals, which are in the order of kAllSignalKinds.
SignalValues columnsOf(const SignalValues& row) {
  return {row[0], row[1], row[3], row[2], row[4], row[5], row[6]};
}

void signalsAppendRow(std::string& lines,
                      std::size_t frame,
                      std::int64_t hostUs,
                      std::size_t matrix,
                      const SignalValues& columns) {
  appendNumber(lines, static_cast<std::int64_t>(frame));
  lines += ',';
  appendNumber(lines, hostUs / kUsPerMs);
  lines += ',';
  appendNumber(lines, static_cast<std::int64_t>(matrix));
  for (const double value : columns) {
    lines += ',';
    appendNumber(lines, value);
  }
}

void writeSignals(const TextSink& out,
                  const Profile& profile,
                  std::optional<std::size_t> onlyMatrix,
                  const Recipe& smooth,
                  const std::string& lineEnd,
                  const Progress& progress) {
  const SensorLayout& layout = profile.layout();
  const std::size_t first = onlyMatrix.value_or(0);
  const std::size_t last = onlyMatrix ? *onlyMatrix + 1 : layout.numMatrices();
  TactileFrame frame;
  std::string lines;
  std::size_t written = 0;
  const auto write = [&](std::int64_t hostUs, const auto& rows) {
    lines.clear();
    for (std::size_t m = first; m < last; ++m) {
      signalsAppendRow(lines, written, hostUs, m, columnsOf(rows[m]));
      lines += lineEnd;
    }
    out(lines);
    ++written;
  };
  SignalFilter filter(smooth, layout.numMatrices(), write);
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(progress, i, profile.numFrames());
    profile.readFrame(i, frame);
    const std::vector<CharacteristicSignals> rows = characteristicSignals(frame);
    if (smooth.empty())
      write(frame.hostUs, rows);
    else
      filter.push(frame.hostUs, rows);
  }
  filter.finish();
}

// The filters over time that are applied to the signals themselves (--smooth).
Recipe smoothOf(const CommandLine& given) {
  try {
    const Recipe recipe = parseRecipe(given.texts("smooth"));
    SignalFilter(recipe, 1, [](std::int64_t, std::span<const SignalValues>) {});
    return recipe;
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--smooth ") + error.what());
  }
}

}  // namespace

int signalsCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate signals PATH... [--matrix M] [--filter SPEC..] [--smooth SPEC..]",
       .purpose = "Prints the characteristic signals of every matrix in every frame as CSV: mean, "
                  "minimum, maximum,\nsum and number of the active taxels (value > 0), their area, "
                  "and the mean of the 3x3 Gaussian-\nfiltered matrix over its active taxels. An "
                  "empty matrix has zeros. PATH is a recording, or a\nfolder: every recording "
                  "below it. With several a last column names the file; one that can't be\nread is "
                  "reported, and the rows of the others are printed: exit code 3.",
       .options = withFilterOptions(
           {{"matrix", "M", "only this matrix (0, 1, ..)"},
            {"smooth", "SPEC", "then filter the signals themselves over time, as kalman:q=0.05"}}),
       .example = "palpate signals foam_ball.dsa --matrix 1 > curve.csv",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  const auto matrix = given.integer("matrix", 0, INT64_MAX);
  const Recipe recipe = recipeOf(given);
  const Recipe smooth = smoothOf(given);
  const RecordingList recordings = recordingsIn(given.words());
  return writeProfileTexts(
      recordings,
      given.quiet(),
      {.begin = "frame,time_ms,matrix,mean,filtered_mean,min,max,sum,active,area_mm2" +
                std::string(recordings.several ? ",file\n" : "\n")},
      [&](const std::filesystem::path& file,
          const Profile& unfiltered,
          const TextSink& write,
          const Progress& progress) {
        const Profile profile = filteredBy(recipe, unfiltered, file);
        std::optional<std::size_t> only;
        if (matrix) {
          only = static_cast<std::size_t>(*matrix);
          if (*only >= profile.layout().numMatrices())
            throw Error(file.string() + ": has no matrix " + std::to_string(*matrix) +
                        ", only 0.." + std::to_string(profile.layout().numMatrices() - 1));
        }
        const std::string lineEnd = recordings.several ? "," + csvLine({file.string()}) : "\n";
        writeSignals(write, profile, only, smooth, lineEnd, progress);
      });
}

}  // namespace palpate::commands
