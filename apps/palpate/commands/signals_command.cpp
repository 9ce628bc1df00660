// palpate signals FILE... [--matrix M]: characteristic signals as CSV.
#include <cstdint>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/filter/characteristic_signals.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"

namespace palpate::commands {
namespace {

constexpr std::int64_t kUsPerMs = 1000;

// A field of a CSV table, quoted where it must be.
std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

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
    if (progress) progress(static_cast<double>(i) / static_cast<double>(profile.numFrames()));
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
      {.synopsis = "palpate signals FILE... [--matrix M]",
       .purpose = "Prints the characteristic signals of every matrix in every frame as CSV: mean, "
                  "minimum, maximum,\nsum and number of the active taxels (value > 0), their area, "
                  "and the mean of the 3x3 Gaussian-\nfiltered matrix over its active taxels. An "
                  "empty matrix has zeros. With several FILEs a last\ncolumn names the file.",
       .options = {{"matrix", "M", "only this matrix (0, 1, ..)"}},
       .example = "palpate signals foam_ball.dsa --matrix 1 > curve.csv",
       .fewestWords = 1},
      words);
  if (given.helpShown()) return kDone;
  const auto matrix = given.integer("matrix", 0, INT64_MAX);
  const bool several = given.words().size() > 1;
  StandardOutput out;
  bool headerWritten = false;
  for (const std::string& file : given.words()) {
    ProgressLine progress("signals of " + file, given.quiet());
    const Profile profile = openRecording(file, progress.callback());
    std::optional<std::size_t> only;
    if (matrix) {
      only = static_cast<std::size_t>(*matrix);
      if (*only >= profile.layout().numMatrices())
        throw Error(file + ": has no matrix " + std::to_string(*matrix) + ", only 0.." +
                    std::to_string(profile.layout().numMatrices() - 1));
    }
    if (!headerWritten)
      out.write("frame,time_ms,matrix,mean,filtered_mean,min,max,sum,active,area_mm2" +
                std::string(several ? ",file\n" : "\n"));
    headerWritten = true;
    writeSignals(
        out, profile, only, several ? "," + csvField(file) + "\n" : "\n", progress.callback());
  }
  out.finish();
  return kDone;
}

}  // namespace palpate::commands
