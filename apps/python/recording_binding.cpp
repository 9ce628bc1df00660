// Binds palpate.load(), verify(), recover(), events() and other functions about recording files.
#include <algorithm>
#include <filesystem>
#include <string>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "palpate/core/progress.h"
#include "palpate/model/timing.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/recording_details.h"
#include "palpate/recording/second_summary.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/events.h"
#include "python/interruption.h"
#include "python/result_binding.h"

namespace palpate::python {
namespace py = pybind11;

py::list toPython(const std::vector<Event>& events) {
  return listOf(events, [](const Event& event) {
    py::dict one;
    one["t_us"] = event.tUs;
    one["t1_us"] = event.t1Us;
    one["kind"] = event.kind;
    one["matrix"] = event.matrix;
    one["text"] = event.text;
    one["json"] = event.json;
    return one;
  });
}

std::vector<Event> eventsFrom(const py::object& events) {
  std::vector<Event> list;
  for (const py::handle item : events) {
    const auto one = item.cast<py::dict>();
    const auto required = [&](const char* key) {
      if (!one.contains(key))
        throw py::value_error("event " + std::to_string(list.size()) + " has no '" + key + "'");
      return one[key];
    };
    const auto text = [&](const char* key) {
      return one.contains(key) && !one[key].is_none() ? one[key].cast<std::string>()
                                                      : std::string();
    };
    Event event;
    event.tUs = required("t_us").cast<std::int64_t>();
    event.t1Us = one.contains("t1_us") ? one["t1_us"].cast<std::int64_t>() : event.tUs;
    event.kind = required("kind").cast<std::string>();
    if (one.contains("matrix")) event.matrix = one["matrix"].cast<std::optional<int>>();
    event.text = text("text");
    event.json = text("json");
    list.push_back(std::move(event));
  }
  return list;
}

namespace {

namespace fs = std::filesystem;

Profile load(const fs::path& path) {
  return unlocked([&](const Progress& progress) { return openRecording(path, progress); });
}

py::dict verify(const fs::path& path) {
  const VerifyReport report =
      unlocked([&](const Progress& progress) { return verifyRecording(path, progress); });
  py::dict result;
  result["state"] = report.state == VerifyReport::State::kSound     ? "sound"
                    : report.state == VerifyReport::State::kDamaged ? "damaged"
                                                                    : "unreadable";
  result["message"] = report.message;
  return result;
}

py::dict recover(const fs::path& in, const fs::path& out, bool force) {
  const RecoverReport report = unlocked([&](const Progress& progress) {
    return recoverRecording(in, out, force ? Overwrite::kReplace : Overwrite::kRefuse, progress);
  });
  py::dict result;
  result["state"] = report.state == RecoverReport::State::kWhole  ? "whole"
                    : report.state == RecoverReport::State::kPart ? "part"
                                                                  : "nothing";
  result["message"] = report.message;
  return result;
}

py::list events(const fs::path& path) {
  return toPython(unlocked([&](const Progress&) { return readEvents(path); }).events);
}

py::dict details(const fs::path& path) {
  const RecordingDetails found =
      unlocked([&](const Progress& progress) { return readDetails(path, progress); });
  py::dict result;
  result["form"] = found.form;
  result["state"] = nameOf(found.state);
  result["message"] = found.message;
  result["size_bytes"] = found.sizeBytes;
  result["start_us"] = found.startUs;
  result["duration_us"] = found.durationUs;
  result["frames"] = found.numFrames;
  result["operator"] = found.operatorName;
  result["object"] = found.object;
  result["run"] = found.run;
  result["notes"] = found.notes;
  result["labels"] = found.labels;
  result["series"] = listOf(found.series, [](const SeriesDetails& each) {
    py::dict entry;
    entry["name"] = each.name;
    entry["samples"] = each.samples;
    entry["rate_hz"] = each.rateHz;
    entry["columns"] = listOf(each.columns, [](const Column& column) {
      return py::make_tuple(column.name, column.unit);
    });
    return entry;
  });
  return result;
}

py::dict info(const Profile& profile) {
  const TimingReport timing = timingOf(profile);
  double largest = 0.0;
  std::size_t saturated = 0;
  unlocked([&](const Progress& progress) {
    TactileFrame frame;
    const std::size_t count = profile.numFrames();
    for (std::size_t i = 0; i < count; ++i) {
      reportProgress(progress, i, count);
      profile.readFrame(i, frame);
      const float peak = *std::max_element(frame.values.begin(), frame.values.end());
      largest = i == 0 ? static_cast<double>(peak) : std::max(largest, static_cast<double>(peak));
      saturated += numSaturated(profile.hand(), frame) > 0 ? 1 : 0;
    }
  });
  py::dict result;
  result["format"] = profile.info().format;
  result["value_type"] = profile.info().valueType == ValueType::kCounts ? "counts" : "float";
  result["frames"] = profile.numFrames();
  result["duration_s"] = timing.durationS;
  result["rate_hz"] = timing.rateHz;
  result["mean_rate_hz"] = timing.meanRateHz;
  result["gaps"] = timing.gaps.size();
  result["temperatures"] = profile.numTemperatures();
  result["joint_angles"] = profile.numAngles();
  result["max_value"] = largest;
  result["saturated_frames"] = saturated;
  result["serial"] = profile.info().serial;
  result["hand"] = profile.hand().name;
  result["warnings"] = profile.info().warnings;
  return result;
}

Table seconds(const fs::path& path) {
  using Row = SecondSummary;
  return tableOf([&](const Progress&) {
    return std::make_unique<RowTable<Row>>(
        "seconds",
        std::vector<ColumnOf<Row>>{
            columnOf<Row>("t_s", "s", "host time, since 1970", &Row::tS),
            columnOf<Row>("matrix", "", "number of the matrix, from 0", &Row::matrix),
            columnOf<Row>("frames", "", "frames in this second", &Row::frames),
            columnOf<Row>("min",
                          "counts",
                          "minimum of the touched taxels, 0 if none is touched",
                          &Row::minimum),
            columnOf<Row>("max", "counts", "maximum", &Row::maximum),
            columnOf<Row>("sum", "counts", "sum over the touched taxels of all frames", &Row::sum),
            columnOf<Row>("active_max",
                          "taxels",
                          "maximum number of touched taxels in a frame",
                          &Row::activeMax)},
        readSeconds(path));
  });
}

}  // namespace

void bindRecordings(py::module_& module) {
  module.def("load",
             &load,
             py::arg("path"),
             "Reads a recording (.dsa or .palpate; detected from its content). OSError when it "
             "can't be read, ValueError when it is damaged or not a recording. The frames of a "
             ".palpate, .h5 or .mcap are read when they are needed: only then is damage within "
             "them an Error; verify() checks every byte.");
  module.def("info",
             &info,
             py::arg("profile"),
             "Summary of a profile: dict format, value_type, frames, duration_s [s], rate_hz (from "
             "the median interval), mean_rate_hz [Hz], gaps (their number), temperatures, "
             "joint_angles (samples), max_value, saturated_frames, serial, hand, warnings.");
  module.def("verify",
             &verify,
             py::arg("path"),
             "Checks every byte: dict state ('sound', 'damaged': part of it can be read, "
             "'unreadable'), message (one line). Never raises for a bad file.");
  module.def("recover",
             &recover,
             py::arg("path"),
             py::arg("out"),
             py::kw_only(),
             py::arg("force") = false,
             "Saves what is readable in a damaged or unfinished recording as `out` (format by its "
             "ending); `path` isn't changed. dict state ('whole', 'part', 'nothing': no file was "
             "made), message. OSError, ValueError (not a recording).");
  module.def("events",
             &events,
             py::arg("path"),
             "The events of a recording, in order of time: list of dicts t_us, t1_us [us since "
             "1970], kind ('label', 'gap', 'settings', ..), matrix (or None), text, json. For a "
             ".dsa those of its sidecar. OSError, ValueError.");
  module.def("details",
             &details,
             py::arg("path"),
             "Details of a recording, without reading its frames: dict form, state ('finished', "
             "'recording', 'unfinished', 'damaged', 'unreadable'), message, size_bytes, start_us, "
             "duration_us, frames (None: not known), operator, object, run, notes, labels. Never "
             "raises for a bad file.");
  module.def(
      "meta",
      [](const fs::path& path) {
        return unlocked([&](const Progress&) { return readRecordingMeta(path); });
      },
      py::arg("path"),
      "Meta data of a recording: dict of texts ('serial', 'operator', 'settings', ..); empty for a "
      ".dsa. OSError, ValueError.");
  module.def(
      "seconds",
      &seconds,
      py::arg("path"),
      "The per-second summary of a recording (a .palpate holds it: its frames are not read): "
      "dict of columns "
      "t_s [s since 1970], matrix, frames, min, max, sum [counts], active_max. OSError, "
      "ValueError.");
}

}  // namespace palpate::python
