// Binds palpate.Model.
#include <filesystem>
#include <string>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/recognition/model_evaluation.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/features.h"
#include "python/interruption.h"
#include "python/models.h"

namespace palpate::python {
namespace py = pybind11;

void stampProvenance(TrainedModel& model) {
  model.programVersion = PALPATE_VERSION;
  model.madeAt = utcStamp();
}

std::vector<ModelInput> inputsFor(const FeatureTable& table, const Progress& progress) {
  for (const FeatureRow& row : table.rows)
    if (row.file.empty()) return {};
  return inputsOf(table, progress);
}

namespace {

OffsetChoice offsetOf(const py::object& offset) {
  if (py::isinstance<py::str>(offset)) return OffsetChoice::from(offset.cast<std::string>());
  return OffsetChoice::from(numberText(offset.cast<double>()));
}

Json offsetJson(const SessionOffset& offset) {
  return Json::object()
      .set("mm", offset.mm)
      .set("sd_mm", offset.sdMm)
      .set("origin", offsetSourceName(offset.origin))
      .set("grasps", offset.grasps)
      .set("objects", offset.objects)
      .set("trusted", offset.trusted)
      .set("text", offset.text());
}

py::object classify(const TrainedModel& model, const py::object& source, const py::object& offset) {
  const OffsetChoice chosen = offsetOf(offset);
  const FeatureTable table = featuresOf(source, model.set);
  Json grasps = Json::array(), warnings = jsonList(table.problems);
  Classification said;
  if (!table.rows.empty()) said = classifyTable(model, table, chosen);
  for (const std::string& warning : said.use.warnings) warnings.push(warning);
  for (std::size_t i = 0; i < said.predictions.size(); ++i)
    grasps.push(predictionJson(model, table.rows[i], said.predictions[i]));
  return toPython(Json::object()
                      .set("grasps", std::move(grasps))
                      .set("session_offset", offsetJson(said.use.offset))
                      .set("warnings", std::move(warnings)));
}

py::object evaluateWith(const TrainedModel& model,
                        const py::object& source,
                        std::size_t adapt,
                        const py::object& offset) {
  EvaluationOptions options;
  options.adaptPerClass = adapt;
  options.offset = offsetOf(offset);
  const FeatureTable table = featuresOf(source, model.set);
  requireRows(table);
  requireFits(model, table);
  const SampleSet samples = samplesOf(table, model.classes);
  const std::vector<std::int64_t> times = timesOf(table);
  const ModelEvaluation evaluation =
      unlocked([&](const Progress&) { return evaluateModel(model, samples, times, options); });
  return toPython(jsonOf(evaluation));
}

TrainedModel adapted(const TrainedModel& model, const py::object& source) {
  FeatureTable table = featuresOf(source, model.set);
  requireRows(table);
  requireFits(model, table);
  const std::size_t earlier = keepNewestSession(table);
  if (earlier > 0 &&
      PyErr_WarnEx(PyExc_UserWarning,
                   (std::to_string(earlier) +
                    " grasps of an earlier session, more than 8 h before the others, are left out")
                       .c_str(),
                   1) != 0)
    throw py::error_already_set();
  const SampleSet today = samplesOf(table, model.classes);
  return unlocked([&](const Progress& progress) {
    TrainedModel result = model;
    adaptModel(result, today);
    result.adaptedFrom = inputsFor(table, progress);
    stampProvenance(result);
    return result;
  });
}

}  // namespace

void bindModels(py::module_& module) {
  py::class_<TrainedModel>(module,
                           "Model",
                           "A trained model of objects: from train() or Model.load(). It never "
                           "changes: adapt() returns another one. Several threads may use one.")
      .def_static(
          "load",
          [](const std::filesystem::path& path) {
            return unlocked([&](const Progress&) { return loadModel(path); });
          },
          py::arg("path"),
          "Reads a model file (JSON). OSError, ValueError (not a model, damaged; says what is "
          "wrong).")
      .def(
          "save",
          [](const TrainedModel& model, const std::filesystem::path& path, bool force) {
            const py::gil_scoped_release released;
            saveModel(model, path, force ? Overwrite::kReplace : Overwrite::kRefuse);
          },
          py::arg("path"),
          py::kw_only(),
          py::arg("force") = false,
          "Writes it to a file. OSError when the file exists (unless force) or can't be written.")
      // Models never change: a copy is the same one.
      .def("__copy__", [](const py::object& self) { return self; })
      .def("__deepcopy__", [](const py::object& self, const py::dict&) { return self; })
      .def(py::pickle(
          [](const TrainedModel& model) {
            return py::make_tuple(py::bytes(jsonOf(model).text(-1)));
          },
          [](const py::tuple& state) {
            if (state.size() != 1) throw py::value_error("this isn't a pickled palpate.Model");
            const auto text = state[0].cast<std::string>();
            try {
              return trainedModelFrom(Json::parse(text));
            } catch (const Error& error) {
              throw py::value_error(std::string("this isn't a pickled palpate.Model: ") +
                                    error.what());
            }
          }))
      .def("classify",
           &classify,
           py::arg("source"),
           py::kw_only(),
           py::arg("session_offset") = "model",
           "Names the grasped objects: source as for features(), all of one day. dict grasps "
           "[{file, begin, end, label ('unknown' is one), confidence (0..1), sure, membership "
           "('known', 'unknown' or 'not_known_yet'), novelty, top [{label, p}], best first}], "
           "session_offset {mm, sd_mm [mm], origin, grasps, objects, trusted, text}, warnings. "
           "session_offset: 'model' (what adapt() stored; 0 in a fresh model in the session of its "
           "training, else not known), 'none' (summed over all), 'batch' (from these grasps), or "
           "mm. Error for another sensor.")
      .def("evaluate",
           &evaluateWith,
           py::arg("source"),
           py::kw_only(),
           py::arg("adapt") = EvaluationOptions{}.adaptPerClass,
           py::arg("session_offset") = "model",
           "Evaluates the model on recordings with known classes: dict accuracy, interval (Wilson, "
           "95 %), grasps, right, top3, coverage, accuracy_when_sure, sessions, classes, confusion "
           "{labels, counts[truth][called]}, .. adapt: this many grasps of each class and "
           "session, the first ones, adapt the model and don't count.")
      .def("adapt",
           &adapted,
           py::arg("source"),
           "Adapts the model to today's session by labelled grasps, from which it also finds the "
           "session offset; returns another model. Error when the classifier can't adapt (only "
           "gauss can).")
      .def("__repr__",
           [](const TrainedModel& m) {
             return "<palpate.Model: " + std::to_string(m.classes.size()) + " classes, set '" +
                    std::string(featureSetName(m.set)) + "', " +
                    std::string(classifierName(m.pipeline.classifier)) + ">";
           })
      .def_property_readonly(
          "classes", [](const TrainedModel& m) { return m.classes; }, "Names: list of str.")
      .def_property_readonly(
          "features",
          [](const TrainedModel& m) { return m.features; },
          "Names of the features that it uses: list of str.")
      .def_property_readonly(
          "set",
          [](const TrainedModel& m) { return std::string(featureSetName(m.set)); },
          "'study', 'best' or 'session'.")
      .def_property_readonly(
          "classifier",
          [](const TrainedModel& m) { return std::string(classifierName(m.pipeline.classifier)); },
          "'svm', 'qda', 'lda' or 'gauss'.")
      .def_property_readonly(
          "carries_over",
          [](const TrainedModel& m) { return m.adaptsToSession(); },
          "Whether it can adapt to another session, by a session offset.")
      .def_property_readonly(
          "session_offset",
          [](const TrainedModel& m) { return toPython(offsetJson(m.offset)); },
          "What adapt() stored: dict mm, sd_mm [mm], origin, grasps, objects, trusted, text.")
      .def_property_readonly(
          "validation",
          [](const TrainedModel& m) { return toPython(m.validation); },
          "Its results on blocks of its training recordings: dict.")
      .def_property_readonly(
          "options",
          [](const TrainedModel& m) { return toPython(m.options); },
          "The options of its training: dict.")
      .def_property_readonly(
          "inputs",
          [](const TrainedModel& m) { return membersOf(m.inputs, &ModelInput::file); },
          "The recordings that it was trained with: list of str.");
}

}  // namespace palpate::python
