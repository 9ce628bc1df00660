// Binds palpate.from_arrays(), which makes a profile from NumPy arrays.
#include <array>
#include <string>
#include <variant>

#include <pybind11/stl.h>

#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/interruption.h"

namespace palpate::python {
namespace py = pybind11;
namespace {

using Times = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

std::vector<std::int64_t> timesUsOf(const py::object& given, const char* name) {
  const auto any = py::array::ensure(given);
  const bool whole =
      any && (any.size() == 0 || any.dtype().kind() == 'i' || any.dtype().kind() == 'u');
  const auto array = whole ? Times::ensure(any) : Times();
  if (!whole || !array) {
    PyErr_Clear();
    throw py::type_error(std::string(name) + " takes whole milliseconds (integers)");
  }
  if (array.ndim() != 1)
    throw py::value_error(std::string(name) + " has shape " + shapeText(array) +
                          "; it takes 1 dimension");
  constexpr std::int64_t kFarthestMs = INT64_MAX / 1000;
  std::vector<std::int64_t> us;
  for (py::ssize_t i = 0; i < array.size(); ++i) {
    const std::int64_t ms = array.at(i);
    if (ms > kFarthestMs || ms < -kFarthestMs)
      throw py::value_error(std::string(name) + ": " + std::to_string(ms) + " ms isn't a time");
    us.push_back(ms * kUsPerMs);
  }
  return us;
}

// The taxel values: one array (T, places), or one array (T, rows, columns) for each matrix.
struct Taxels {
  std::shared_ptr<const SensorLayout> layout;
  std::vector<Floats> parts;
};

Taxels taxelsOf(const py::object& frames, const TaxelPitch& pitchMm, std::size_t numFrames) {
  Taxels taxels;
  if (py::isinstance<py::list>(frames) || py::isinstance<py::tuple>(frames)) {
    std::vector<MatrixLayout> matrices;
    for (const py::handle item : frames) {
      taxels.parts.push_back(ensured<Floats>(item, "frames"));
      const Floats& part = taxels.parts.back();
      if (part.ndim() != 3)
        throw py::value_error("a matrix of frames has shape " + shapeText(part) +
                              "; it takes (T, rows, columns)");
      constexpr py::ssize_t kMaximum = 256;
      if (part.shape(1) > kMaximum || part.shape(2) > kMaximum)
        throw py::value_error("a matrix of frames has shape " + shapeText(part) +
                              "; at most 256 rows and columns");
      matrices.push_back(MatrixLayout::full(
          static_cast<int>(part.shape(1)), static_cast<int>(part.shape(2)), pitchMm));
    }
    taxels.layout = std::make_shared<const SensorLayout>(std::move(matrices));
  } else {
    taxels.layout = defaultHand().layout;
    taxels.parts.push_back(ensured<Floats>(frames, "frames"));
    const Floats& part = taxels.parts.back();
    if (part.ndim() != 2 || static_cast<std::size_t>(part.shape(1)) != taxels.layout->numCells())
      throw py::value_error("frames has shape " + shapeText(part) + "; it takes (T, " +
                            std::to_string(taxels.layout->numCells()) +
                            "), or a list with an array (T, rows, columns) per matrix");
  }
  for (const Floats& part : taxels.parts)
    if (static_cast<std::size_t>(part.shape(0)) != numFrames)
      throw py::value_error("frames has " + std::to_string(part.shape(0)) + " frames, time_ms " +
                            std::to_string(numFrames));
  return taxels;
}

void addFrames(ProfileBuilder& builder,
               const Taxels& taxels,
               const std::vector<std::int64_t>& timesUs) {
  std::vector<float> values;
  for (std::size_t i = 0; i < timesUs.size(); ++i) {
    values.clear();
    for (const Floats& part : taxels.parts) {
      const std::size_t width = static_cast<std::size_t>(part.size()) / timesUs.size();
      values.insert(values.end(), part.data() + i * width, part.data() + (i + 1) * width);
    }
    builder.addFrame(timesUs[i], values);
  }
}

struct Samples {
  std::vector<std::int64_t> timesUs;
  std::vector<std::vector<double>> rows;
};

Samples samplesOf(const py::object& times, const py::object& given, const char* name) {
  Samples samples;
  if (given.is_none() != times.is_none())
    throw py::value_error(std::string(name) + " and its times go together");
  if (given.is_none()) return samples;
  samples.timesUs = timesUsOf(times, name);
  const auto array = ensured<Numbers>(given, name);
  if (array.ndim() != 2 || static_cast<std::size_t>(array.shape(0)) != samples.timesUs.size())
    throw py::value_error(std::string(name) + " has shape " + shapeText(array) + "; it takes (" +
                          std::to_string(samples.timesUs.size()) + ", n)");
  for (py::ssize_t i = 0; i < array.shape(0); ++i)
    samples.rows.emplace_back(array.data(i), array.data(i) + array.shape(1));
  return samples;
}

Profile fromArrays(const py::object& timeMs,
                   const py::object& frames,
                   const std::variant<double, std::array<double, 2>>& pitchMm,
                   const py::object& angles,
                   const py::object& angleTimeMs,
                   const py::object& temperatures,
                   const py::object& temperatureTimeMs,
                   const std::string& serial) {
  const std::vector<std::int64_t> timesUs = timesUsOf(timeMs, "time_ms");
  const auto* both = std::get_if<std::array<double, 2>>(&pitchMm);
  const TaxelPitch pitch = both ? TaxelPitch((*both)[0], (*both)[1]) : std::get<double>(pitchMm);
  const Taxels taxels = taxelsOf(frames, pitch, timesUs.size());
  const Samples joints = samplesOf(angleTimeMs, angles, "angles"),
                warmth = samplesOf(temperatureTimeMs, temperatures, "temperatures");
  const py::gil_scoped_release unlocked;
  ProfileBuilder builder(taxels.layout);
  addFrames(builder, taxels, timesUs);
  for (std::size_t i = 0; i < joints.rows.size(); ++i)
    builder.addAngles(joints.timesUs[i], joints.rows[i]);
  for (std::size_t i = 0; i < warmth.rows.size(); ++i)
    builder.addTemperatures(warmth.timesUs[i], warmth.rows[i]);
  ProfileInfo info;
  info.format = "arrays";
  info.serial = serial;
  return builder.finish(info);
}

}  // namespace

void bindArrays(py::module_& module) {
  module.def(
      "from_arrays",
      &fromArrays,
      py::arg("time_ms"),
      py::arg("frames"),
      py::kw_only(),
      py::arg("pitch_mm") = 3.4,
      py::arg("angles") = py::none(),
      py::arg("angle_time_ms") = py::none(),
      py::arg("temperatures") = py::none(),
      py::arg("temperature_time_ms") = py::none(),
      py::arg("serial") = "",
      "A profile of arrays: time_ms (T,) host times [ms since 1970], ascending, whole; frames (T, "
      "486) of an SDH-2, or a list with an array (T, rows, columns) per matrix of any sensor, "
      "whose taxels lie pitch_mm apart [mm] (a number, or one along a row and one along a "
      "column); angles (n, axes) [deg] at angle_time_ms (n,); "
      "temperatures (k, sensors) [deg C] at temperature_time_ms (k,). Values are copied and must "
      "be finite. ValueError says what doesn't fit.");
}

}  // namespace palpate::python
