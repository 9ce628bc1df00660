// The features of many recordings as one table: what training, evaluation and `palpate features`
// begin with.
//
// A folder holds one folder per class; the class is that folder's name with '_' as blank
// ("golf_ball": "golf ball"), and all recordings below it are the class's. A recording that lies in
// the folder itself belongs to the class of the folder's own name; one that is named by itself has
// no class.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <palpate/core/progress.h>
#include <palpate/recognition/grasp_features.h>

namespace palpate {

// One grasp.
struct FeatureRow {
  std::string className;       // empty: not known
  std::filesystem::path file;  // as given, joined with the rest
  std::size_t begin = 0, end = 0;
  std::size_t initialFrame = 0, endFrame = 0;
  std::int64_t timeUs = 0;     // host time of frame `begin` [us since 1970]
  std::vector<double> values;  // finite, one per name
};

struct FeatureTable {
  FeatureSet set = FeatureSet::kBest;
  std::vector<std::string> names;  // of the features
  std::vector<FeatureRow> rows;    // by path as the words name them, sorted; within a file by time
  // The sensor of all rows, as a text to compare: matrices with sizes and pitch. Empty without
  // rows.
  std::string sensor;
  // A line each: a file that can't be read, one without a grasp, a grasp without features, and why.
  std::vector<std::string> problems;
  std::size_t numFiles = 0;      // recordings that were found
  std::size_t failedFiles = 0;   // of them, those that could not be read
  std::size_t failedGrasps = 0;  // grasps without features

  // Place of a feature by its name.
  std::optional<std::size_t> column(std::string_view name) const noexcept;
  // The classes of the rows, sorted, each once; without class: none.
  std::vector<std::string> classes() const;
};

// Of each row: when it began [us since 1970]; its features, a row each.
std::vector<std::int64_t> timesOf(const FeatureTable& table);
Eigen::MatrixXd valuesOf(const FeatureTable& table);

// A session ends where no grasp comes for longer: the hand reads sizes differently in the next one.
constexpr std::int64_t kSessionPauseUs = 8LL * 3600 * 1'000'000;
// Keeps the rows of the newest session; returns how many rows of earlier ones were left out.
std::size_t keepNewestSession(FeatureTable& table);

// "6x14 3.4 mm, ..": what must agree between a model and a recording.
std::string sensorText(const SensorLayout& layout);

// "golf_ball": "golf ball".
std::string classOfFolder(const std::filesystem::path& folder);

struct FeatureExtractionOptions {
  FeatureSet set = FeatureSet::kBest;
  PinchHand hand = sdh2PinchHand();
  // 0: as many as the machine runs at once; the table doesn't depend on it
  std::size_t threads = 0;
};

// Paths: folders (as above) and recordings. One bad file doesn't stop the others. Throws Cancelled;
// FileError when a path isn't there.
FeatureTable extractFeatures(const std::vector<std::filesystem::path>& paths,
                             const FeatureExtractionOptions& options = {},
                             const Progress& progress = {});

}  // namespace palpate
