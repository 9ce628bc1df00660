// The command `palpate slip FILE...` prints as CSV how contacts move on every matrix, and whether
// that is slip.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "palpate/batch/batch_task.h"
#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/text_table.h"
#include "palpate/core/time.h"
#include "palpate/slip/slip_rows.h"

#include "commands/batch_options.h"
#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/export_options.h"
#include "commands/filter_options.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

SlipRowsOptions slipOptionsOf(const CommandLine& given) {
  SlipRowsOptions request;
  SlipDetectorOptions& detector = request.pass.detector;
  std::vector<std::string> methods;
  for (const SlipMethod method : slipMethods()) methods.emplace_back(nameOf(method));
  const auto name = given.choice("method", methods);
  setSlipMethod(request, name ? std::string_view(*name) : nameOf(detector.method));
  try {
    setSlipReference(request, given.text("reference").value_or("first"));
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--reference is ") + error.what());
  }
  request.matrix = given.integer("matrix", 0, INT32_MAX);
  SlipRuleOptions& rule = detector.rule;
  rule.stepTaxels = given.number("step", 1e-3, 100.0).value_or(rule.stepTaxels);
  rule.referenceTaxels = given.number("limit", 1e-3, 100.0).value_or(rule.referenceTaxels);
  rule.rotationDeg = given.number("rotation", 0.1, 360.0).value_or(rule.rotationDeg);
  request.segments = given.has("segments");
  request.unitsRow = given.has("units-row");
  request.filters = recipeOf(given);
  return request;
}

}  // namespace

int slipCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis =
           "palpate slip PATH... [--method METHOD] [--reference first|rest|FRAME] [-o TEMPLATE]",
       .purpose =
           "Prints for every frame and every matrix with an active taxel, as CSV, how the contact "
           "moved since the frame before (dx, dy) and since the reference [taxels, x right, y "
           "down], by which angle it turned, and whether that is slip; docs/slip.md explains the "
           "columns. With --segments there is a row per slip instead. PATH is a recording, or a "
           "folder: every recording below it. With several recordings a last column names the "
           "file. With -o there is a table for each recording.",
       .options = withBatchOptions(withFilterOptions(
           {{"method",
             "METHOD",
             "centroid, alcazar, ncc-paraboloid, ncc-gauss3, phase, phase-normalized, "
             "register, contest (default: compares a motion with a load shift)"},
            {"matrix", "M", "only this matrix"},
            {"reference",
             "WHAT",
             "first: first frame with an active taxel (default); rest: each contact from when "
             "it is at rest; or a frame"},
            {"step", "T", "threshold per frame [taxels], default 0.20"},
            {"limit", "T", "threshold since the reference [taxels], default 1.0"},
            {"rotation", "DEG", "threshold of the rotation [deg], default 5"},
            {"segments", "", "a row per slip: frames, matrix, length of the path"},
            unitsRowOption()})),
       .example = "palpate slip bottle.dsa --reference rest > slip.csv",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  const SlipRowsOptions request = slipOptionsOf(given);
  const bool segments = request.segments;
  if (given.has("output"))
    return runBatchCommand(given, batchTemplateOf(given, {".csv"}), slipTask(request));
  refuseBatchOptions(given);
  const RecordingList recordings = recordingsIn(given.words());
  StandardOutput out;
  bool headerWritten = false;
  return forEachOpened(
      recordings,
      given.quiet(),
      [&](const std::filesystem::path& file, const Recording& whole, const Progress& progress) {
        const Profile profile = filteredBy(request.filters, whole, file, progress);
        requireThere(file, profile, request);
        if (!given.quiet() && !profile.layout().hasSquareTaxels())
          std::fprintf(stderr,
                       "palpate: %s: no rotation is measured where taxels aren't square\n",
                       escapedLine(file.string()).c_str());
        if (!headerWritten)
          out.write(std::string(segments ? kSlipSegmentColumns : kSlipColumns) +
                    (recordings.several ? ",file\n" : "\n"));
        if (!headerWritten && request.unitsRow)
          out.write(std::string(segments ? kSlipSegmentUnits : kSlipUnits) +
                    (recordings.several ? ",\n" : "\n"));
        headerWritten = true;
        const std::string lineEnd = recordings.several ? "," + csvLine({file.string()}) : "\n";
        (segments ? forEachSlipSegmentRow : forEachSlipRow)(
            profile,
            request.pass,
            request.matrix,
            [&](const std::string& row) { out.write(row + lineEnd); },
            progress);
        out.finish();
      });
}

}  // namespace palpate::commands
