// Filters a recording by a recipe in the background; delivers the filtered recording, and cost and
// latency of each step.
#pragma once

#include <optional>
#include <vector>

#include <palpate/filter/recipe.h>

#include "gui/source/latest_answer.h"
#include "gui/source/opened_recording.h"

namespace palpate::gui {

struct FilterFigures {
  // Time per step and frame [us]; 0: the step is off.
  std::vector<double> costsUs;
  // Latency of each step [frames]; nothing: a step of load never appears in its output.
  std::vector<std::optional<int>> latencies;
  // Latency of the whole chain [frames]; nothing as above.
  std::optional<int> latency;
};

// Returns the recording with filtered values, and seen over these baselines where they are given;
// time stamps, joint angles, events and the saturated
// frames are those of the source. Throws std::invalid_argument (the recipe names a matrix that the
// hand doesn't have), Error, Cancelled.
OpenedRecordingPtr filteredRecording(const OpenedRecordingPtr& source,
                                     const Recipe& recipe,
                                     const Progress& progress = {},
                                     const std::optional<Baselines>& baselines = {});
// Measures the costs on up to 200 frames around the frame of largest sum (of a long recording,
// around the middle frame).
FilterFigures figuresOf(const OpenedRecording& source, const Recipe& recipe);

struct FilterQuestion {
  OpenedRecordingPtr source;
  Recipe recipe;
  std::optional<Baselines> baselines = {};
};

struct FilterAnswer {
  OpenedRecordingPtr source;
  OpenedRecordingPtr filtered;
  // Once they are measured.
  std::optional<FilterFigures> figures = {};
};

class FilterWorker : public LatestAnswer<FilterQuestion, FilterAnswer> {
  Q_OBJECT
 public:
  explicit FilterWorker(QObject* parent = nullptr);

 signals:
  void made(const palpate::gui::OpenedRecordingPtr& source,
            const palpate::gui::OpenedRecordingPtr& filtered);
  void measured(const palpate::gui::FilterFigures& figures);
  void failed(const QString& message);
};

}  // namespace palpate::gui
