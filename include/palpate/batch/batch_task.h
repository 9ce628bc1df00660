// What a batch can do with each recording: convert it, or compute a table of it. The tables are
// those of the commands of the same names.
#pragma once

#include <cstdint>
#include <optional>

#include <palpate/batch/batch_run.h>
#include <palpate/batch/export_extras.h>
#include <palpate/batch/grasp_files.h>
#include <palpate/filter/recipe.h>
#include <palpate/model/time_base.h>
#include <palpate/recognition/feature_table.h>
#include <palpate/recording/recording.h>
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

struct SignalRowsOptions {
  std::optional<std::int64_t> matrix = {};  // only this one
  Recipe filters = {};                      // of the frames, first
  Recipe smooth = {};                       // of the signals, over time
  bool unitsRow = false;                    // a second row with the units
  TimeChoice times = TimeChoice::kArrival;
};
BatchTask signalsTask(const SignalRowsOptions& table);

BatchTask slipTask(const SlipRowsOptions& table);
// Without grasps with features the work fails. The class of a grasp is as in feature_table.h.
BatchTask featuresTask(std::optional<FeatureSet> set = {}, const Recipe& filters = {});
}  // namespace palpate
