#include "palpate/signals/signal_rows.h"

#include "palpate/core/number_text.h"
#include "palpate/core/text_table.h"
#include "palpate/core/time.h"
#include "palpate/model/timing.h"
#include "palpate/signals/characteristic_signals.h"
#include "palpate/signals/signal_filter.h"

namespace palpate {
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

void appendSignalRow(std::string& lines,
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

}  // namespace

const char* const kSignalColumns =
    "frame,time_ms,matrix,mean,filtered_mean,min,max,sum,active,area_mm2";

std::string signalUnits(const HandDescription& hand) {
  const std::string& unit = hand.unit;
  std::string line = csvLine({"", "ms", "", unit, unit, unit, unit, unit, "taxels", "mm^2"});
  line.pop_back();
  return line;
}

void writeSignalRows(const Profile& profile,
                     std::optional<std::size_t> onlyMatrix,
                     const Recipe& smooth,
                     const std::string& lineEnd,
                     const std::function<void(const std::string& lines)>& sink,
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
      appendSignalRow(lines, written, hostUs, m, columnsOf(rows[m]));
      lines += lineEnd;
    }
    sink(lines);
    ++written;
  };
  if (smooth.dependsOnRate()) smooth.validateForRate(timingOf(profile).rateHz);
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

}  // namespace palpate
