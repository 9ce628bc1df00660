// Binds palpate.calibrate_noise(), calibrate_sensitivity(), calibrate_tare(), calibrate_pressure()
// and Calibration.
#include <filesystem>
#include <limits>
#include <string>
#include <utility>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "palpate/calibration/calibration_samples.h"
#include "palpate/calibration/force_series.h"
#include "palpate/calibration/noise_floor.h"
#include "palpate/calibration/sensitivity_curve.h"
#include "palpate/core/hash.h"
#include "palpate/core/output_file.h"
#include "palpate/recording/recording.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/calibrations.h"
#include "python/interruption.h"

namespace palpate::python {
namespace py = pybind11;

PressureMapOptions pressureOptionsOf(const ForceChoice& choice,
                                     const Calibration& calibration,
                                     const Profile& profile) {
  PressureMapOptions options{.compensateDrift = choice.drift, .serial = profile.info().serial};
  if (choice.sensitivity || choice.threshold) {
    SensorSettings settings = calibration.settings;
    settings.sensitivity = choice.sensitivity.value_or(settings.sensitivity);
    settings.thresholdCounts = choice.threshold.value_or(settings.thresholdCounts);
    options.settings.push_back(settings);
  }
  return options;
}

std::optional<Tare> tareOf(const ForceChoice& choice,
                           const Profile& profile,
                           const Progress& progress) {
  if (!choice.tare) return std::nullopt;
  return findTare(profile, {}, progress);
}

namespace {

namespace fs = std::filesystem;

py::object calibrateNoise(const Profile& profile, std::size_t bins) {
  const NoiseFloorOptions options{.bins = bins};
  return toPython(jsonOf(unlocked(
      [&](const Progress& progress) { return fitNoiseFloor(profile, options, progress); })));
}

void saveNoise(const py::object& noise, const fs::path& path, bool force) {
  const Json json = toJson(noise);
  const NoiseFloor floor = noiseFloorFrom(json);
  OutputFile file(path, force ? Overwrite::kReplace : Overwrite::kRefuse);
  file.write(path.extension() == ".xml" ? noiseXml(floor) : json.text() + "\n");
  file.commit();
}

py::object calibrateSensitivity(const Numbers& sensitivities,
                                const Numbers& gains,
                                double threshold) {
  const std::vector<double> settings = vectorOf(sensitivities, "sensitivities"),
                            values = vectorOf(gains, "K");
  if (settings.size() != values.size())
    throw py::value_error("sensitivities and K have different lengths");
  std::vector<SensitivityPoint> points;
  for (std::size_t i = 0; i < settings.size(); ++i)
    points.push_back({.sensitivity = settings[i], .staticResponseCounts = values[i]});
  return toPython(jsonOf(fitSensitivityCurve(points, threshold)));
}

py::object calibrateTare(const Profile& profile) {
  const Tare tare =
      unlocked([&](const Progress& progress) { return findTare(profile, {}, progress); });
  py::object result = toPython(jsonOf(tare, profile.layout()));
  result["zero"] = arrayOf(tare.zero);
  return result;
}

std::vector<PressureTableRow> calibrationRowsOf(const py::object& table, fs::path& folder) {
  if (py::isinstance<py::str>(table) || py::hasattr(table, "__fspath__")) {
    const auto path = table.cast<fs::path>();
    folder = path.parent_path();
    return readPressureTable(path);
  }
  if (!py::isinstance<py::sequence>(table))
    throw py::type_error(
        "a table is a CSV file, or a list of (file, pressure_kpa[, temperature_c])");
  std::vector<PressureTableRow> rows;
  for (const py::handle item : table) {
    const auto cells = item.cast<py::sequence>();
    if (cells.size() != 2 && cells.size() != 3)
      throw py::value_error("row " + std::to_string(rows.size()) +
                            " isn't (file, pressure_kpa[, temperature_c])");
    PressureTableRow row;
    row.line = rows.size() + 1;
    row.file = cells[0].cast<fs::path>();
    row.pressureKpa = cells[1].cast<double>();
    if (cells.size() == 3) row.temperatureC = cells[2].cast<std::optional<double>>();
    rows.push_back(std::move(row));
  }
  return rows;
}

Calibration calibratePressure(const py::object& table,
                              std::optional<std::size_t> matrix,
                              const std::string& choices,
                              double area,
                              double sensitivity,
                              double threshold) {
  fs::path folder;
  const std::vector<PressureTableRow> rows = calibrationRowsOf(table, folder);
  PressureModelOptions model;
  model.study = choice<bool>("choices", choices, {{"default", false}, {"study", true}});
  model.indenterAreaMm2 = area;
  model.validate();
  constexpr OptionCheck check{"calibration"};
  check(SensorSettings::kSensitivity, "sensitivity", sensitivity);
  check(SensorSettings::kThresholdCounts, "threshold", threshold);
  CalibrationSampleOptions gather;
  gather.matrix = matrix;
  return unlocked([&](const Progress& progress) {
    const auto open = [](const fs::path& file, const Progress& step) {
      return CalibrationSource{openRecording(file, step), sha256OfFile(file)};
    };
    Calibration calibration =
        calibrationOf(collectCalibrationSteps(rows, folder, open, gather, progress), model);
    calibration.settings = {sensitivity, threshold, true};
    calibration.programVersion = PALPATE_VERSION;
    calibration.options =
        Json::object().set("choices", choices).set("area_mm2", model.indenterAreaMm2);
    return calibration;
  });
}

py::object fitPressure(const Numbers& gains,
                       const Numbers& drifts,
                       const Numbers& pressures,
                       const Numbers& temperatures,
                       bool study) {
  const std::vector<double> k = vectorOf(gains, "K"), m = vectorOf(drifts, "m"),
                            kpa = vectorOf(pressures, "pressure_kpa"),
                            degC = vectorOf(temperatures, "temperature_c");
  if (m.size() != k.size() || kpa.size() != k.size() || degC.size() != k.size())
    throw py::value_error("K, m, pressure_kpa and temperature_c have different lengths");
  std::vector<PressureSample> samples;
  for (std::size_t i = 0; i < k.size(); ++i)
    samples.push_back({.file = "",
                       .sha256 = "",
                       .pressureKpa = kpa[i],
                       .staticResponseCounts = k[i],
                       .driftCountsPerS = m[i],
                       .nearestDegC = degC[i],
                       .studyDegC = degC[i]});
  const PressureModelOptions options{.study = study};
  return toPython(
      jsonOf(unlocked([&](const Progress&) { return fitPressureModel(samples, options); })));
}

py::dict applyTo(const Calibration& calibration,
                 const Profile& profile,
                 std::optional<double> sensitivity,
                 std::optional<double> threshold,
                 bool tare,
                 bool drift) {
  const ForceChoice chosen{sensitivity, threshold, tare, drift};
  const ForceSeries series = unlocked([&](const Progress& progress) {
    return forceSeries(profile,
                       calibration,
                       pressureOptionsOf(chosen, calibration, profile),
                       tareOf(chosen, profile, progress),
                       progress);
  });
  const std::size_t frames = series.timeS.size(), matrices = series.numMatrices;
  py::dict table;
  const auto number = [&](const char* name, auto MatrixForce::*member) {
    table[name] = grid<double>(frames, matrices, [&](std::size_t i, std::size_t m) {
      return static_cast<double>(series.at(i, m).*member);
    });
  };
  const auto flag = [&](const char* name, bool MatrixForce::*member) {
    table[name] = grid<bool>(
        frames, matrices, [&](std::size_t i, std::size_t m) { return series.at(i, m).*member; });
  };
  table["time_s"] = arrayOf(series.timeS);
  table["active"] = grid<std::int64_t>(
      frames, matrices, [&](std::size_t i, std::size_t m) { return series.at(i, m).active; });
  number("K", &MatrixForce::staticResponseCounts);
  number("pressure_kpa", &MatrixForce::kpa);
  number("pressure_sd_kpa", &MatrixForce::sdKpa);
  // Upper limits are not forces.
  const double known = series.areaKnown ? 1.0 : std::numeric_limits<double>::quiet_NaN();
  for (const auto& [name, member] : {std::pair("force_n", &MatrixForce::forceN),
                                     std::pair("force_sd_n", &MatrixForce::sdForceN)})
    table[name] = grid<double>(frames, matrices, [&](std::size_t i, std::size_t m) {
      return static_cast<double>(series.at(i, m).*member) * known;
    });
  flag("in_range", &MatrixForce::inRange);
  flag("temperature_known", &MatrixForce::temperatureKnown);
  flag("saturated", &MatrixForce::saturated);
  table["hand_force_n"] =
      column<double>(frames, [&](std::size_t i) { return series.forceN(i) * known; });
  table["hand_force_sd_n"] =
      column<double>(frames, [&](std::size_t i) { return series.sdForceN(i) * known; });
  table["assumptions"] = series.assumptions;
  return table;
}

py::dict pressureAt(const Calibration& calibration,
                    const Numbers& gains,
                    std::optional<double> temperature) {
  const std::vector<double> k = vectorOf(gains, "K");
  std::vector<PressureEstimate> found;
  for (const double gain : k) found.push_back(calibration.pressure.pressureAt(gain, temperature));
  py::dict table;
  table["pressure_kpa"] = column<double>(k.size(), [&](std::size_t i) { return found[i].kpa; });
  table["pressure_sd_kpa"] =
      column<double>(k.size(), [&](std::size_t i) { return found[i].sdKpa; });
  table["in_range"] = column<bool>(k.size(), [&](std::size_t i) { return found[i].inRange; });
  return table;
}

void bindClass(py::module_& module) {
  py::class_<Calibration>(module,
                          "Calibration",
                          "Converts the counts of a hand to kilopascals and newtons: from "
                          "calibrate_pressure() or Calibration.load().")
      .def_static(
          "load",
          [](const fs::path& path) {
            return unlocked([&](const Progress&) { return loadCalibration(path); });
          },
          py::arg("path"),
          "Reads a calibration file (JSON). OSError, ValueError (not a calibration, damaged).")
      .def(
          "save",
          [](const Calibration& calibration, const fs::path& path, bool force) {
            const py::gil_scoped_release released;
            saveCalibration(calibration, path, force ? Overwrite::kReplace : Overwrite::kRefuse);
          },
          py::arg("path"),
          py::kw_only(),
          py::arg("force") = false,
          "Writes it to a file. OSError when the file exists (unless force) or can't be written.")
      .def_property_readonly(
          "report",
          [](const Calibration& calibration) { return toPython(jsonOf(calibration)); },
          "The whole calibration, as `palpate calibrate pressure` prints it: dict K {c, rmse_kpa, "
          "loo_rmse_kpa, ..}, m {..}, samples, settings, notes, ..")
      .def("apply",
           &applyTo,
           py::arg("profile"),
           py::kw_only(),
           py::arg("sensitivity") = py::none(),
           py::arg("threshold") = py::none(),
           py::arg("tare") = false,
           py::arg("drift") = true,
           "Pressures and forces of all frames: dict time_s (T,); (T, matrices): active, K "
           "[counts], pressure_kpa, pressure_sd_kpa [kPa], force_n, force_sd_n [N], in_range (do "
           "not rely on the values where it is False), temperature_known, saturated; hand_force_n, "
           "hand_force_sd_n (T,) [N]; assumptions. Forces are NaN where the calibration was made "
           "without area, the area of the indenter [mm^2]. sensitivity, threshold [counts]: "
           "settings of the recording (default: those of the calibration); tare: subtract what the "
           "taxels read unloaded; drift: correct the creep of long contacts. Error for filtered "
           "values.")
      .def("pressure_at",
           &pressureAt,
           py::arg("K"),
           py::arg("temperature_c") = py::none(),
           "Pressure of contacts with gains K (n,) [counts] at a temperature [deg C] (None: 35 deg "
           "C is assumed, and the band is wider): dict pressure_kpa, pressure_sd_kpa [kPa], "
           "in_range: (n,).");
}

}  // namespace

void bindCalibration(py::module_& module) {
  bindClass(module);
  module.def("calibrate_noise",
             &calibrateNoise,
             py::arg("profile"),
             py::kw_only(),
             py::arg("bins") = NoiseFloorOptions{}.bins,
             "Noise floor of an unloaded hand at threshold 0 over its temperature (study, 3.4): "
             "dict matrices [{index, slope [counts/deg C], intercept, rmse, rmse_true [counts], "
             "bins, ..}], notes, as `palpate calibrate noise` prints it.");
  module.def("save_noise",
             &saveNoise,
             py::arg("noise"),
             py::arg("path"),
             py::kw_only(),
             py::arg("force") = false,
             "Writes the result of calibrate_noise(): .xml for the prior program, else JSON. "
             "OSError when the file exists (unless force).");
  module.def("calibrate_sensitivity",
             &calibrateSensitivity,
             py::arg("sensitivities"),
             py::arg("K"),
             py::kw_only(),
             py::arg("threshold") = SensorSettings{}.thresholdCounts,
             "Gain K (n,) [counts] of one load against sensitivity (n,) [0..1]: dict points, "
             "slope, offset [counts], r2, .., as `palpate calibrate sensitivity` prints it. "
             "threshold: the setting during the measurement [counts], for the explanation.");
  module.def("calibrate_tare",
             &calibrateTare,
             py::arg("profile"),
             "What the taxels read when nothing touches them: dict zero (places,) [counts], "
             "matrices [{index, zero, windows, valid}].");
  module.def("calibrate_pressure",
             &calibratePressure,
             py::arg("table"),
             py::kw_only(),
             py::arg("matrix") = py::none(),
             py::arg("choices") = "default",
             py::arg("area") = PressureModelOptions{}.indenterAreaMm2,
             py::arg("sensitivity") = SensorSettings{}.sensitivity,
             py::arg("threshold") = SensorSettings{}.thresholdCounts,
             "Pressure from gain and temperature of loading steps: table is a CSV file "
             "(file,pressure_kpa[,temperature_c]) or a list of such tuples. matrix: the loaded one "
             "(None: the one with the largest readings); choices 'study': all terms and the "
             "study's temperature; area of the indenter [mm^2] (0: not known); sensitivity, "
             "threshold [counts] of the recordings. A recording that can't be used becomes a "
             "sample with used False and the reason.");
  module.def("fit_pressure",
             &fitPressure,
             py::arg("K"),
             py::arg("m"),
             py::arg("pressure_kpa"),
             py::arg("temperature_c"),
             py::kw_only(),
             py::arg("study") = false,
             "The same from steps that are already fitted: K (n,) [counts], m (n,) [counts/s], "
             "pressure_kpa (n,) [kPa], temperature_c (n,) [deg C]: dict K {c, rmse_kpa, "
             "loo_rmse_kpa, ..}, m {..}. study: all terms.");
}

}  // namespace palpate::python
