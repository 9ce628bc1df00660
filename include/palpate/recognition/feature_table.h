// Feature table: the features of all grasps of many recordings. Training, evaluation and `palpate
// features` start from it.
//
// A folder contains one folder per class. The name of the class is the name of that folder with '_'
// replaced by a blank ("golf_ball": "golf ball"), and all recordings below it belong to the class.
// A recording directly in the given folder belongs to the class named after that folder; a
// recording that is given by itself has no class.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <palpate/core/progress.h>
#include <palpate/core/result_table.h>
#include <palpate/filter/recipe.h>
#include <palpate/recognition/grasp_features.h>

namespace palpate {

// Features of one grasp.
struct FeatureRow {
  // Empty: not known.
  std::string className;
  // Path of the recording, below the path as it was given.
  std::filesystem::path file;
  // First and last frame of the grasp, both inclusive.
  std::size_t begin = 0, end = 0;
  // See GraspFeatures.
  std::size_t initialFrame = 0, endFrame = 0;
  // Host time of frame `begin` [us since 1970].
  std::int64_t timeUs = 0;
  // One finite value per feature.
  std::vector<double> values;
  // Number of the grasp among all of its recording, from 1; grasps without features are counted.
  std::size_t number = 0;
  // GraspSegment::quality, 0..1.
  double quality = 0.0;
};

struct FeatureTable {
  FeatureSet set = FeatureSet::kBest;
  // Whether the hand of the recordings has two pads that pinch, as all sets but `statistics` need.
  bool handPinches = true;
  // Names of the features.
  std::vector<std::string> names;
  // In the order of the given paths, within a folder sorted by path, within a file by time.
  std::vector<FeatureRow> rows;
  // The sensor of all rows as a text that can be compared (sensorText()). Empty without rows.
  std::string sensor;
  // One line for each file that can't be read or has no grasp, and for each grasp without features,
  // with the reason.
  std::vector<std::string> problems;
  // Number of recordings that were found.
  std::size_t numFiles = 0;
  // Number of recordings that could not be read.
  std::size_t failedFiles = 0;
  // Number of grasps without features.
  std::size_t failedGrasps = 0;

  // The classes of the rows, sorted, each once. Rows without a class are ignored.
  std::vector<std::string> classes() const;
};

// A grasp that is left out of a table: its recording as FeatureRow::file, and its first frame.
struct LeftOutGrasp {
  std::filesystem::path file;
  std::size_t begin = 0;
  auto operator<=>(const LeftOutGrasp&) const = default;
};
// The table without these grasps; one that it doesn't have is ignored.
FeatureTable without(const FeatureTable& table, const std::set<LeftOutGrasp>& leftOut);

// Host time at which each grasp began [us since 1970], and the features as a matrix with one row
// per grasp.
std::vector<std::int64_t> timesOf(const FeatureTable& table);
Eigen::MatrixXd valuesOf(const FeatureTable& table);

// A pause between grasps that is longer than this [us] begins a new session. Measured sizes have
// another offset in the next session (session_offset.h).
constexpr std::int64_t kSessionPauseUs = 8LL * 3600 * 1'000'000;
// Keeps the rows of the newest session; returns the number of rows that were removed.
std::size_t keepNewestSession(FeatureTable& table);

// Columns, rows and pitch of every matrix, such as "6x14 3.40 mm, ..". A model and a recording must
// have the same text.
std::string sensorText(const SensorLayout& layout);

// Returns the class of a folder: "golf ball" for "golf_ball".
std::string classOfFolder(const std::filesystem::path& folder);

struct FeatureExtractionOptions {
  // Empty: that of the first recording's hand (defaultFeatureSet()).
  std::optional<FeatureSet> set = std::nullopt;
  // Number of threads; 0: as many as the machine runs at once. The table does not depend on it.
  std::size_t threads = 0;
  // The recordings are filtered first.
  Recipe filters = {};
};

// Extracts the features of all recordings in the given folders (as above) and files. The first
// recording that can be read decides of which hand the table is; one of another sensor is left out
// and reported, as is one that can't be read: neither stops the others. Throws Cancelled; FileError
// when a path does not exist.
FeatureTable extractFeatures(const std::vector<std::filesystem::path>& paths,
                             const FeatureExtractionOptions& options = {},
                             const Progress& progress = {});

// The table as a result table: class, file, first and last frame, those that the features use, then
// the features.
std::unique_ptr<ResultTable> featureTable(FeatureTable table);

}  // namespace palpate
