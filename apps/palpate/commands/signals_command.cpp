// palpate signals PATH... [--matrix M] [--filter SPEC..]: characteristic signals as CSV.
#include <cstdint>
#include <filesystem>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/text_table.h"
#include "palpate/filter/characteristic_signals.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/filter_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

constexpr std::int64_t kUsPerMs = 1000;

void appendRow(std::string& line,
               std::size_t frame,
               std::int64_t hostUs,
               std::size_t matrix,
               const CharacteristicSignals& signals) {
  appendNumber(line, static_cast<std::int64_t>(frame));
  line += ',';
  appendNumber(line, hostUs / kUsPerMs);
  line += ',';
  appendNumber(line, static_cast<std::int64_t>(matrix));
  for (double value :
       {signals.mean, signals.filteredMean, signals.minimum, signals.maximum, signals.sum}) {
    line += ',';
    appendNumber(line, value);
  }
  line += ',';
  appendNumber(line, static_cast<std::int64_t>(signals.active));
  line += ',';
  appendNumber(line, signals.areaMm2);
}

void writeSignals(StandardOutput& out,
                  const Profile& profile,
                  std::optional<std::size_t> onlyMatrix,
                  const std::string& lineEnd,
                  const Progress& progress) {
  const SensorLayout& layout = profile.layout();
  const std::size_t first = onlyMatrix.value_or(0);
  const std::size_t last = onlyMatrix ? *onlyMatrix + 1 : layout.numMatrices();
  TactileFrame frame;
  std::string line;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    if (!progress(static_cast<double>(i) / static_cast<double>(profile.numFrames())))
      throw Cancelled();
    profile.readFrame(i, frame);
    for (std::size_t m = first; m < last; ++m) {
      line.clear();
      appendRow(line, i, frame.hostUs, m, characteristicSignals(frame.matrix(m), layout.matrix(m)));
      out.write(line += lineEnd);
    }
  }
}

}  // namespace

int signalsCommand(const Words& words) {
  const CommandLine given(
      {.synopsis = "palpate signals PATH... [--matrix M] [--filter SPEC..]",
       .purpose = "Prints the characteristic signals of every matrix in every frame as CSV: mean, "
                  "minimum, maximum,\nsum and number of the active taxels (value > 0), their area, "
                  "and the mean of the 3x3 Gaussian-\nfiltered matrix over its active taxels. An "
                  "empty matrix has zeros. PATH is a recording, or a\nfolder: every recording "
                  "below it. With several a last column names the file; one that can't be\nread is "
                  "said, and the rows of the others are there: exit code 3.",
       .options = withFilterOptions({{"matrix", "M", "only this matrix (0, 1, ..)"}}),
       .example = "palpate signals foam_ball.dsa --matrix 1 > curve.csv",
       .fewestWords = 1},
      words);
  if (given.helpShown()) return kDone;
  const auto matrix = given.integer("matrix", 0, INT64_MAX);
  const Recipe recipe = recipeOf(given);
  const RecordingList recordings = recordingsIn(given.words());
  StandardOutput out;
  bool headerWritten = false;
  return forEachProfile(
      recordings,
      given.quiet(),
      [&](const std::filesystem::path& file, const Profile& unfiltered, const Progress& progress) {
        const Profile profile = lookedAtThrough(recipe, unfiltered, file);
        std::optional<std::size_t> only;
        if (matrix) {
          only = static_cast<std::size_t>(*matrix);
          if (*only >= profile.layout().numMatrices())
            throw Error(file.string() + ": has no matrix " + std::to_string(*matrix) +
                        ", only 0.." + std::to_string(profile.layout().numMatrices() - 1));
        }
        if (!headerWritten)
          out.write("frame,time_ms,matrix,mean,filtered_mean,min,max,sum,active,area_mm2" +
                    std::string(recordings.several ? ",file\n" : "\n"));
        headerWritten = true;
        const std::string lineEnd = recordings.several ? "," + csvLine({file.string()}) : "\n";
        // What was written of a recording that fails on the way stays: whole rows, and it is said.
        try {
          writeSignals(out, profile, only, lineEnd, progress);
        } catch (const Error&) {
          out.finish();
          throw;
        }
        out.finish();
      });
}

}  // namespace palpate::commands
