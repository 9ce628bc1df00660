// Binds palpate.compare(), labels() and convert(): what the commands of these names do.
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "palpate/batch/batch_task.h"
#include "palpate/core/error.h"
#include "palpate/recording/label_table.h"
#include "palpate/recording/recording.h"
#include "palpate/signals/alignment.h"
#include "palpate/signals/curve_rows.h"

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/filters.h"
#include "python/interruption.h"
#include "python/result_binding.h"

namespace palpate::python {
namespace py = pybind11;
namespace {

namespace fs = std::filesystem;

// A Profile, or the recording at a path.
Profile profileGiven(const py::object& source) {
  if (py::isinstance<Profile>(source)) return source.cast<Profile>();
  const auto path = source.cast<fs::path>();
  return unlocked([&](const Progress& progress) { return openRecording(path, progress); });
}

Table compare(const py::object& a,
              const py::object& b,
              const std::string& align,
              std::optional<double> offsetS) {
  const auto alignment = choice<Alignment>("align",
                                           align,
                                           {{"contact", Alignment::kContact},
                                            {"start", Alignment::kStart},
                                            {"clock", Alignment::kClock}});
  constexpr double kFurthestS = 1e9;
  if (offsetS && !(std::abs(*offsetS) <= kFurthestS))
    throw py::value_error("offset is not in -1e9 .. 1e9 s");
  const Profile profileA = profileGiven(a), profileB = profileGiven(b);
  return tableOf([&](const Progress& progress) {
    const TimedProfile timedA = timedProfile(profileA, {}, partOf(progress, 0.0, 0.2)),
                       timedB = timedProfile(profileB, {}, partOf(progress, 0.2, 0.4));
    const auto foundS = offsetS ? offsetS : offsetBetween(timedA, timedB, alignment);
    if (!foundS)
      throw Error("the two can't be aligned: " +
                  std::string(alignment == Alignment::kContact
                                  ? "one has no lasting contact; use align='start'"
                                  : "one has no frames"));
    auto table = comparisonTable(timedA, timedB, *foundS, partOf(progress, 0.4, 1.0));
    if (!commonSpan(timedA, timedB, *foundS))
      table->note("the two have no moment in common at this alignment");
    for (const auto& [name, profile] : {std::pair("a", &profileA), std::pair("b", &profileB)})
      if (const std::string lost = lostText(*profile); !lost.empty())
        table->note(std::string(name) + ": " + lost);
    return table;
  });
}

Table labels(const fs::path& path) {
  return tableOf([&](const Progress& progress) {
    const Recording recording = readRecording(path, {}, progress);
    recording.requireEvents();
    auto table = labelRows(recording.events, recording.profile);
    if (const std::size_t lost = recording.damage.events; lost > 0)
      table->note(eventsLeftOutText(lost));
    if (const std::string lost = lostText(recording.profile); !lost.empty()) table->note(lost);
    return table;
  });
}

py::dict convert(const fs::path& path,
                 const fs::path& out,
                 const py::args& specs,
                 bool fittedTimes,
                 bool withSignals,
                 bool withSlip,
                 bool unitsRow,
                 const std::optional<std::string>& compression,
                 const std::optional<std::string>& images,
                 bool force) {
  ConvertOptions options{
      .filters = recipeOf(specs),
      .choices = {.withSignals = withSignals, .withSlip = withSlip, .unitsRow = unitsRow},
      .times = fittedTimes ? TimeChoice::kFitted : TimeChoice::kArrival};
  if (compression)
    options.choices.compression = choice<McapCompression>("compression",
                                                          *compression,
                                                          {{"zstd", McapCompression::kZstd},
                                                           {"lz4", McapCompression::kLz4},
                                                           {"none", McapCompression::kNone}});
  if (images)
    options.choices.images = choice<McapImages>(
        "images", *images, {{"ros", McapImages::kRos}, {"foxglove", McapImages::kFoxglove}});
  const BatchTask task = convertTask(options);
  const BatchAnswer answer = unlocked([&](const Progress& progress) {
    requirePossible(options.choices, options.filters, out);
    requireOther(path, out);
    return task.work({.source = path, .target = out},
                     force ? Overwrite::kReplace : Overwrite::kRefuse,
                     progress,
                     0);
  });
  py::dict result;
  result["state"] = answer.problem.empty() ? "whole" : "part";
  result["message"] = answer.said + (answer.problem.empty() ? "" : "; " + answer.problem);
  return result;
}

}  // namespace

void bindCommands(py::module_& module) {
  module.def("compare",
             &compare,
             py::arg("a"),
             py::arg("b"),
             py::kw_only(),
             py::arg("align") = "contact",
             py::arg("offset") = py::none(),
             "Compares two recordings frame by frame: a, b are Profiles or paths. Table time_s [s "
             "from a's first frame], frame_a, frame_b (at the same time, or the last one before "
             "it), matrix, mean_a, mean_b (of the touched taxels), difference_mean, difference_rms "
             "(of a - b over the taxels that are touched in a or b): a row per frame of a and "
             "matrix that both have. align: 'contact' (first lasting contacts), 'start', 'clock' "
             "(host time); or offset: when b begins [s from a's first frame]. The notes of the "
             "table list what was lost when a or b was read. Error where they can't be aligned.");
  module.def("labels",
             &labels,
             py::arg("path"),
             "The labels, notes and marks in a recording: Table begin_s, end_s [s from the first "
             "frame], kind ('label', 'note', 'mark', 'segment'), text, matrix (NaN: of none). "
             "OSError, ValueError.");
  module.def(
      "convert",
      &convert,
      py::arg("path"),
      py::arg("out"),
      py::kw_only(),
      py::arg("fitted_times") = false,
      py::arg("signals") = true,
      py::arg("slip") = true,
      py::arg("units_row") = false,
      py::arg("compression") = py::none(),
      py::arg("images") = py::none(),
      py::arg("force") = false,
      "convert(path, out, *specs, fitted_times=False, ..) -> dict\n\nConverts a recording to the "
      "format of the ending of `out` (.dsa, .palpate, .csv, .npz, .h5, .mat, .mcap, .jsonl), "
      "filtered by specs, with its events. dict state ('whole', 'part': the recording is damaged), "
      "message: what was written, and what the format can't hold. signals, slip: whether to add "
      "them to .h5, .mat and .mcap; units_row: of .csv; compression: 'zstd', 'lz4', 'none', and "
      "images: 'ros', 'foxglove', of .mcap. OSError, ValueError.");
}

}  // namespace palpate::python
