#include "gui/timeline/curve_table.h"

#include <palpate/core/number_text.h>
#include <palpate/core/time.h>

#include "gui/appearance/plotted_signal.h"

namespace palpate::gui {
namespace {

// The value of a curve at a frame; joint angles and temperatures are the last ones at or before it.
std::string curveCell(const OpenedRecording& recording,
                      const SeriesChoice& choice,
                      std::size_t frame) {
  const auto of = [](const std::vector<double>& values, std::size_t index) {
    return index < values.size() ? numberText(values[index]) : std::string();
  };
  switch (choice.kind) {
    case SeriesChoice::Kind::kMatrix:
      return numberText(valueOf(recording.at(frame, choice.index), choice.signal));
    case SeriesChoice::Kind::kForce:
      return {};
    case SeriesChoice::Kind::kTaxels:
      return numberText(meanOf(recording.profile.frame(frame), choice.taxels));
    case SeriesChoice::Kind::kAngle: {
      const auto angles = recording.profile.anglesAtFrame(frame);
      return angles ? of(angles->deg, choice.index) : std::string();
    }
    case SeriesChoice::Kind::kTemperature: {
      const auto temperatures = recording.profile.temperaturesAtFrame(frame);
      return temperatures ? of(temperatures->degC, choice.index) : std::string();
    }
  }
  return {};
}

}  // namespace

TextTable curveTable(const OpenedRecordingPtr& recording,
                     const std::vector<PlottedCurve>& curves,
                     const FrameSpan& span) {
  TextTable table{.header = {"frame", "time_ms", "time_s"}, .numRows = span.count()};
  std::vector<SeriesChoice> choices;
  for (const PlottedCurve& curve : curves) {
    choices.push_back(curve.choice);
    const bool ofMatrix = curve.choice.kind == SeriesChoice::Kind::kMatrix;
    table.header.push_back(
        (curve.name + (ofMatrix ? " " + nameOf(curve.choice.signal) : "") + " [" + curve.unit + "]")
            .toStdString());
  }
  table.row = [recording, choices, first = span.first](std::size_t row) {
    const std::size_t frame = first + row;
    std::vector<std::string> cells = {
        std::to_string(frame),
        std::to_string(recording->profile.frameTimeUs(frame) / kUsPerMs),
        numberText(recording->timeAt(frame))};
    for (const SeriesChoice& choice : choices)
      cells.push_back(curveCell(*recording, choice, frame));
    return cells;
  };
  return table;
}

}  // namespace palpate::gui
