#include "gui/timeline/curve_table.h"

#include <cmath>
#include <memory>
#include <mutex>
#include <stdexcept>

#include <palpate/core/number_text.h>
#include <palpate/core/time.h>

#include "gui/appearance/plotted_signal.h"

namespace palpate::gui {
namespace {

// The value of a curve at a frame; of a series it is the last one at or before it, of the hand's
// series also the first one before that.
std::string curveCell(const OpenedRecording& recording,
                      const Profile& profile,
                      const SeriesChoice& choice,
                      const std::optional<SeriesColumn>& column,
                      std::size_t frame) {
  if (column) {
    const auto sample = profile.sampleAtFrame(column->series, frame);
    if (!sample || column->column >= sample->values.size() ||
        (column->series >= kHandSeries && sample->hostUs > profile.frameTimeUs(frame)))
      return {};
    const double value = sample->values[column->column];
    return std::isnan(value) ? std::string() : numberText(value);
  }
  if (choice.kind == SeriesChoice::Kind::kMatrix)
    return numberText(valueOf(recording.at(frame, choice.index), choice.signal));
  if (choice.kind == SeriesChoice::Kind::kTaxels)
    return numberText(meanOf(profile.frame(frame), choice.taxels));
  return {};  // of a formula: FormulaColumn
}

// The values of a formula at the frames of a span, computed when the first one is asked for.
class FormulaColumn {
 public:
  FormulaColumn(OpenedRecordingPtr recording,
                Profile profile,
                SeriesChoice choice,
                const FrameSpan& span)
      : recording_(std::move(recording)),
        profile_(std::move(profile)),
        choice_(std::move(choice)),
        span_(span) {}

  std::string cell(std::size_t row) {
    std::call_once(computed_, [this] {
      try {
        values_ =
            readSeries(
                profile_, choice_, recording_->timeAt(span_.first), recording_->timeAt(span_.last))
                .values;
      } catch (const std::invalid_argument&) {
        // It can't be computed of this recording: the cells stay empty.
      }
    });
    return row < values_.size() && std::isfinite(values_[row]) ? numberText(values_[row])
                                                               : std::string();
  }

 private:
  OpenedRecordingPtr recording_;
  Profile profile_;
  SeriesChoice choice_;
  FrameSpan span_;
  std::once_flag computed_;
  std::vector<double> values_;
};

}  // namespace

TextTable curveTable(const OpenedRecordingPtr& recording,
                     const std::vector<PlottedCurve>& curves,
                     const FrameSpan& span,
                     const std::optional<Profile>& with) {
  const Profile profile = with.value_or(recording->profile);
  TextTable table{.header = {"frame", "time_ms", "time_s"}, .numRows = span.count()};
  std::vector<SeriesChoice> choices;
  std::vector<std::optional<SeriesColumn>> columns;
  // Null for the others.
  std::vector<std::shared_ptr<FormulaColumn>> formulas;
  for (const PlottedCurve& curve : curves) {
    choices.push_back(curve.choice);
    columns.push_back(columnOf(profile, curve.choice));
    formulas.push_back(curve.choice.kind == SeriesChoice::Kind::kFormula
                           ? std::make_shared<FormulaColumn>(recording, profile, curve.choice, span)
                           : nullptr);
    const bool ofMatrix = curve.choice.kind == SeriesChoice::Kind::kMatrix;
    table.header.push_back((curve.name + (ofMatrix ? " " + nameOf(curve.choice.signal) : "") +
                            (curve.baseUnit.isEmpty() ? "" : " [" + curve.baseUnit + "]"))
                               .toStdString());
  }
  table.row = [recording, profile, choices, columns, formulas, first = span.first](
                  std::size_t row) {
    const std::size_t frame = first + row;
    std::vector<std::string> cells = {
        std::to_string(frame),
        std::to_string(recording->profile.frameTimeUs(frame) / kUsPerMs),
        numberText(recording->timeAt(frame))};
    for (std::size_t i = 0; i < choices.size(); ++i)
      cells.push_back(formulas[i] ? formulas[i]->cell(row)
                                  : curveCell(*recording, profile, choices[i], columns[i], frame));
    return cells;
  };
  return table;
}

}  // namespace palpate::gui
