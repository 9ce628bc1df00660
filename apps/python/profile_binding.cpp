// Binds palpate.Profile: the data of a recording as arrays.
#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "palpate/core/number_text.h"
#include "palpate/model/fitted_times.h"
#include "palpate/model/timing.h"
#include "palpate/recording/crop.h"
#include "palpate/recording/recording.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/events.h"
#include "python/interruption.h"
#include "python/profile_pickle.h"

namespace palpate::python {
namespace py = pybind11;
namespace {

using Stop = std::optional<std::int64_t>;

// `shape` of each of the frames start..stop: what begin(frame) points to.
template <typename Begin>
FloatArray copied(const Profile& profile,
                  std::int64_t start,
                  Stop stop,
                  std::vector<std::size_t> shape,
                  const Begin& begin) {
  const auto [first, last] = sliceOf(start, stop, profile.numFrames());
  std::size_t count = 1;
  for (const std::size_t side : shape) count *= side;
  shape.insert(shape.begin(), last - first);
  FloatArray array(shape);
  float* out = array.mutable_data();
  const py::gil_scoped_release unlocked;
  TactileFrame frame;
  for (std::size_t i = first; i < last; ++i) {
    profile.readFrame(i, frame);
    out = std::copy_n(begin(frame.allValues().data()), count, out);
  }
  return array;
}

FloatArray frames(const Profile& profile, std::int64_t start, Stop stop) {
  return copied(profile, start, stop, {profile.layout().numCells()}, [](const float* values) {
    return values;
  });
}

FloatArray matrix(const Profile& profile, std::int64_t index, std::int64_t start, Stop stop) {
  const SensorLayout& layout = profile.layout();
  const std::size_t m = checkedIndex("matrix", index, layout.numMatrices());
  const MatrixLayout& shape = layout.matrix(m);
  return copied(profile,
                start,
                stop,
                {static_cast<std::size_t>(shape.rows), static_cast<std::size_t>(shape.columns)},
                [&](const float* values) { return values + layout.offset(m); });
}

FloatArray taxel(const Profile& profile,
                 std::int64_t index,
                 std::int64_t x,
                 std::int64_t y,
                 std::int64_t start,
                 Stop stop) {
  const SensorLayout& layout = profile.layout();
  const std::size_t m = checkedIndex("matrix", index, layout.numMatrices());
  const auto columns = static_cast<std::size_t>(layout.matrix(m).columns),
             rows = static_cast<std::size_t>(layout.matrix(m).rows);
  const std::size_t column = checkedIndex("column", x, columns), row = checkedIndex("row", y, rows);
  const std::size_t place = layout.offset(m) + row * columns + column;
  return copied(profile, start, stop, {}, [&](const float* values) { return values + place; });
}

// Host times divided by `unitUs`.
template <typename TimeOf>
TimeArray times(std::size_t count, std::int64_t unitUs, const TimeOf& timeOf) {
  return column<std::int64_t>(count, [&](std::size_t i) { return timeOf(i) / unitUs; });
}

TimeArray frameTimes(const Profile& profile, std::int64_t unitUs) {
  return times(profile.numFrames(), unitUs, [&](std::size_t i) { return profile.frameTimeUs(i); });
}

DoubleArray secondsOf(const Profile& profile) {
  return column<double>(profile.numFrames(), [&](std::size_t i) {
    return static_cast<double>(profile.frameTimeUs(i) - profile.frameTimeUs(0)) / 1e6;
  });
}

// Shape (count, width): one row for each sample.
template <typename ValuesOf>
DoubleArray samples(std::size_t count, std::size_t width, const ValuesOf& valuesOf) {
  DoubleArray array({count, width});
  double* out = array.mutable_data();
  const py::gil_scoped_release unlocked;
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<double> values = valuesOf(i);
    out = std::copy(values.begin(), values.end(), out);
  }
  return array;
}

std::size_t widthOf(const Profile& profile, std::size_t series) {
  return profile.numSamples(series) > 0 ? profile.sample(series, 0).values.size()
                                        : profile.series()[series].columns.size();
}

DoubleArray valuesOf(const Profile& profile, std::size_t series) {
  return samples(profile.numSamples(series), widthOf(profile, series), [&](std::size_t i) {
    return profile.sample(series, i).values;
  });
}

DoubleArray valuesAtFrames(const Profile& profile, std::size_t series, const char* what) {
  if (profile.numSamples(series) == 0)
    throw py::value_error("this recording has no " + std::string(what));
  return samples(profile.numFrames(), widthOf(profile, series), [&](std::size_t i) {
    return profile.sampleAtFrame(series, i)->values;
  });
}

TimeArray sampleTimes(const Profile& profile, std::size_t series, std::int64_t unitUs) {
  return times(profile.numSamples(series), unitUs, [&](std::size_t i) {
    return profile.sampleTimeUs(series, i);
  });
}

// A series of a profile, whose arrays are made when they are asked for.
struct SeriesOfProfile {
  Profile profile;
  std::size_t index;
  const SeriesDescription& description() const { return profile.series()[index]; }
};

py::dict seriesOf(const Profile& profile) {
  py::dict all;
  for (std::size_t i = 0; i < profile.series().size(); ++i)
    all[py::str(profile.series()[i].name)] = SeriesOfProfile{profile, i};
  return all;
}

py::object deviceTimes(const SeriesOfProfile& series) {
  bool any = false;
  const auto times =
      column<std::int64_t>(series.profile.numSamples(series.index), [&](std::size_t i) {
        const auto deviceUs = series.profile.sample(series.index, i).deviceUs;
        any = any || deviceUs;
        return deviceUs.value_or(std::numeric_limits<std::int64_t>::min());
      });
  return any ? py::object(times) : py::none();
}

py::list matrices(const Profile& profile) {
  py::list list;
  for (std::size_t m = 0; m < profile.layout().numMatrices(); ++m) {
    const MatrixLayout& matrix = profile.layout().matrix(m);
    const auto mask = [&](const Mask& flags) {
      return grid<bool>(static_cast<std::size_t>(matrix.rows),
                        static_cast<std::size_t>(matrix.columns),
                        [&](std::size_t y, std::size_t x) {
                          return flags[y * static_cast<std::size_t>(matrix.columns) + x] != 0;
                        });
    };
    py::dict one;
    one["index"] = m;
    one["name"] = profile.hand().matrixName(m);
    one["rows"] = matrix.rows;
    one["columns"] = matrix.columns;
    one["pitch_mm"] = toPython(pitchJson(matrix.pitchMm));
    one["taxels"] = matrix.numTaxels();
    one["enabled"] = matrix.numEnabled();
    one["static_mask"] = mask(matrix.staticMask);
    one["dynamic_mask"] = mask(matrix.dynamicMask);
    list.append(one);
  }
  return list;
}

py::dict timing(const Profile& profile) {
  const TimingReport report = timingOf(profile);
  py::dict result;
  result["duration_s"] = report.durationS;
  result["rate_hz"] = report.rateHz;
  result["mean_rate_hz"] = report.meanRateHz;
  result["gaps"] =
      listOf(report.gaps, [](const Gap& gap) { return py::make_tuple(gap.frame, gap.seconds); });
  return result;
}

Profile crop(const Profile& profile, std::int64_t begin, std::int64_t end) {
  const std::size_t count = profile.numFrames();
  const std::size_t first = checkedIndex("frame", begin, count),
                    last = checkedIndex("frame", end, count);
  if (first > last) throw py::value_error("begin is after end");
  return unlocked(
      [&](const Progress& progress) { return cropped(profile, first, last, progress); });
}

// As profile[10:20].
Profile sliced(const Profile& profile, const py::slice& slice) {
  py::ssize_t first = 0;
  py::ssize_t stop = 0;
  py::ssize_t step = 0;
  py::ssize_t length = 0;
  if (!slice.compute(static_cast<py::ssize_t>(profile.numFrames()), &first, &stop, &step, &length))
    throw py::error_already_set();
  if (step != 1)
    throw py::value_error(
        "a slice of a profile has no step: use frames()[::step], or leave the step out");
  if (length == 0) throw py::value_error("the slice has no frames");
  return crop(profile, first, first + length - 1);
}

FloatArray frameOf(const Profile& profile, std::int64_t index) {
  const std::size_t i = checkedIndex("frame", index, profile.numFrames());
  FloatArray array(static_cast<py::ssize_t>(profile.layout().numCells()));
  const TactileFrame frame = profile.frame(i);
  std::copy(frame.allValues().begin(), frame.allValues().end(), array.mutable_data());
  return array;
}

// Goes through the frames; keeps the profile.
struct FrameIterator {
  Profile profile;
  std::size_t next = 0;
};

void save(const Profile& profile,
          const std::filesystem::path& path,
          const py::object& events,
          bool force) {
  const std::vector<Event> noted = eventsFrom(events);
  unlocked([&](const Progress& progress) {
    saveRecording(profile, noted, path, force ? Overwrite::kReplace : Overwrite::kRefuse, progress);
  });
}

std::string described(const Profile& profile) {
  const std::size_t numMatrices = profile.layout().numMatrices();
  std::string further;
  for (std::size_t i = kHandSeries; i < profile.series().size(); ++i)
    further += ", " + counted(profile.numSamples(i), "sample") + " of " + profile.series()[i].name;
  return "<palpate.Profile: " + counted(profile.numFrames(), "frame") + ", " +
         std::to_string(numMatrices) + (numMatrices == 1 ? " matrix, " : " matrices, ") +
         counted(profile.numAngles(), "angle sample") + ", " +
         counted(profile.numTemperatures(), "temperature sample") + further + ">";
}

using ProfileClass = py::class_<Profile>;

void bindValues(ProfileClass& profile) {
  profile.def("__len__", [](const Profile& p) { return p.numFrames(); })
      .def("__repr__", &described)
      .def("__getitem__",
           &frameOf,
           py::arg("frame"),
           "One frame: float32 (places,), as frames() has them; negative from the end.")
      .def("__getitem__",
           &sliced,
           py::arg("frames"),
           "profile[10:20]: these frames as a separate profile, as crop(). ValueError for a slice "
           "with a step or without frames.")
      .def(
          "__iter__",
          [](const Profile& p) { return FrameIterator{p}; },
          "The frames one after the other, as profile[i].")
      // Profiles are read-only: a copy is the same one.
      .def("__copy__", [](const py::object& self) { return self; })
      .def("__deepcopy__", [](const py::object& self, const py::dict&) { return self; })
      .def(py::pickle(&pickledProfile, &unpickledProfile))
      .def("frames",
           &frames,
           py::arg("start") = 0,
           py::arg("stop") = py::none(),
           "All taxels of the frames start..stop (exclusive): float32 (T, places), matrix after "
           "matrix, row by row (SDH-2: 486 places); counts, or filtered values.")
      .def("matrix",
           &matrix,
           py::arg("m"),
           py::arg("start") = 0,
           py::arg("stop") = py::none(),
           "One matrix of the frames start..stop (exclusive): float32 (T, rows, columns). Row 0 is "
           "the fingertip.")
      .def("taxel",
           &taxel,
           py::arg("m"),
           py::arg("x"),
           py::arg("y"),
           py::arg("start") = 0,
           py::arg("stop") = py::none(),
           "One taxel of the frames start..stop (exclusive), column x, row y: float32 (T,).")
      .def_property_readonly(
          "angles",
          [](const Profile& p) { return valuesOf(p, kAngleSeries); },
          "Joint angles [deg]: float64 (n, axes).")
      .def_property_readonly(
          "temperatures",
          [](const Profile& p) { return valuesOf(p, kTemperatureSeries); },
          "Temperatures [deg C]: float64 (n, sensors); 0: no reading yet.")
      .def_property_readonly(
          "series",
          &seriesOf,
          "All series of the recording, a Series each: dict by their names. 'angles' and "
          "'temperatures' are always there, then what a load cell or an IMU sent.")
      .def(
          "angles_at_frames",
          [](const Profile& p) { return valuesAtFrames(p, kAngleSeries, "joint angles"); },
          "Joint angles that belong to each frame (the last sample at or before it, clamped at "
          "both ends) [deg]: float64 (T, axes). ValueError without angles.")
      .def(
          "temperatures_at_frames",
          [](const Profile& p) { return valuesAtFrames(p, kTemperatureSeries, "temperatures"); },
          "Temperatures that belong to each frame, as angles_at_frames() [deg C]: float64 (T, "
          "sensors). ValueError without temperatures.");
}

Profile atFittedTimes(const Profile& profile) {
  const FittedTimes fitted =
      unlocked([&](const Progress& progress) { return fittedTimes(profile, progress); });
  for (const FittedClock& clock : fitted.clocks)
    if (clock.base) return fitted.profile;
  throw py::value_error("times can't be fitted: " + fitted.clocks.front().why);
}

void bindTimes(ProfileClass& profile) {
  profile
      .def_property_readonly(
          "time_ms",
          [](const Profile& p) { return frameTimes(p, kUsPerMs); },
          "Host time of each frame [ms since 1970]: int64 (T,).")
      .def_property_readonly(
          "time_us",
          [](const Profile& p) { return frameTimes(p, 1); },
          "The same with the full resolution [us since 1970]: int64 (T,).")
      .def_property_readonly(
          "time_s", &secondsOf, "Time of each frame from the first one [s]: float64 (T,).")
      .def_property_readonly(
          "angle_time_ms",
          [](const Profile& p) { return sampleTimes(p, kAngleSeries, kUsPerMs); },
          "Host time of each sample of the angles [ms since 1970]: int64 (n,).")
      .def_property_readonly(
          "temperature_time_ms",
          [](const Profile& p) { return sampleTimes(p, kTemperatureSeries, kUsPerMs); },
          "Host time of each sample of the temperatures [ms since 1970]: int64 (n,).")
      .def("fitted_times",
           &atFittedTimes,
           "The same recording with the times of the senders' clocks, fitted to the times of "
           "arrival, separately for frames and each series. ValueError without usable times of a "
           "sender.")
      .def("timing",
           &timing,
           "dict duration_s [s], rate_hz (from the median interval) and mean_rate_hz [Hz] (0 with "
           "fewer than two frames), gaps: list of (frame before it, length [s]); a gap is longer "
           "than max(1 s, 5 median intervals).")
      .def(
          "frame_at",
          [](const Profile& p, std::int64_t timeMs) {
            return p.frameAt(timeMs * kUsPerMs + kUsPerMs - 1);
          },
          py::arg("time_ms"),
          "The last frame at or before a host time [ms since 1970], clamped at both ends; None "
          "without frames.");
}

void bindSeries(py::module_& module) {
  py::class_<SeriesOfProfile>(
      module,
      "Series",
      "Rows of numbers with their times, recorded together with frames: from Profile.series.")
      .def("__len__", [](const SeriesOfProfile& s) { return s.profile.numSamples(s.index); })
      .def("__repr__",
           [](const SeriesOfProfile& s) {
             return "<palpate.Series " + s.description().name + ": " +
                    counted(s.profile.numSamples(s.index), "sample") + ", " +
                    counted(s.description().columns.size(), "column") + ">";
           })
      .def_property_readonly(
          "times_us",
          [](const SeriesOfProfile& s) { return sampleTimes(s.profile, s.index, 1); },
          "Host time of each sample [us since 1970]: int64 (n,).")
      .def_property_readonly(
          "device_times_us",
          &deviceTimes,
          "The sender's clock at each sample [us]: int64 (n,), -2^63 where it is "
          "not known; None where no sample has it.")
      .def_property_readonly(
          "values",
          [](const SeriesOfProfile& s) { return valuesOf(s.profile, s.index); },
          "The samples: float64 (n, columns); NaN where a value is not known.")
      .def_property_readonly(
          "columns",
          [](const SeriesOfProfile& s) {
            return membersOf(s.description().columns, &Column::name);
          },
          "Names of the columns: list of str.")
      .def_property_readonly(
          "units",
          [](const SeriesOfProfile& s) {
            return membersOf(s.description().columns, &Column::unit);
          },
          "Units of the columns, '' where none is known: list of str.")
      .def_property_readonly(
          "role",
          [](const SeriesOfProfile& s) { return s.description().role; },
          "Its role in Palpate: 'joint_angles', 'temperatures', 'reference_force', 'trigger', or "
          "''.")
      .def_property_readonly(
          "source",
          [](const SeriesOfProfile& s) { return s.description().source; },
          "Where it comes from, as text; or ''.");
}

}  // namespace

void bindProfile(py::module_& module) {
  bindSeries(module);
  py::class_<FrameIterator>(module, "_FrameIterator", py::module_local())
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__", [](FrameIterator& frames) {
        if (frames.next >= frames.profile.numFrames()) throw py::stop_iteration();
        return frameOf(frames.profile, static_cast<std::int64_t>(frames.next++));
      });
  ProfileClass profile(
      module,
      "Profile",
      "The data of one recording: frames of taxels and any number of series (joint angles, "
      "temperatures, a load cell, ..), each with its own times. Read-only; several threads may "
      "read one. Arrays are copies: they stay valid after the profile is deleted, and changing one "
      "changes nothing else. From load(), from_arrays(), filter(), synthesize() ..");
  bindValues(profile);
  bindTimes(profile);
  profile
      .def_property_readonly(
          "matrices",
          &matrices,
          "The matrices in wire order: list of dicts index, name, rows, columns, pitch_mm [mm] (a "
          "list [x, y] where the two differ), taxels (how many exist), enabled (how many are "
          "scanned), static_mask, dynamic_mask (bool (rows, columns)).")
      .def_property_readonly(
          "axes",
          [](const Profile& p) { return membersOf(p.hand().axes, &AxisDescription::name); },
          "Names of the joints, in the order of `angles`.")
      .def_property_readonly(
          "temperature_sensors",
          [](const Profile& p) {
            return membersOf(p.hand().temperatureSensors, &TemperatureSensorDescription::name);
          },
          "Names of the sensors, in the order of `temperatures`.")
      .def_property_readonly(
          "hand", [](const Profile& p) { return p.hand().name; }, "Which hand it is.")
      .def_property_readonly(
          "unit", [](const Profile& p) { return p.hand().unit; }, "Unit of the taxels' values.")
      .def_property_readonly(
          "format",
          [](const Profile& p) { return p.info().format; },
          "Where it comes from: 'dsa', 'palpate', 'synthetic', 'arrays'.")
      .def_property_readonly(
          "value_type",
          [](const Profile& p) {
            return p.info().valueType == ValueType::kCounts ? "counts" : "float";
          },
          "'counts' (whole numbers) or 'float' (filtered).")
      .def_property_readonly(
          "serial",
          [](const Profile& p) { return p.info().serial; },
          "Serial number of the tactile controller.")
      .def_property_readonly(
          "firmware",
          [](const Profile& p) { return p.info().firmware; },
          "Firmware of the tactile controller; in a .dsa the program that wrote it.")
      .def_property_readonly(
          "warnings",
          [](const Profile& p) { return p.info().warnings; },
          "Harmless oddities found while reading: list of str.")
      .def("crop",
           &crop,
           py::arg("begin"),
           py::arg("end"),
           "Frames begin..end, both inclusive, with the angles and temperatures that belong to "
           "them, as a separate profile. IndexError for a frame that doesn't exist.")
      .def("save",
           &save,
           py::arg("path"),
           py::kw_only(),
           py::arg("events") = py::list(),
           py::arg("force") = false,
           "Saves it in the format of the path's ending: .dsa, .palpate, .csv or .npz, with events "
           "as events() returns them. OSError when the file exists (unless force) or can't be "
           "written.");
}

}  // namespace palpate::python
