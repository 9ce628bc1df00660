// palpate.load(), palpate.Profile.
#include <algorithm>
#include <filesystem>
#include <string>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "palpate/core/error.h"
#include "palpate/recording/recording.h"

#include "python/bindings.h"

namespace palpate::python {
namespace py = pybind11;
namespace {

constexpr std::int64_t kUsPerMs = 1000;

using FloatArray = py::array_t<float, py::array::c_style>;
using DoubleArray = py::array_t<double, py::array::c_style>;
using TimeArray = py::array_t<std::int64_t, py::array::c_style>;

// A Python index (negative: from the end) of one of `count` things; raises IndexError.
std::size_t checkedIndex(const char* what, std::int64_t index, std::size_t count) {
  const std::int64_t number = static_cast<std::int64_t>(count);
  if (index < -number || index >= number)
    throw py::index_error("no " + std::string(what) + " " + std::to_string(index) + ", there are " +
                          std::to_string(count));
  return static_cast<std::size_t>(index < 0 ? index + number : index);
}

// start and stop as NumPy slices them: negative from the end, clamped.
std::pair<std::size_t, std::size_t> slice(std::int64_t start,
                                          std::optional<std::int64_t> stop,
                                          std::size_t count) {
  const std::int64_t number = static_cast<std::int64_t>(count);
  const auto place = [&](std::int64_t index) {
    return std::clamp<std::int64_t>(index < 0 ? index + number : index, 0, number);
  };
  const std::int64_t first = place(start);
  const std::int64_t last = std::max(first, place(stop.value_or(number)));
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
}

FloatArray frames(const Profile& profile, std::int64_t start, std::optional<std::int64_t> stop) {
  const auto [first, last] = slice(start, stop, profile.numFrames());
  const std::size_t width = profile.layout().numPlaces();
  FloatArray array({last - first, width});
  float* out = array.mutable_data();
  const py::gil_scoped_release unlocked;
  TactileFrame frame;
  for (std::size_t i = first; i < last; ++i) {
    profile.readFrame(i, frame);
    out = std::copy(frame.values.begin(), frame.values.end(), out);
  }
  return array;
}

FloatArray matrix(const Profile& profile,
                  std::int64_t index,
                  std::int64_t start,
                  std::optional<std::int64_t> stop) {
  const SensorLayout& layout = profile.layout();
  const std::size_t m = checkedIndex("matrix", index, layout.numMatrices());
  const auto [first, last] = slice(start, stop, profile.numFrames());
  const MatrixLayout& shape = layout.matrix(m);
  FloatArray array({last - first,
                    static_cast<std::size_t>(shape.rows),
                    static_cast<std::size_t>(shape.columns)});
  float* out = array.mutable_data();
  const py::gil_scoped_release unlocked;
  TactileFrame frame;
  for (std::size_t i = first; i < last; ++i) {
    profile.readFrame(i, frame);
    const float* values = frame.values.data() + layout.offset(m);
    out = std::copy(values, values + shape.numPlaces(), out);
  }
  return array;
}

template <typename TimeOf>
TimeArray times(std::size_t count, TimeOf timeOf) {
  TimeArray array(static_cast<py::ssize_t>(count));
  std::int64_t* out = array.mutable_data();
  for (std::size_t i = 0; i < count; ++i) out[i] = timeOf(i) / kUsPerMs;
  return array;
}

// (count, width): one row per sample.
template <typename ValuesOf>
DoubleArray samples(std::size_t count, std::size_t width, ValuesOf valuesOf) {
  DoubleArray array({count, width});
  double* out = array.mutable_data();
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<double> values = valuesOf(i);
    out = std::copy(values.begin(), values.end(), out);
  }
  return array;
}

std::size_t angleWidth(const Profile& profile) {
  return profile.numAngles() > 0 ? profile.angles(0).deg.size() : profile.hand().axes.size();
}

DoubleArray anglesAtFrames(const Profile& profile) {
  if (profile.numAngles() == 0) throw py::value_error("this recording has no joint angles");
  return samples(profile.numFrames(), angleWidth(profile), [&](std::size_t i) {
    return profile.anglesAtFrame(i)->deg;
  });
}

DoubleArray temperatures(const Profile& profile) {
  const std::size_t width = profile.numTemperatures() > 0
                                ? profile.temperatures(0).degC.size()
                                : profile.hand().temperatureSensors.size();
  return samples(profile.numTemperatures(), width, [&](std::size_t i) {
    return profile.temperatures(i).degC;
  });
}

Profile load(const std::filesystem::path& path) {
  const py::gil_scoped_release unlocked;
  return openRecording(path);
}

void save(const Profile& profile, const std::filesystem::path& path, bool force) {
  const py::gil_scoped_release unlocked;
  saveRecording(profile, {}, path, force ? Overwrite::kReplace : Overwrite::kRefuse);
}

std::string described(const Profile& profile) {
  return "<palpate.Profile: " + std::to_string(profile.numFrames()) + " frames, " +
         std::to_string(profile.layout().numMatrices()) + " matrices, " +
         std::to_string(profile.numAngles()) + " angle samples, " +
         std::to_string(profile.numTemperatures()) + " temperature samples>";
}

}  // namespace

void bindProfile(py::module_& module) {
  py::class_<Profile>(
      module, "Profile", "The data of one recording: three time series, each with its own stamps.")
      .def("__len__", [](const Profile& profile) { return profile.numFrames(); })
      .def("__repr__", &described)
      .def("frames",
           &frames,
           py::arg("start") = 0,
           py::arg("stop") = py::none(),
           "All taxels of the frames start..stop (exclusive): float32 array (T, places), matrix "
           "after matrix, row by row; counts, or what a filter made of them.")
      .def(
          "matrix",
          &matrix,
          py::arg("m"),
          py::arg("start") = 0,
          py::arg("stop") = py::none(),
          "One matrix of the frames start..stop (exclusive): float32 array (T, rows, columns). Row "
          "0 is the fingertip.")
      .def_property_readonly(
          "time_ms",
          [](const Profile& p) {
            return times(p.numFrames(), [&](std::size_t i) { return p.frameTimeUs(i); });
          },
          "Host time of each frame [ms since 1970]: int64 array (T,).")
      .def_property_readonly(
          "angles",
          [](const Profile& p) {
            return samples(
                p.numAngles(), angleWidth(p), [&](std::size_t i) { return p.angles(i).deg; });
          },
          "Joint angles [deg]: float64 array (n, axes).")
      .def_property_readonly(
          "angle_time_ms",
          [](const Profile& p) {
            return times(p.numAngles(), [&](std::size_t i) { return p.angleTimeUs(i); });
          },
          "Host time of each sample of the angles [ms since 1970]: int64 array (n,).")
      .def_property_readonly(
          "temperatures", &temperatures, "Temperatures [deg C]: float64 array (n, sensors).")
      .def_property_readonly(
          "temperature_time_ms",
          [](const Profile& p) {
            return times(p.numTemperatures(),
                         [&](std::size_t i) { return p.temperatureTimeUs(i); });
          },
          "Host time of each sample of the temperatures [ms since 1970]: int64 array (n,).")
      .def("angles_at_frames",
           &anglesAtFrames,
           "Joint angles that belong to each frame (the last sample at or before it, clamped at "
           "both ends) [deg]: float64 array (T, axes). ValueError without angles.")
      .def_property_readonly(
          "serial", [](const Profile& p) { return p.info().serial; }, "Of the tactile controller.")
      .def_property_readonly(
          "warnings",
          [](const Profile& p) { return p.info().warnings; },
          "Oddities found while reading that cost nothing.")
      .def("save",
           &save,
           py::arg("path"),
           py::kw_only(),
           py::arg("force") = false,
           "Saves it in the form of the path's ending: .dsa, .palpate, .csv or .npz. OSError when "
           "the file exists (unless force) or can't be written.");
  module.def("load",
             &load,
             py::arg("path"),
             "Reads a recording (.dsa or .palpate). OSError when it can't be read, ValueError when "
             "it is damaged or no recording.");
}

}  // namespace palpate::python
