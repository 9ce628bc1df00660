// Binds palpate.Hand, hands() and record(), which makes a profile of any hand from NumPy arrays.
#include <cmath>
#include <filesystem>
#include <string>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "palpate/core/error.h"
#include "palpate/device/stream_shape.h"
#include "palpate/model/hand_file.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recognition/pinch_hand.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/data_folder.h"
#include "python/geometry.h"
#include "python/interruption.h"

namespace palpate::python {
namespace py = pybind11;

HandDescription handGiven(const py::object& given) {
  if (given.is_none()) return defaultHand();
  if (py::isinstance<HandDescription>(given)) return given.cast<HandDescription>();
  if (!py::isinstance<py::str>(given) && !py::hasattr(given, "__fspath__"))
    throw py::type_error("hand takes a Hand, its name or folder, or None");
  return findHand(given.cast<std::filesystem::path>().string(), handFolders(dataFolder()));
}

namespace {

py::list matricesOf(const HandDescription& hand) {
  py::list list;
  for (std::size_t m = 0; m < hand.layout->numMatrices(); ++m) {
    const MatrixLayout& matrix = hand.layout->matrix(m);
    py::dict one;
    one["index"] = m;
    one["name"] = hand.matrixName(m);
    one["finger"] = hand.matrices[m].finger;
    one["rows"] = matrix.rows;
    one["columns"] = matrix.columns;
    one["pitch_mm"] = toPython(pitchJson(matrix.pitchMm));
    one["taxels"] = matrix.numTaxels();
    one["full_scale"] = hand.maximumOf(m);
    one["saturation"] = hand.saturationOf(m);
    list.append(one);
  }
  return list;
}

py::list axesOf(const HandDescription& hand) {
  return listOf(hand.axes, [](const AxisDescription& axis) {
    py::dict one;
    one["name"] = axis.name;
    one["unit"] = axis.unit();
    one["minimum"] = axis.minimumDeg;
    one["maximum"] = axis.maximumDeg;
    return one;
  });
}

py::dict knownHands() {
  py::dict hands;
  for (const BuiltInHand& each : builtInHands()) hands[py::str(each.key)] = each.hand->name;
  return hands;
}

// Frames as one row of values each: (T, places or taxels), (T, rows, columns) of the only matrix,
// or a list of an array (T, rows, columns) per matrix.
struct FrameRows {
  std::size_t count = 0;
  std::vector<Floats> parts;
};

FrameRows frameRowsOf(const py::object& frames, const HandDescription& hand) {
  FrameRows rows;
  const bool several = py::isinstance<py::list>(frames) || py::isinstance<py::tuple>(frames);
  const auto isMatrix = [&](const Floats& part, std::size_t m) {
    return part.ndim() == 3 && part.shape(1) == hand.layout->matrix(m).rows &&
           part.shape(2) == hand.layout->matrix(m).columns;
  };
  const std::size_t matrices = hand.layout->numMatrices();
  if (several && py::len(frames) == matrices && matrices > 0 &&
      py::hasattr(frames[py::int_(0)], "shape")) {
    for (std::size_t m = 0; m < matrices; ++m) {
      rows.parts.push_back(ensured<Floats>(frames[py::int_(m)], "frames"));
      if (!isMatrix(rows.parts.back(), m))
        throw py::value_error("frames[" + std::to_string(m) + "] has shape " +
                              shapeText(rows.parts.back()) + "; it takes (T, " +
                              std::to_string(hand.layout->matrix(m).rows) + ", " +
                              std::to_string(hand.layout->matrix(m).columns) + ")");
    }
  } else {
    rows.parts.push_back(ensured<Floats>(frames, "frames"));
    const Floats& part = rows.parts.back();
    const bool whole = matrices == 1 && isMatrix(part, 0);
    if (!whole && part.ndim() != 2)
      throw py::value_error("frames has shape " + shapeText(part) + "; it takes (T, " +
                            std::to_string(hand.layout->numCells()) +
                            "), or a list with an array (T, rows, columns) per matrix");
  }
  rows.count = static_cast<std::size_t>(rows.parts.front().shape(0));
  for (const Floats& part : rows.parts)
    if (static_cast<std::size_t>(part.shape(0)) != rows.count)
      throw py::value_error("the matrices have different numbers of frames");
  return rows;
}

std::vector<std::int64_t> recordTimesUs(const py::object& timeMs,
                                        const std::optional<double>& rate,
                                        std::size_t count) {
  if (timeMs.is_none() == !rate)
    throw py::value_error("give either time_ms or rate, the frames per second");
  std::vector<std::int64_t> us;
  if (rate) {
    if (!(*rate > 0.0 && *rate <= 1e6))
      throw py::value_error("rate must be above 0 and at most 1000000 Hz");
    for (std::size_t i = 0; i < count; ++i)
      us.push_back(std::llround(static_cast<double>(i) * kUsPerS / *rate));
    return us;
  }
  const std::vector<double> ms = vectorOf(timeMs.cast<Numbers>(), "time_ms");
  if (ms.size() != count)
    throw py::value_error("time_ms has " + std::to_string(ms.size()) + " times, frames " +
                          std::to_string(count));
  for (const double one : ms) {
    if (!(std::abs(one) < 1e15)) throw py::value_error("time_ms has a value that is not a time");
    us.push_back(std::llround(one * kUsPerMs));
  }
  return us;
}

// One row of numbers per frame; empty when None is given.
Eigen::MatrixXd rowsPerFrame(const py::object& given,
                             const char* name,
                             std::size_t count,
                             std::size_t width) {
  if (given.is_none()) return {};
  Eigen::MatrixXd rows = matrixOf(given.cast<Numbers>(), name);
  if (static_cast<std::size_t>(rows.rows()) != count ||
      static_cast<std::size_t>(rows.cols()) != width)
    throw py::value_error(std::string(name) + " has " + std::to_string(rows.rows()) + " rows of " +
                          std::to_string(rows.cols()) + "; it takes " + std::to_string(count) +
                          " of " + std::to_string(width));
  return rows;
}

Profile record(const py::object& frames,
               const py::object& handOrName,
               const py::object& timeMs,
               const std::optional<double>& rate,
               const py::object& angles,
               const py::object& temperatures,
               const std::string& serial) {
  const HandDescription hand = handGiven(handOrName);
  const StreamShape shape(hand);
  const FrameRows rows = frameRowsOf(frames, hand);
  const std::vector<std::int64_t> timesUs = recordTimesUs(timeMs, rate, rows.count);
  const Eigen::MatrixXd joints = rowsPerFrame(angles, "angles", rows.count, hand.axes.size());
  const Eigen::MatrixXd warmth =
      rowsPerFrame(temperatures, "temperatures", rows.count, hand.temperatureSensors.size());
  const py::gil_scoped_release unlocked;
  ProfileBuilder builder(hand);
  std::vector<float> values(shape.numPlaces());
  for (std::size_t i = 0; i < rows.count; ++i) {
    std::size_t width = 0;
    for (const Floats& part : rows.parts) {
      const std::size_t of = static_cast<std::size_t>(part.size()) / rows.count;
      if (width + of <= values.size()) std::copy_n(part.data() + i * of, of, values.data() + width);
      width += of;
    }
    if (!shape.fits(StreamItemKind::kFrame, width))
      throw std::invalid_argument("frames has " + std::to_string(width) +
                                  " values per frame instead of " +
                                  shape.expected(StreamItemKind::kFrame));
    const std::string fault = shape.arrange(values, width);
    if (!fault.empty()) throw std::invalid_argument("frames[" + std::to_string(i) + "]: " + fault);
    builder.addFrame(timesUs[i], values);
    const auto rowOf = [&](const Eigen::MatrixXd& of) {
      const Eigen::VectorXd row = of.row(static_cast<Eigen::Index>(i));
      return std::vector<double>(row.begin(), row.end());
    };
    if (joints.size() > 0) builder.addAngles(timesUs[i], rowOf(joints));
    if (warmth.size() > 0) builder.addTemperatures(timesUs[i], rowOf(warmth));
  }
  ProfileInfo info;
  info.format = "arrays";
  info.serial = serial;
  return builder.finish(info);
}

}  // namespace

void bindHands(py::module_& module) {
  py::class_<HandDescription>(module, "Hand", "A hand, as hand.json describes it.")
      .def(py::init([](const py::object& name) { return handGiven(name); }),
           py::arg("name"),
           "A hand by its name (hands() lists the built-in ones) or its folder. ValueError says "
           "what is wrong in its files; Error, for an unknown name, lists the known ones.")
      .def_readonly("name", &HandDescription::name, "Name of the hand.")
      .def_readonly("maker", &HandDescription::maker, "Its manufacturer; may be empty.")
      .def_readonly("unit", &HandDescription::unit, "Unit of the taxels' values.")
      .def_readonly(
          "full_scale", &HandDescription::maximumCounts, "Largest value of a taxel of any matrix.")
      .def_readonly("saturation",
                    &HandDescription::saturationCounts,
                    "Value from which a taxel is saturated, unless its matrix has another one.")
      .def_property_readonly("matrices",
                             &matricesOf,
                             "Its matrices: list of dicts index, name, finger, rows, columns, "
                             "pitch_mm (a list [x, y] where the two differ), taxels, full_scale, "
                             "saturation.")
      .def_property_readonly(
          "axes", &axesOf, "Its joints: list of dicts name, unit (deg, mm), minimum, maximum.")
      .def_property_readonly(
          "temperature_sensors",
          [](const HandDescription& hand) {
            return membersOf(hand.temperatureSensors, &TemperatureSensorDescription::name);
          },
          "Names of its temperature sensors.")
      .def_property_readonly(
          "has_geometry",
          [](const HandDescription& hand) { return hasGeometry(hand); },
          "Whether its description has the positions of its taxels in space.")
      .def_property_readonly(
          "pinches",
          [](const HandDescription& hand) { return pinchHandOf(hand) != nullptr; },
          "Whether two of its pads pinch; the features 'best' need that.")
      .def("__repr__", [](const HandDescription& hand) {
        return "<palpate.Hand '" + hand.name + "', " + std::to_string(hand.layout->numMatrices()) +
               (hand.layout->numMatrices() == 1 ? " matrix, " : " matrices, ") +
               std::to_string(hand.layout->numTaxels()) + " taxels>";
      });
  module.def("hands", &knownHands, "The built-in hands: dict name -> title.");
  module.def("record",
             &record,
             py::arg("frames"),
             py::arg("hand"),
             py::kw_only(),
             py::arg("time_ms") = py::none(),
             py::arg("rate") = py::none(),
             py::arg("angles") = py::none(),
             py::arg("temperatures") = py::none(),
             py::arg("serial") = "",
             "Makes a profile of any hand from arrays: frames (T, places) or (T, taxels) in the "
             "order of the hand's description, (T, rows, columns) of a single matrix, or a list "
             "with an array (T, rows, columns) per matrix; values from 0 to its full scale. hand: "
             "a Hand, its name or folder. time_ms (T,) [ms since 1970], ascending, or rate [Hz], "
             "from time 0; angles (T, axes) [deg; mm], temperatures (T, sensors) [deg C] of the "
             "same times. Profile.save() writes it. ValueError says which value doesn't fit.");
}

}  // namespace palpate::python
