// The command `palpate calibrate apply FILE --calibration C.json` converts a recording to pressures
// [kPa] and forces [N], frame by frame.
#include <memory>
#include <vector>

#include "palpate/calibration/pressure_rows.h"
#include "palpate/core/error.h"
#include "palpate/core/progress.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "commands/calibrate_commands.h"
#include "commands/calibrated_frames.h"
#include "commands/export_options.h"
#include "commands/recording_list.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

// Copies joint angles and temperatures, so that the new recording is complete.
void copyState(const Profile& profile, ProfileBuilder& builder) {
  for (SeriesDescription& each : profile.furtherSeries()) builder.addSeries(std::move(each));
  for (std::size_t series = 0; series < profile.series().size(); ++series)
    for (std::size_t i = 0; i < profile.numSamples(series); ++i)
      builder.addSample(profile.sample(series, i));
}

}  // namespace

int calibrateApply(const Arguments& words) {
  std::vector<OptionSpec> options = calibrationOptions();
  options.push_back(
      {"output,o",
       "OUT",
       "write the pressure of every taxel [kPa] as a recording: .palpate, .dsa, .npz, .csv"});
  options.push_back({"force", "", "replace OUT"});
  options.push_back(unitsRowOption());
  options.push_back({"json", "", "one object of JSON instead of CSV"});
  options.push_back(timeColumnOption());
  const CommandLine given(
      {.synopsis = "palpate calibrate apply FILE --calibration C.json [-o OUT.palpate]",
       .purpose =
           "Computes pressure and force by a calibration. Prints CSV, a row per frame and "
           "matrix that is touched: K [counts], pressure [kPa] and force [N] with their "
           "standard deviations; in_range 0: outside the measured range, not reliable. Forces "
           "are empty, and the exit code is 3, where the calibration was made without "
           "--area.",
       .options = options,
       .example = "palpate calibrate apply grasp.palpate --calibration hand.json > force.csv",
       .minArguments = 1,
       .maxArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  const auto choice = calibrationGiven(given);
  if (!choice)
    throw UsageError("--calibration C.json is missing; 'palpate calibrate pressure' makes one");
  const std::filesystem::path file = given.words().front();
  const auto outPath = given.text("output");
  if (outPath && (given.has("json") || given.has("units-row") || given.has("time-column")))
    throw UsageError("--json, --units-row and --time-column are of the table: leave out -o");
  const TableTextOptions text = outPath ? TableTextOptions() : tableTextOf(given);
  if (outPath) requireOther(file, *outPath);
  ProgressLine progress("reading " + file.string(), given.quiet());
  const Recording recording = openReported(file, progress, given.quiet());
  const Profile& profile = recording.profile;
  CalibratedFrames frames(*choice, file, recording, profile);
  // Without the pressures' forces the result is incomplete: reported with --quiet as well.
  const bool noForces = !frames.areaKnown() && !outPath;
  for (const std::string& sentence : frames.assumptions())
    if (!given.quiet() || (noForces && sentence == kUnknownAreaText)) sayLine(sentence);
  ProfileBuilder builder(profile.hand());
  std::size_t beyond = 0, touched = 0, at = 0;
  TactileFrame frame;
  const Progress report = progress.callback();
  using Row = MatrixRow<TouchedPressure>;
  const auto more = [&](std::vector<Row>& rows) {
    if (at == profile.numFrames()) return false;
    reportProgress(report, at, profile.numFrames());
    profile.readFrame(at, frame);
    const PressureFrame& pressures = frames.of(frame);
    appendPressures(at++, pressures, rows);
    touched += rows.size();
    for (const Row& row : rows) beyond += row.value.pressure.inRange ? 0 : 1;
    if (outPath) builder.addFrame(frame.hostUs, pressures.kpa, frame.deviceUs);
    return true;
  };
  if (outPath) {
    for (std::vector<Row> rows; more(rows);) rows.clear();
  } else {
    StandardOutput out;
    writeTableText(
        *withTimeColumn(given,
                        file,
                        recording,
                        std::make_unique<RowTable<Row>>("pressures", pressureColumns(), more)),
        text,
        [&](const std::string& lines) { out.write(lines); });
    out.finish();
  }
  progress.wipe();
  if (beyond > 0 && !given.quiet())
    sayLine(std::to_string(beyond) + " of " + std::to_string(touched) +
            " contacts are outside the measured range: don't rely on them");
  if (outPath) {
    recording.requireEvents();
    copyState(profile, builder);
    ProfileInfo info = profile.info();
    info.valueType = ValueType::kFloat;
    reportLeftOut(profile, *outPath);
    saveRecording(builder.finish(info),
                  recording.events,
                  *outPath,
                  given.has("force") ? Overwrite::kReplace : Overwrite::kRefuse,
                  report);
  }
  return noForces && touched > 0 ? kPartlyDone : kDone;
}

}  // namespace palpate::commands
