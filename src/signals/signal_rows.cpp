#include "palpate/signals/signal_rows.h"

#include <array>
#include <vector>

#include "palpate/core/number_text.h"
#include "palpate/core/text_table.h"
#include "palpate/core/time.h"
#include "palpate/model/timing.h"
#include "palpate/signals/characteristic_signals.h"
#include "palpate/signals/signal_filter.h"

namespace palpate {
namespace {

// In the order of the columns.
constexpr std::array kColumnKinds = {SignalKind::kMean,
                                     SignalKind::kFilteredMean,
                                     SignalKind::kMinimum,
                                     SignalKind::kMaximum,
                                     SignalKind::kSum,
                                     SignalKind::kActive,
                                     SignalKind::kArea,
                                     SignalKind::kX,
                                     SignalKind::kY,
                                     SignalKind::kZ,
                                     SignalKind::kNorm};

double valueIn(const CharacteristicSignals& row, SignalKind kind) { return valueOf(row, kind); }
double valueIn(const SignalValues& row, SignalKind kind) {
  return row[static_cast<std::size_t>(kind)];
}

template <class Row>
void appendSignalRow(std::string& lines,
                     std::size_t frame,
                     std::int64_t hostUs,
                     std::size_t matrix,
                     const Row& row,
                     std::span<const SignalKind> columns) {
  appendNumber(lines, static_cast<std::int64_t>(frame));
  lines += ',';
  appendNumber(lines, hostUs / kUsPerMs);
  lines += ',';
  appendNumber(lines, static_cast<std::int64_t>(matrix));
  for (const SignalKind kind : columns) {
    lines += ',';
    appendNumber(lines, valueIn(row, kind));
  }
}

}  // namespace

std::span<const SignalKind> signalColumnKinds(bool withComponents) {
  return std::span(kColumnKinds).first(signalKinds(withComponents).size());
}

std::string signalColumns(bool withComponents) {
  std::string line = "frame,time_ms,matrix";
  for (const SignalKind kind : signalColumnKinds(withComponents))
    line.append(",").append(signalName(kind));
  return line;
}

const std::string& unitOf(SignalKind kind, const HandDescription& hand) {
  static const std::string taxels = "taxels";
  static const std::string area = "mm^2";
  if (kind == SignalKind::kActive) return taxels;
  return kind == SignalKind::kArea ? area : hand.unit;
}

std::string signalUnits(const HandDescription& hand, bool withComponents) {
  std::vector<std::string> units = {"", "ms", ""};
  for (const SignalKind kind : signalColumnKinds(withComponents))
    units.push_back(unitOf(kind, hand));
  std::string line = csvLine(units);
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
  const std::span<const SignalKind> columns = signalColumnKinds(profile.givesReadings());
  TactileFrame frame;
  std::string lines;
  std::size_t written = 0;
  const auto write = [&](std::int64_t hostUs, const auto& rows) {
    lines.clear();
    for (std::size_t m = first; m < last; ++m) {
      appendSignalRow(lines, written, hostUs, m, rows[m], columns);
      lines += lineEnd;
    }
    sink(lines);
    ++written;
  };
  if (smooth.dependsOnRate()) smooth.validateForRate(timingOf(profile).rateHz);
  SignalFilter filter(smooth, layout.numMatrices(), write, profile.givesReadings());
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
