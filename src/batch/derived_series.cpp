#include "palpate/batch/derived_series.h"

#include <cstdint>
#include <string>
#include <utility>

#include "palpate/signals/characteristic_signals.h"
#include "palpate/signals/signal_rows.h"
#include "palpate/slip/slip_rows.h"
#include "palpate/slip/slip_segments.h"

namespace palpate {
namespace {

// A frame, with a value of each matrix.
template <typename Value>
struct FrameRow {
  std::int64_t timeUs = 0;  // [us since 1970]
  std::vector<Value> values;
};

template <typename Value>
std::vector<ColumnOf<FrameRow<Value>>> timeColumn() {
  return {columnOf<FrameRow<Value>>(
      "time_us", "us", "host time, since 1970", &FrameRow<Value>::timeUs)};
}

// Appends the columns of a value: "m3/dx", "whole/mean".
template <typename Value>
void appendGroup(std::vector<ColumnOf<FrameRow<Value>>>& columns,
                 const std::string& group,
                 std::size_t value,
                 std::vector<ColumnOf<Value>> ofValue) {
  for (ColumnOf<Value>& each : ofValue) each.column.name = group + "/" + each.column.name;
  appendColumns(columns, ofValue, [value](const FrameRow<Value>& row) -> const Value& {
    return row.values[value];
  });
}

std::string groupOf(std::size_t matrix) { return "m" + std::to_string(matrix); }

std::unique_ptr<ExportedSeries> signalSeries(const Profile& profile) {
  using Row = FrameRow<CharacteristicSignals>;
  const std::vector<ColumnOf<SignalValues>> described = signalColumns(profile.hand().unit, true);
  const auto columnsOfKinds = [&](bool withComponents) {
    std::vector<ColumnOf<CharacteristicSignals>> columns;
    for (const SignalKind kind : signalKinds(withComponents))
      columns.push_back({columnNamed(described, signalName(kind)).column,
                         [kind](const auto& signals) { return Cell(valueOf(signals, kind)); }});
    return columns;
  };
  std::vector<ColumnOf<Row>> columns = timeColumn<CharacteristicSignals>();
  const std::size_t numMatrices = profile.layout().numMatrices();
  for (std::size_t m = 0; m < numMatrices; ++m)
    appendGroup(columns, groupOf(m), m, columnsOfKinds(profile.givesReadings()));
  // The whole hand has no components.
  appendGroup(columns, "whole", numMatrices, columnsOfKinds(false));
  auto table = std::make_unique<RowTable<Row>>(
      "signals",
      std::move(columns),
      [profile, frame = TactileFrame(), index = std::size_t{0}](std::vector<Row>& rows) mutable {
        if (index == profile.numFrames()) return false;
        profile.readFrame(index++, frame);
        rows.push_back({frame.hostUs, {}});
        allSignals(frame, rows.back().values);
        return true;
      });
  return std::make_unique<ExportedSeries>(std::move(table), profile.numFrames());
}

// Of a matrix that is not touched only `active` and `slipping` are known.
ColumnOf<SlipDetection> whereTouched(ColumnOf<SlipDetection> of) {
  if (of.column.name == "active" || of.column.name == "slipping") return of;
  return {of.column, [cell = of.cell](const SlipDetection& detection) {
            return detection.motion.active == 0 ? Cell() : cell(detection);
          }};
}

std::unique_ptr<ExportedSeries> slipSeries(const Profile& profile,
                                           const DerivedSeriesOptions& options) {
  using Row = FrameRow<SlipDetection>;
  const std::vector<ColumnOf<SlipDetection>> all = slipColumns();
  std::vector<ColumnOf<SlipDetection>> ofMatrix;
  for (const char* name : {"active",
                           "dx",
                           "dy",
                           "ref_dx",
                           "ref_dy",
                           "rotation_deg",
                           "ref_rotation_deg",
                           "confidence",
                           "p_moved",
                           "state",
                           "slipping"})
    ofMatrix.push_back(whereTouched(
        std::string_view(name) == "state"
            ? columnOf<SlipDetection>("state",
                                      "",
                                      "what the contact does, 0 invalid to 5 slip",
                                      [](const auto& v) { return static_cast<int>(v.state); })
            : columnNamed(all, name)));
  std::vector<ColumnOf<Row>> columns = timeColumn<SlipDetection>();
  for (std::size_t m = 0; m < profile.layout().numMatrices(); ++m)
    appendGroup(columns, groupOf(m), m, ofMatrix);
  auto table = std::make_unique<RowTable<Row>>(
      "slip",
      std::move(columns),
      [run = std::make_shared<SlipRun>(
           profile, SlipRunOptions{.detector = options.detector, .threads = options.threads})](
          std::vector<Row>& rows) {
        if (!run->next()) return false;
        rows.push_back({run->timeUs(), run->detections()});
        return true;
      });
  return std::make_unique<ExportedSeries>(std::move(table), profile.numFrames());
}

}  // namespace

std::vector<std::unique_ptr<ExportedSeries>> derivedSeries(const Profile& profile,
                                                           const DerivedSeriesOptions& options) {
  std::vector<std::unique_ptr<ExportedSeries>> series;
  if (options.withSignals) series.push_back(signalSeries(profile));
  if (options.withSlip) series.push_back(slipSeries(profile, options));
  return series;
}

}  // namespace palpate
