// What a batch can do with each recording: convert it, or compute a table of it. The tables are
// those of the commands of the same names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <palpate/batch/batch_run.h>
#include <palpate/batch/export_extras.h>
#include <palpate/batch/grasp_files.h>
#include <palpate/core/result_table.h>
#include <palpate/filter/recipe.h>
#include <palpate/model/time_base.h>
#include <palpate/recognition/feature_table.h>
#include <palpate/recognition/grasp_segments.h>
#include <palpate/recording/recording.h>
#include <palpate/signals/signal_rows.h>
#include <palpate/slip/slip_rows.h>

namespace palpate {

// Each throws std::invalid_argument where a filter is not allowed; the work throws Error for a
// matrix or frame that a recording doesn't have.

struct ConvertOptions {
  Recipe filters = {};
  ExportChoices choices = {};
  TimeChoice times = TimeChoice::kArrival;
};
// The form is that of the result's ending (formatOf()); requirePossible() says which choices it
// can have.
BatchTask convertTask(const ConvertOptions& options = {});

// A file for each grasp of a recording (grasp_files.h): the grasps are those of the recorded
// values, the files hold the filtered ones. The plan must be made with names.planned(). A recording
// without a grasp fails.
BatchTask graspsTask(const GraspTemplate& names, const ConvertOptions& options = {});

// A result table of a recording, as a command prints it and a batch writes it.
struct RecordingTable {
  // Everything besides the recording that the rows depend on, as in BatchTask.
  std::string options;
  // Makes the table; `file` is for messages. Throws Error, std::invalid_argument.
  std::function<std::unique_ptr<ResultTable>(
      const std::filesystem::path& file, const Recording& recording, const Progress& progress)>
      of;
  // What a row is, for what a batch says: "slip"; empty: it says how many frames were read.
  std::string rowNoun = {};
  bool unitsRow = false;  // of CSV
  bool readable = false;  // made of the readable part of a damaged recording, too
};
RecordingTable signalsOf(const SignalRowsOptions& options);
RecordingTable slipOf(const SlipRowsOptions& options);
struct GraspRowsOptions {
  GraspSegmentOptions segments = {};
  Recipe filters = {};  // of the frames, first
};
// Its work throws FileError for the rule `study` where the hand names no pads that pinch.
RecordingTable graspsOf(const GraspRowsOptions& options);

// Writes the table of each recording, in the form of the result's ending (result_file.h).
BatchTask tableTask(const RecordingTable& table);
inline BatchTask signalsTask(const SignalRowsOptions& options) {
  return tableTask(signalsOf(options));
}
inline BatchTask slipTask(const SlipRowsOptions& options) { return tableTask(slipOf(options)); }
// Without grasps with features the work fails. The class of a grasp is as in feature_table.h.
BatchTask featuresTask(std::optional<FeatureSet> set = {},
                       const Recipe& filters = {},
                       bool unitsRow = false);
}  // namespace palpate
