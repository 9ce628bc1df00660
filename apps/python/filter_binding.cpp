// Binds palpate.filter(), the catalogue of filters, recipes, filters of single series, and ghosts.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "palpate/core/time.h"
#include "palpate/filter/filter_catalog.h"
#include "palpate/filter/filter_chain.h"
#include "palpate/filter/filtered_profile.h"
#include "palpate/filter/ghosting.h"
#include "palpate/filter/kelvin_voigt_estimation.h"
#include "palpate/filter/recipe.h"
#include "palpate/filter/savitzky_golay.h"
#include "palpate/model/timing.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/filters.h"
#include "python/interruption.h"

namespace palpate::python {
namespace py = pybind11;
Recipe recipeOf(const py::args& specs) {
  std::vector<std::string> texts;
  for (const py::handle spec : specs) {
    if (py::isinstance<py::str>(spec))
      texts.push_back(spec.cast<std::string>());
    else if (!py::isinstance<py::sequence>(spec))
      throw py::type_error("a filter is a text such as 'median:size=3', or a list of texts");
    else
      for (std::string& text : spec.cast<std::vector<std::string>>())
        texts.push_back(std::move(text));
  }
  return parseRecipe(texts);
}

namespace {

Profile filter(const Profile& profile,
               const py::args& specs,
               const std::optional<std::filesystem::path>& recipe,
               const std::vector<std::int64_t>& restartsMs) {
  if (recipe && !specs.empty()) throw py::value_error("give filters or a recipe, not both");
  Recipe steps = recipe ? readRecipe(*recipe) : recipeOf(specs);
  FilteredProfileOptions options;
  for (const std::int64_t ms : restartsMs) options.restartsUs.push_back(ms * kUsPerMs);
  return unlocked(
      [&](const Progress& progress) { return filteredProfile(profile, steps, options, progress); });
}

py::dict describe(const FilterKind& kind) {
  py::dict result;
  result["name"] = kind.name;
  result["title"] = kind.title;
  result["domain"] = kind.domain == FilterDomain::kSpatial    ? "spatial"
                     : kind.domain == FilterDomain::kTemporal ? "temporal"
                                                              : "spatio-temporal";
  result["options"] = listOf(kind.options, [](const FilterOption& option) {
    py::dict one;
    one["key"] = option.key;
    one["unit"] = option.unit;
    one["minimum"] = option.minimum;
    one["maximum"] = option.maximum;
    one["default"] =
        option.automatic() ? py::object(py::none())
        : option.kind == FilterOption::Kind::kChoice
            ? py::object(py::str(option.choices.at(static_cast<std::size_t>(option.defaultValue))))
            : py::object(py::float_(option.defaultValue));
    one["choices"] = option.choices;
    one["purpose"] = option.purpose;
    return one;
  });
  result["purpose"] = kind.purpose;
  result["border"] = kind.border;
  result["source"] = kind.source;
  return result;
}

py::list filters() { return listOf(filterKinds(), &describe); }

py::dict recipes() {
  py::dict presets;
  for (const Recipe& recipe : recipePresets()) presets[py::str(recipe.name)] = recipeText(recipe);
  return presets;
}

class Collector final : public FrameSink {
 public:
  void take(TactileFrame& frame) override {
    values.push_back(static_cast<double>(frame.allValues().front()));
  }
  std::vector<double> values;
};

DoubleArray filterSeries(const Numbers& timeS, const Numbers& values, const py::args& specs) {
  const std::vector<double> times = vectorOf(timeS, "time_s"), series = vectorOf(values, "values");
  if (times.size() != series.size())
    throw py::value_error("time_s and values have different lengths");
  const Recipe recipe = recipeOf(specs);
  for (const FilterStep& step : recipe.steps)
    if (step.kind().domain != FilterDomain::kTemporal)
      throw py::value_error(step.name + " needs neighbours: a series takes only filters over time");
  Collector out;
  if (recipe.dependsOnRate()) {
    std::vector<std::int64_t> stampsUs;
    for (const double time : times)
      stampsUs.push_back(std::isfinite(time) ? std::llround((time - times.front()) * kUsPerS) : 0);
    if (std::is_sorted(stampsUs.begin(), stampsUs.end()))
      recipe.validateForRate(timingOf(stampsUs).rateHz);
  }
  FilterChain chain(recipe, out);
  TactileFrame frame(std::make_shared<const SensorLayout>(
      std::vector<MatrixLayout>{MatrixLayout::full(1, 1, 1.0)}));
  const TactileFrame empty = frame;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || !std::isfinite(series[i]))
      throw py::value_error("sample " + std::to_string(i) + " isn't a finite number");
    if (i > 0 && times[i] <= times[i - 1])
      throw py::value_error("time_s must ascend, but does not at sample " + std::to_string(i));
    frame = empty;
    frame.hostUs = std::llround((times[i] - times.front()) * kUsPerS);
    frame.values.front() = static_cast<float>(series[i]);
    chain.push(frame);
  }
  chain.finish();
  return arrayOf(out.values);
}

py::dict countsOf(const BeforeAfter& counts) {
  py::dict result;
  result["before"] = counts.before;
  result["after"] = counts.after;
  result["share_removed"] = counts.fractionRemoved();
  return result;
}

py::dict ghosts(const Profile& profile, const py::args& specs, double aboveCounts) {
  const Recipe recipe = recipeOf(specs);
  GhostingOptions options;
  options.activeAboveCounts = aboveCounts;
  const GhostingReport report = unlocked([&](const Progress& progress) {
    return measureGhosting(profile, recipe, {}, options, progress);
  });
  py::dict result;
  result["frames"] = report.frames;
  result["frames_with_false"] = countsOf(report.framesWithFalse);
  result["false_taxels"] = countsOf(report.total().falseTaxels);
  result["matrices"] = listOf(report.matrices, [](const MatrixGhosting& matrix) {
    py::dict one;
    one["false_taxels"] = countsOf(matrix.falseTaxels);
    one["scattered"] = countsOf(matrix.scattered);
    one["frames_with_false"] = countsOf(matrix.framesWithFalse);
    one["frames_whole"] = countsOf(matrix.framesWhole);
    return one;
  });
  result["latency_frames"] = report.latencyFrames;
  return result;
}

py::dict fitKelvinVoigt(const Numbers& timeS,
                        const Numbers& values,
                        std::optional<double> m,
                        std::optional<double> e,
                        std::optional<double> eta) {
  const std::vector<double> times = vectorOf(timeS, "time_s"), series = vectorOf(values, "values");
  KelvinVoigtEstimationOptions options;
  options.mass = m;
  options.stiffness = e;
  options.viscosity = eta;
  const KelvinVoigtEstimate fit = unlocked([&](const Progress& progress) {
    return estimateKelvinVoigt(times, series, options, {}, progress);
  });
  const KelvinVoigtSmoothed smoothed = kelvinVoigtSmoothed(times, series, fit.model);
  py::dict result;
  result["m"] = fit.model.mass;
  result["e"] = fit.model.stiffness;
  result["eta"] = fit.model.viscosity;
  result["force_noise"] = fit.model.forceNoise;
  result["measurement_noise"] = fit.model.measurementNoise;
  result["natural_hz"] = fit.model.naturalHz();
  result["damping"] = fit.model.damping();
  result["converged"] = fit.end == KelvinVoigtEnd::kConverged;
  result["log_likelihood"] = arrayOf(fit.logLikelihood);
  result["filtered"] = arrayOf(kelvinVoigtFiltered(times, series, fit.model));
  result["smoothed"] = arrayOf(smoothed.position);
  result["smoothed_variance"] = arrayOf(smoothed.variance);
  result["speed"] = arrayOf(smoothed.speed);
  return result;
}

}  // namespace

void bindFilters(py::module_& module) {
  module.def("filter",
             &filter,
             py::arg("profile"),
             py::kw_only(),
             py::arg("recipe") = py::none(),
             py::arg("restarts_ms") = std::vector<std::int64_t>{},
             "filter(profile, *specs, recipe=None, restarts_ms=[]) -> Profile\n\nFilters a profile "
             "with one filter after the other: 'median:size=3', 'kalman', also 'median | kalman' "
             "or lists of them; or with a recipe file (JSON). Frames are filtered when they are "
             "read; angles, temperatures and stamps are the source's; values are floats. "
             "restarts_ms: host times [ms since 1970] at which filters over time start again. "
             "ValueError for an unknown name or key lists the known ones.");
  module.def("filters",
             &filters,
             "All filters: a list of dicts name, title, domain ('spatial', 'temporal', "
             "'spatio-temporal'), options [{key, unit, minimum, maximum, default (None: "
             "automatic), choices, purpose}], purpose, border, source.");
  module.def("recipes",
             &recipes,
             "Ready-made filter chains: dict name -> text for filter(); the first one is for high "
             "sensitivity.");
  module.def(
      "read_recipe",
      [](const std::filesystem::path& path) { return recipeText(readRecipe(path)); },
      py::arg("path"),
      "The text of a recipe file, as filter() takes it. OSError, ValueError.");
  module.def(
      "save_recipe",
      [](const std::filesystem::path& path,
         const py::args& specs,
         const std::string& name,
         bool force) {
        Recipe recipe = recipeOf(specs);
        recipe.name = name;
        writeRecipe(path, recipe, force);
      },
      py::arg("path"),
      py::kw_only(),
      py::arg("name") = "",
      py::arg("force") = false,
      "save_recipe(path, *specs, name='', force=False) -> None\n\nWrites a recipe file (JSON). "
      "OSError when the file exists (unless force).");
  module.def("filter_series",
             &filterSeries,
             py::arg("time_s"),
             py::arg("values"),
             "filter_series(time_s, values, *specs) -> array\n\nFilters one series over time "
             "('kalman', 'savitzky-golay:window=7', 'low-pass:cutoff=5', ..): time_s (n,) [s], "
             "ascending; values (n,); returns float64 (n,), 7 digits. Filters restart after gaps "
             "(longer than max(1 s, 5 median intervals)). ValueError for a filter over space, and "
             "for a frequency of half the rate (1 / median interval) or more.");
  module.def(
      "savitzky_golay",
      [](int window, int order, int derivative, std::optional<double> position) {
        return arrayOf(
            savitzkyGolayWeights(window, order, derivative, position.value_or((window - 1) / 2.0)));
      },
      py::arg("window"),
      py::arg("order") = 2,
      py::arg("derivative") = 0,
      py::arg("position") = py::none(),
      "Weights of a Savitzky-Golay filter, oldest sample first: (window,). The polynomial of "
      "that order at `position` in the window (0 oldest, window - 1 newest; default the "
      "middle), or its derivative [per sample^derivative].");
  module.def("ghosts",
             &ghosts,
             py::arg("profile"),
             py::kw_only(),
             py::arg("above") = GhostingOptions{}.activeAboveCounts,
             "ghosts(profile, *specs, above=0.0) -> dict\n\nCounts the active taxels in a "
             "recording of a hand that touches nothing, before and after filters: dict frames, "
             "frames_with_false, false_taxels {before, after, share_removed}, matrices, "
             "latency_frames. above: taxels above it are active [counts].");
  module.def("fit_kelvin_voigt",
             &fitKelvinVoigt,
             py::arg("time_s"),
             py::arg("values"),
             py::kw_only(),
             py::arg("m") = py::none(),
             py::arg("e") = py::none(),
             py::arg("eta") = py::none(),
             "Fits a Kelvin-Voigt model (mass, spring, damper) to a series by "
             "expectation-maximisation: time_s (n,) [s], values (n,) [counts]; parameters that are "
             "given stay fixed. dict m, e, eta, force_noise, measurement_noise [counts^2], "
             "natural_hz [Hz], damping, converged, log_likelihood (rounds,), filtered (n,), "
             "smoothed (n,) [counts], smoothed_variance (n,) [counts^2], speed (n,) [counts/s].");
}

}  // namespace palpate::python
