// Binds palpate.synthesize(), emulate(), scenes() and noisy_contacts().
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "palpate/emulator/noisy_contacts.h"
#include "palpate/emulator/simulated_recording.h"
#include "palpate/emulator/synthetic_profile.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/data_folder.h"
#include "python/interruption.h"

namespace palpate::python {
namespace py = pybind11;
namespace {

namespace fs = std::filesystem;

py::tuple synthesized(double duration,
                      double rate,
                      double angleRate,
                      double temperatureRate,
                      int grasps,
                      double peak,
                      double radius,
                      double threshold,
                      double noise,
                      std::uint32_t seed) {
  SyntheticOptions options;
  options.durationS = duration;
  options.rateHz = rate;
  options.angleRateHz = angleRate;
  options.temperatureRateHz = temperatureRate;
  options.grasps = grasps;
  options.peakCounts = peak;
  options.contactRadiusTaxels = radius;
  options.thresholdCounts = threshold;
  options.noiseCounts = noise;
  options.seed = seed;
  SyntheticTruth truth;
  Profile profile = unlocked([&](const Progress&) { return synthesize(options, &truth); });
  return py::make_tuple(std::move(profile), listOf(truth.grasps, [](const SyntheticGrasp& grasp) {
                          return py::make_tuple(grasp.begin, grasp.end);
                        }));
}

Scene sceneOf(const py::object& scene) {
  if (py::isinstance<py::dict>(scene)) return parseScene(toJson(scene).text(), "scene");
  if (!py::isinstance<py::str>(scene) && !py::hasattr(scene, "__fspath__"))
    throw py::type_error("a scene is a name, a JSON file, or a dict");
  return loadScene(scene.cast<fs::path>().string(), (dataFolder() / "scenes"));
}

Profile emulate(const py::object& scene,
                double duration,
                int grasps,
                std::uint64_t seed,
                double interval,
                const std::vector<double>& zeroErrorDeg) {
  const Scene what = sceneOf(scene);
  SimulatedRecordingOptions options;
  options.durationS = duration;
  options.frameIntervalS = interval;
  options.hand.seed = seed;
  options.hand.zeroErrorDeg = zeroErrorDeg;
  options.validate();
  constexpr int kMaximum = 10'000;
  if (grasps < 0 || grasps > kMaximum) throw py::value_error("grasps is not in 0 .. 10000");
  return unlocked([&](const Progress& progress) {
    return grasps == 0 ? simulateRecording(what, options, progress)
                       : simulateGrasps(what, grasps, {}, options, progress);
  });
}

py::dict noisyContacts(std::uint64_t seed,
                       std::size_t frames,
                       double rate,
                       double degC,
                       double sensitivity,
                       double noiseMultiple,
                       double below,
                       bool contacts) {
  const NoisyContactsOptions options{.seed = seed,
                                     .frames = frames,
                                     .rateHz = rate,
                                     .degC = degC,
                                     .sensitivity = sensitivity,
                                     .noiseMultiple = noiseMultiple,
                                     .belowCounts = below,
                                     .contacts = contacts};
  const NoisyContacts made = unlocked([&](const Progress&) { return makeNoisyContacts(options); });
  py::dict result;
  result["profile"] = made.profile;
  for (const auto& [name, wanted] :
       {std::pair("touched", CellTruth::kTouched), std::pair("nothing", CellTruth::kNothing)})
    result[name] = grid<bool>(
        made.truth.size(), made.profile.layout().numCells(), [&](std::size_t i, std::size_t place) {
          return made.truth[i][place] == wanted;
        });
  result["contacts"] = listOf(made.contacts, [](const NoisyContact& contact) {
    py::dict one;
    one["size"] = std::string(nameOf(contact.size));
    one["matrix"] = contact.matrix;
    one["begin"] = contact.begin;
    one["end"] = contact.end;
    one["peak_kpa"] = contact.peakKpa;
    return one;
  });
  result["threshold_counts"] = made.thresholdCounts;
  return result;
}

}  // namespace

void bindEmulator(py::module_& module) {
  const SyntheticOptions synthetic;
  module.def(
      "synthesize",
      &synthesized,
      py::kw_only(),
      py::arg("duration") = synthetic.durationS,
      py::arg("rate") = synthetic.rateHz,
      py::arg("angle_rate") = synthetic.angleRateHz,
      py::arg("temperature_rate") = synthetic.temperatureRateHz,
      py::arg("grasps") = synthetic.grasps,
      py::arg("peak") = synthetic.peakCounts,
      py::arg("radius") = synthetic.contactRadiusTaxels,
      py::arg("threshold") = synthetic.thresholdCounts,
      py::arg("noise") = synthetic.noiseCounts,
      py::arg("seed") = synthetic.seed,
      "Makes a synthetic recording with known content: pinch grasps of a ball by fingers 0 and 2. "
      "Returns (Profile, list of (begin, end): frames with contact, both inclusive). duration [s]; "
      "rates [Hz]; peak, threshold, noise (sd) [counts]; radius of the contact [taxels].");
  module.def(
      "emulate",
      &emulate,
      py::arg("scene") = "ball",
      py::kw_only(),
      py::arg("duration") = SimulatedRecordingOptions{}.durationS,
      py::arg("grasps") = 0,
      py::arg("seed") = 1,
      py::arg("interval") = SimulatedRecordingOptions{}.frameIntervalS,
      py::arg("zero_error_deg") = std::vector<double>{},
      "Records the emulated hand, without ports and without waiting; the same seed gives the same "
      "recording. scene: a name of scenes(), a JSON file, or a dict of the same form; duration [s] "
      "(of each run); grasps: number of runs, each with other variations (0: one run without "
      "variation); interval between frames [s]; zero_error_deg (7,): how much further each axis is "
      "than it reports [deg]. OSError or ValueError for a scene that can't be used.");
  module.def(
      "scenes",
      [] { return sceneNames((dataFolder() / "scenes")); },
      "Names of the scenes that come with the program: list of str.");
  const NoisyContactsOptions noisy;
  module.def("noisy_contacts",
             &noisyContacts,
             py::kw_only(),
             py::arg("seed") = noisy.seed,
             py::arg("frames") = noisy.frames,
             py::arg("rate") = noisy.rateHz,
             py::arg("temperature_c") = noisy.degC,
             py::arg("sensitivity") = noisy.sensitivity,
             py::arg("noise_multiple") = noisy.noiseMultiple,
             py::arg("below") = noisy.belowCounts,
             py::arg("contacts") = noisy.contacts,
             "Makes frames of a hand at high sensitivity, with the true state of every taxel: dict "
             "profile, touched, nothing: bool (T, places) (neither: a load too faint to be "
             "reported), contacts [{size, matrix, begin, end (exclusive), peak_kpa}], "
             "threshold_counts (per matrix). rate [Hz]; the threshold is the noise line plus "
             "noise_multiple times its RMSE, minus `below` [counts].");
}

}  // namespace palpate::python
