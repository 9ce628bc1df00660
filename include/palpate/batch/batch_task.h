// What a batch can do with each recording: convert it, or compute a table of it. The tables are
// those of the commands of the same names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <palpate/batch/batch_run.h>
#include <palpate/batch/export_extras.h>
#include <palpate/batch/grasp_files.h>
#include <palpate/filter/recipe.h>
#include <palpate/recognition/feature_table.h>
#include <palpate/recording/recording.h>
#include <palpate/slip/slip_segments.h>

namespace palpate {

// Each throws std::invalid_argument where a filter is not allowed; the work throws Error for a
// matrix or frame that a recording doesn't have.

struct ConvertOptions {
  Recipe filters = {};
  ExportChoices choices = {};
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
};
BatchTask signalsTask(const SignalRowsOptions& table);

struct SlipRowsOptions {
  SlipRunOptions pass = {};
  std::optional<std::int64_t> matrix = {};
  bool segments = false;  // a row per slip instead of one per frame and matrix
  bool unitsRow = false;  // a second row with the units
  Recipe filters = {};    // of the frames, first
};
BatchTask slipTask(const SlipRowsOptions& table);
// Set the method by its name (slip_method.h), and the reference: "first", "rest", or the number of
// a frame. Both throw std::invalid_argument.
void setSlipMethod(SlipRowsOptions& table, std::string_view name);
void setSlipReference(SlipRowsOptions& table, const std::string& word);
// Throws Error when the recording hasn't the matrix or the reference frame of the table.
void requireThere(const std::filesystem::path& file,
                  const Profile& profile,
                  const SlipRowsOptions& table);

// Without grasps with features the work fails. The class of a grasp is as in feature_table.h.
BatchTask featuresTask(std::optional<FeatureSet> set = {}, const Recipe& filters = {});
// The lines of `palpate features`, each with its line end.
std::string featureHeaderLine(const FeatureTable& table);
std::string featureLine(const FeatureRow& row);

// The filtered recording; the recording itself when the recipe is empty. Events "settings" restart
// the filters over time. Throws Error (a matrix that the recording does not have; an unreadable
// file) and Cancelled.
Profile filteredRecording(const Recipe& recipe,
                          const Profile& profile,
                          const std::filesystem::path& file,
                          const Progress& progress = {});
// Throws Error when the recipe has a frequency that is not below half of the recording's rate (1 /
// median interval); for filters of signals.
void requireBelowHalfRate(const Recipe& recipe,
                          const Profile& profile,
                          const std::filesystem::path& file);

}  // namespace palpate
