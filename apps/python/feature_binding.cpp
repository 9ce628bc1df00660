// Binds palpate.grasps(), features() and Features.
#include <filesystem>
#include <string>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "palpate/core/error.h"
#include "palpate/model/hand_file.h"
#include "palpate/recognition/study_features.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/features.h"
#include "python/geometry.h"
#include "python/interruption.h"
#include "python/result_binding.h"

namespace palpate::python {
namespace py = pybind11;

FeatureSet featureSetOf(const std::string& name) {
  return choice<FeatureSet>("set", name, kFeatureSetWords);
}

namespace {

namespace fs = std::filesystem;

FeatureTable featureTableOf(const Profile& profile, FeatureSet set, const Progress& progress) {
  FeatureTable table;
  table.set = set;
  if (set == FeatureSet::kStatistics || pinchHandOf(profile.hand()))
    table.names = featureNames(set, profile.hand());
  table.numFiles = 1;
  table.sensor = sensorText(profile.layout());
  const RecordingFeatures found = recordingFeatures(profile, set, progress);
  if (!found.problem.empty()) table.problems.push_back(found.problem);
  for (const GraspFeatures& grasp : found.grasps) {
    if (!grasp.problem.empty()) {
      table.problems.push_back("frames " + std::to_string(grasp.begin) + " to " +
                               std::to_string(grasp.end) + ": " + grasp.problem);
      ++table.failedGrasps;
      continue;
    }
    FeatureRow row;
    row.begin = grasp.begin;
    row.end = grasp.end;
    row.initialFrame = grasp.initialFrame;
    row.endFrame = grasp.endFrame;
    row.timeUs = profile.frameTimeUs(grasp.begin);
    row.values = grasp.values;
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<fs::path> pathsOf(const py::object& source) {
  const bool one = py::isinstance<py::str>(source) || py::hasattr(source, "__fspath__");
  if (!one && !py::isinstance<py::sequence>(source))
    throw py::type_error("a source is a Profile, Features, a path, or a list of paths");
  if (one) return {source.cast<fs::path>()};
  std::vector<fs::path> paths;
  for (const py::handle item : source) paths.push_back(item.cast<fs::path>());
  if (paths.empty())
    throw py::value_error("the list of paths is empty: give a recording or a folder");
  return paths;
}

}  // namespace

FeatureTable featuresOf(const py::object& source, FeatureSet set) {
  if (py::isinstance<FeatureTable>(source)) {
    auto table = source.cast<FeatureTable>();
    if (table.set != set)
      throw Error("the features are of the set " + std::string(featureSetName(table.set)) +
                  ": compute them with set='" + std::string(featureSetName(set)) + "'");
    return table;
  }
  if (py::isinstance<Profile>(source)) {
    const auto profile = source.cast<Profile>();
    return unlocked(
        [&](const Progress& progress) { return featureTableOf(profile, set, progress); });
  }
  const std::vector<fs::path> paths = pathsOf(source);
  FeatureExtractionOptions options;
  options.set = set;
  return unlocked(
      [&](const Progress& progress) { return extractFeatures(paths, options, progress); });
}

void requireRows(const FeatureTable& table) {
  if (!table.rows.empty()) return;
  throw Error("no grasp with features in " + std::to_string(table.numFiles) +
              (table.numFiles == 1 ? " recording" : " recordings") +
              (table.problems.empty() ? "" : ": " + table.problems.front()));
}

namespace {

Table grasps(const Profile& profile, const std::string& rule) {
  GraspSegmentOptions options;
  options.rule = choice<GraspRule>("rule", rule, kGraspRuleWords);
  if (options.rule == GraspRule::kStudy && !(profile.hand().file && profile.hand().file->pinch))
    throw py::value_error("rule 'study' needs a hand with two pads that pinch: use 'general'");
  Table table =
      tableOf([&](const Progress& progress) { return graspTable(profile, options, progress); });
  const py::str key("fingers");
  py::list fingers;
  for (const py::handle text : py::object(table[key]))
    fingers.append(py::tuple(py::module_::import("builtins")
                                 .attr("map")(py::type::of(py::int_()), text.attr("split")())));
  table[key] = fingers;
  return table;
}

py::dict studyOf(const Profile& profile,
                 std::int64_t begin,
                 std::int64_t end,
                 std::optional<std::int64_t> endFrame) {
  GraspSegment grasp;
  grasp.begin = checkedIndex("frame", begin, profile.numFrames());
  grasp.end = checkedIndex("frame", end, profile.numFrames());
  if (grasp.begin > grasp.end) throw py::value_error("begin is after end");
  std::optional<std::size_t> chosen;
  if (endFrame) chosen = checkedIndex("frame", *endFrame, profile.numFrames());
  const auto hand = pinchHandOf(profile.hand());
  if (!hand) throw Error(withoutPinchText(profile.hand()));
  const StudyFeatures found =
      unlocked([&](const Progress&) { return studyFeatures(profile, grasp, *hand, chosen); });
  py::dict result;
  result["trouble"] = found.problem;
  result["initial_frame"] = found.initialFrame;
  result["end_frame"] = found.endFrame;
  result["other_end_frame"] = found.otherEndFrame;
  result["names"] = studyFeatureNames(*hand);
  result["values"] = arrayOf(found.values);
  return result;
}

// The features as a table; what their columns are, too.
Table tableOfFeatures(const FeatureTable& table) {
  return tableOf([&](const Progress&) { return featureTable(table); });
}

void bindWhole(py::class_<FeatureTable>& bound,
               const char* name,
               std::size_t FeatureRow::*of,
               const char* meaning) {
  bound.def_property_readonly(
      name,
      [of](const FeatureTable& table) {
        return column<std::int64_t>(table.rows.size(),
                                    [&](std::size_t i) { return table.rows[i].*of; });
      },
      meaning);
}

void bindTable(py::module_& module) {
  py::class_<FeatureTable> features(
      module, "Features", "The features of grasps, one row per grasp: from features().");
  features.def("__len__", [](const FeatureTable& table) { return table.rows.size(); })
      .def("__repr__",
           [](const FeatureTable& table) {
             return "<palpate.Features: " + std::to_string(table.rows.size()) + " grasps, " +
                    std::to_string(table.names.size()) + " features, set '" +
                    std::string(featureSetName(table.set)) + "'>";
           })
      .def_property_readonly(
          "set",
          [](const FeatureTable& table) { return std::string(featureSetName(table.set)); },
          "'study', 'best' or 'session'.")
      .def_property_readonly(
          "names", [](const FeatureTable& table) { return table.names; }, "Of the features.")
      .def_property_readonly(
          "values",
          [](const FeatureTable& table) { return arrayOf(valuesOf(table)); },
          "float64 (grasps, features), finite.")
      .def_property_readonly(
          "classes",
          [](const FeatureTable& table) { return membersOf(table.rows, &FeatureRow::className); },
          "Class of each grasp ('' where it isn't known): list of str.")
      .def_property_readonly(
          "files",
          [](const FeatureTable& table) {
            std::vector<std::string> names;
            for (const FeatureRow& row : table.rows) names.push_back(row.file.string());
            return names;
          },
          "Recording of each grasp ('' of a Profile): list of str.")
      .def_property_readonly(
          "time_ms",
          [](const FeatureTable& t) {
            return column<std::int64_t>(t.rows.size(),
                                        [&](std::size_t i) { return t.rows[i].timeUs / kUsPerMs; });
          },
          "Host time of frame `begin` [ms since 1970]: int64 (grasps,).")
      .def_property_readonly(
          "troubles",
          [](const FeatureTable& table) { return table.problems; },
          "Files that can't be read and grasps without features, with the reason: list of str.")
      .def_property_readonly(
          "sensor", [](const FeatureTable& table) { return table.sensor; }, "Sensor of all rows.")
      .def_property_readonly(
          "table",
          &tableOfFeatures,
          "Table with the columns of `palpate features`: class, file, begin, end, initial_frame, "
          "end_frame, then the features, (grasps,) each.");
  bindWhole(features, "begin", &FeatureRow::begin, "First frame of each grasp: int64 (grasps,).");
  bindWhole(
      features, "end", &FeatureRow::end, "Last frame of each grasp (inclusive): int64 (grasps,).");
  bindWhole(features,
            "initial_frame",
            &FeatureRow::initialFrame,
            "Frame at which each grasp begins for its features: int64 (grasps,).");
  bindWhole(features,
            "end_frame",
            &FeatureRow::endFrame,
            "Frame at which each grasp ends for its features: int64 (grasps,).");
}

}  // namespace

void bindFeatures(py::module_& module) {
  bindTable(module);
  module.def("grasps",
             &grasps,
             py::arg("profile"),
             py::kw_only(),
             py::arg("rule") = "general",
             "Finds the grasps: dict of columns begin, end (frames, both inclusive), begin_ms, "
             "end_ms [ms since 1970], fingers (list of tuples), quality (0..1). rule 'general': at "
             "least two fingers (or the only one) touch for more than 20 frames and 0.6 s; "
             "'study': the two pads that pinch for more than 20 frames.");
  module.def(
      "features",
      [](const py::object& source, const std::string& set) {
        return featuresOf(source, featureSetOf(set));
      },
      py::arg("source"),
      py::arg("set") = "best",
      "The features of every pinch grasp (both distal pads touch): source is a Profile, a "
      "recording, a folder that has a folder of recordings for each class ('_' in its name stands "
      "for a space), or a list of these paths. set 'best': also valid in another session; 'study': "
      "the study's 54; 'session': best, but only within one session; 'statistics': load, extent "
      "and position on every matrix, for hands of any kind. `troubles` lists what can't be used.");
  module.def(
      "feature_names",
      [](const std::string& set, const py::object& hand) {
        return featureNames(featureSetOf(set), handGiven(hand));
      },
      py::arg("set") = "best",
      py::arg("hand") = py::none(),
      "Names of the features of a set of a hand (None: the SDH-2): list of str.");
  module.def("study_features",
             &studyOf,
             py::arg("profile"),
             py::arg("begin"),
             py::arg("end"),
             py::kw_only(),
             py::arg("end_frame") = py::none(),
             "The study's 54 features of one grasp, frames begin..end (both inclusive): dict "
             "trouble (why there are none), initial_frame, end_frame, other_end_frame (the tied "
             "candidate), names, values (54,). end_frame: use the picture of this frame.");
}

}  // namespace palpate::python
