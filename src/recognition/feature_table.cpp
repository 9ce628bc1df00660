#include "palpate/recognition/feature_table.h"

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/parallel.h"
#include "palpate/core/text_table.h"
#include "palpate/library/recording_folder.h"
#include "palpate/model/hand_file.h"
#include "palpate/recognition/filtered_recording.h"
#include "palpate/recording/read_ahead.h"
#include "palpate/recording/recording.h"

namespace palpate {
namespace fs = std::filesystem;
namespace {

struct Source {
  fs::path file;
  std::string className;
};

// Result for one recording.
struct Gathered {
  std::vector<FeatureRow> rows;
  std::vector<std::string> problems;
  // What the features depend on; `names` are empty where the hand has none of the set.
  std::string sensor;
  std::vector<std::string> names;
  FeatureSet set = FeatureSet::kBest;
  bool pinches = false;
  bool failed = false;
  std::size_t failedGrasps = 0;
};

std::string spanText(const GraspFeatures& grasp) {
  return "grasp " + std::to_string(grasp.begin) + ".." + std::to_string(grasp.end);
}

// `alone`: no other recording is read at the same time.
Gathered gather(const Source& source, const FeatureExtractionOptions& options, bool alone) {
  Gathered out;
  const auto say = [&](const std::string& what) {
    out.problems.push_back(source.file.string() + ": " + what);
  };
  try {
    const Profile profile = filteredBy(
        options.filters,
        readRecording(source.file, {.threads = alone ? 0 : threadsBesideOthers(source.file)}),
        source.file);
    if (const std::string lost = lostText(profile); !lost.empty()) say(lost);
    out.set = options.set.value_or(defaultFeatureSet(profile.hand()));
    out.sensor = sensorText(profile.layout());
    out.pinches = pinchHandOf(profile.hand()) != nullptr;
    if (out.set == FeatureSet::kStatistics || out.pinches)
      out.names = featureNames(out.set, profile.hand());
    RecordingFeatures found = recordingFeatures(profile, out.set);
    if (!found.problem.empty()) say(found.problem);
    std::size_t number = 0;
    for (GraspFeatures& grasp : found.grasps) {
      ++number;
      if (!grasp.problem.empty()) {
        say(spanText(grasp) + ": " + grasp.problem);
        ++out.failedGrasps;
        continue;
      }
      out.rows.push_back({.className = source.className,
                          .file = source.file,
                          .begin = grasp.begin,
                          .end = grasp.end,
                          .initialFrame = grasp.initialFrame,
                          .endFrame = grasp.endFrame,
                          .timeUs = profile.frameTimeUs(grasp.begin),
                          .values = std::move(grasp.values),
                          .number = number,
                          .quality = grasp.quality});
    }
  } catch (const Error& error) {
    out.problems.emplace_back(error.what());  // names the file
    out.failed = true;
  }
  return out;
}

fs::path withoutSlash(const fs::path& folder) {
  return folder.has_filename() ? folder : folder.parent_path();
}

// Adds the recordings of a folder to `sources`, and a line to `problems` for each folder that
// cannot be read.
void addFolder(const fs::path& folder,
               std::vector<Source>& sources,
               std::vector<std::string>& problems) {
  RecordingFolder found = recordingsBelow(folder);
  if (found.files.empty() && found.problems.empty()) problems.push_back(noRecordingText(folder));
  std::move(found.problems.begin(), found.problems.end(), std::back_inserter(problems));
  for (const fs::path& file : found.files) {
    const fs::path rest = file.lexically_relative(folder);
    const bool inClass = !rest.empty() && std::next(rest.begin()) != rest.end();
    sources.push_back({file, inClass ? classOfFolder(*rest.begin()) : classOfFolder(folder)});
  }
}

}  // namespace

FeatureTable without(const FeatureTable& table, const std::set<LeftOutGrasp>& leftOut) {
  FeatureTable kept = table;
  std::erase_if(kept.rows, [&](const FeatureRow& row) {
    return leftOut.contains({row.file, row.begin});
  });
  return kept;
}

std::vector<std::int64_t> timesOf(const FeatureTable& table) {
  std::vector<std::int64_t> times;
  for (const FeatureRow& row : table.rows) times.push_back(row.timeUs);
  return times;
}

Eigen::MatrixXd valuesOf(const FeatureTable& table) {
  Eigen::MatrixXd x(static_cast<Eigen::Index>(table.rows.size()),
                    static_cast<Eigen::Index>(table.names.size()));
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    x.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::RowVectorXd>(table.rows[i].values.data(), x.cols());
  return x;
}

std::size_t keepNewestSession(FeatureTable& table) {
  std::vector<std::int64_t> timesUs;
  for (const FeatureRow& row : table.rows) timesUs.push_back(row.timeUs);
  std::sort(timesUs.begin(), timesUs.end());
  std::size_t first = timesUs.empty() ? 0 : timesUs.size() - 1;
  while (first > 0 && timesUs[first] - timesUs[first - 1] <= kSessionPauseUs) --first;
  if (first == 0) return 0;
  const std::int64_t fromUs = timesUs[first];
  return std::erase_if(table.rows, [&](const FeatureRow& row) { return row.timeUs < fromUs; });
}

std::vector<std::string> FeatureTable::classes() const {
  std::set<std::string> all;
  for (const FeatureRow& row : rows)
    if (!row.className.empty()) all.insert(row.className);
  return {all.begin(), all.end()};
}

std::string sensorText(const SensorLayout& layout) {
  std::string text;
  for (const MatrixLayout& matrix : layout.matrices())
    text += (text.empty() ? "" : ", ") + std::to_string(matrix.columns) + "x" +
            std::to_string(matrix.rows) + " " + pitchText(matrix.pitchMm, 2);
  return text;
}

std::string classOfFolder(const fs::path& folder) {
  std::error_code ignored;
  fs::path named = withoutSlash(folder);
  if (named.filename() == "." || named.filename() == ".." || named.empty())
    named = withoutSlash(fs::weakly_canonical(folder, ignored));
  std::string name = named.filename().string();
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

FeatureTable extractFeatures(const std::vector<fs::path>& paths,
                             const FeatureExtractionOptions& options,
                             const Progress& progress) {
  FeatureTable table;
  std::vector<Source> sources;
  for (const fs::path& path : paths) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
      addFolder(path, sources, table.problems);
    } else if (fs::exists(path, ignored)) {
      sources.push_back({path, {}});
    } else {
      throw FileError(path, "no such file or folder");
    }
  }
  table.numFiles = sources.size();
  std::vector<Gathered> gathered(sources.size());
  forEachInParallel(
      sources.size(),
      [&](std::size_t i) { gathered[i] = gather(sources[i], options, sources.size() == 1); },
      progress,
      options.threads);

  const auto first = std::find_if(
      gathered.begin(), gathered.end(), [](const Gathered& of) { return !of.names.empty(); });
  if (first != gathered.end()) {
    table.set = first->set;
    table.names = first->names;
    table.sensor = first->sensor;
  } else {
    table.set = options.set.value_or(FeatureSet::kBest);
    table.names = featureNames(table.set, defaultHand());
  }
  const auto read = std::find_if(
      gathered.begin(), gathered.end(), [](const Gathered& of) { return !of.sensor.empty(); });
  if (read != gathered.end()) table.handPinches = read->pinches;
  for (std::size_t i = 0; i < gathered.size(); ++i) {
    Gathered& of = gathered[i];
    if (!of.names.empty() && (of.sensor != table.sensor || of.names != table.names)) {
      of.problems = {sources[i].file.string() +
                     ": a recording of another sensor: its matrices are not those of the hand"};
      of.rows.clear();
    }
    table.failedFiles += of.failed ? 1 : 0;
    table.failedGrasps += of.failedGrasps;
    std::move(of.problems.begin(), of.problems.end(), std::back_inserter(table.problems));
    std::move(of.rows.begin(), of.rows.end(), std::back_inserter(table.rows));
  }
  if (table.rows.empty()) table.sensor.clear();
  return table;
}

std::unique_ptr<ResultTable> featureTable(FeatureTable table) {
  using Row = FeatureRow;
  std::vector<ColumnOf<Row>> columns = {
      columnOf<Row>("class", "", "what is held", &Row::className),
      columnOf<Row>("file", "", "the recording", [](const Row& row) { return row.file.string(); }),
      columnOf<Row>("begin", "", "first frame of the grasp", &Row::begin),
      columnOf<Row>("end", "", "last frame of the grasp", &Row::end),
      columnOf<Row>("initial_frame", "", "first frame that the features use", &Row::initialFrame),
      columnOf<Row>("end_frame", "", "last frame that the features use", &Row::endFrame)};
  for (std::size_t i = 0; i < table.names.size(); ++i)
    columns.push_back(columnOf<Row>(table.names[i],
                                    std::string(featureUnit(table.set, table.names[i])),
                                    featureMeaning(table.set, table.names[i]),
                                    [i](const Row& row) { return row.values[i]; }));
  return std::make_unique<RowTable<Row>>("features", std::move(columns), std::move(table.rows));
}

}  // namespace palpate
