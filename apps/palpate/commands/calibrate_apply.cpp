// The command `palpate calibrate apply FILE --calibration C.json` converts a recording to pressures
// [kPa] and forces [N], frame by frame.
#include <cstdio>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"
#include "palpate/core/time.h"
#include "palpate/model/profile_builder.h"
#include "palpate/recording/recording.h"

#include "commands/calibrate_commands.h"
#include "commands/calibrated_frames.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

constexpr const char* kCalibrateApplyColumns =
    "frame,time_ms,matrix,active,K,pressure_kpa,pressure_sd_kpa,force_n,force_sd_n,in_range,"
    "temperature_known,"
    "saturated\n";

void calibrateApplyAppendRow(std::string& line,
                             std::size_t frame,
                             std::size_t matrix,
                             const PressureFrame& pressures) {
  const MatrixPressure& p = pressures.matrices[matrix];
  line.clear();
  for (const std::int64_t whole : {static_cast<std::int64_t>(frame),
                                   pressures.hostUs / kUsPerMs,
                                   static_cast<std::int64_t>(matrix),
                                   static_cast<std::int64_t>(p.active)}) {
    appendNumber(line, whole);
    line += ',';
  }
  for (const double value : {p.staticResponseCounts, p.kpa, p.sdKpa}) {
    appendNumber(line, value);
    line += ',';
  }
  for (const double value : {p.forceN, p.sdForceN}) {
    if (pressures.areaKnown) appendNumber(line, value);
    line += ',';
  }
  for (const bool flag : {p.inRange, p.temperatureKnown, p.saturated}) {
    line += flag ? '1' : '0';
    line += ',';
  }
  line.back() = '\n';
}

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
  if (outPath) requireOther(file, *outPath);
  ProgressLine progress("reading " + file.string(), given.quiet());
  const Recording recording = openReported(file, progress, given.quiet());
  const Profile& profile = recording.profile;
  CalibratedFrames frames(*choice, file, recording, profile);
  // Without the pressures' forces the result is not whole: that is said with --quiet, too.
  const bool noForces = !frames.areaKnown() && !outPath;
  for (const std::string& sentence : frames.assumptions())
    if (!given.quiet() || (noForces && sentence == kUnknownAreaText))
      std::fprintf(stderr, "palpate: %s\n", escapedLine(sentence).c_str());
  StandardOutput out;
  if (!outPath) out.write(kCalibrateApplyColumns);
  ProfileBuilder builder(profile.hand());
  std::size_t beyond = 0, touched = 0;
  std::string line;
  TactileFrame frame;
  const Progress report = progress.callback();
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(report, i, profile.numFrames());
    profile.readFrame(i, frame);
    const PressureFrame& pressures = frames.of(frame);
    for (std::size_t m = 0; m < pressures.matrices.size(); ++m) {
      if (pressures.matrices[m].active == 0) continue;
      ++touched;
      beyond += pressures.matrices[m].inRange ? 0 : 1;
      if (outPath) continue;
      calibrateApplyAppendRow(line, i, m, pressures);
      out.write(line);
    }
    if (outPath) builder.addFrame(frame.hostUs, pressures.kpa, frame.deviceUs);
  }
  out.finish();
  progress.wipe();
  if (beyond > 0 && !given.quiet())
    std::fprintf(
        stderr,
        "palpate: %zu of %zu contacts are outside the measured range: don't rely on them\n",
        beyond,
        touched);
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
