// palpate info FILE [--json]: what is in a recording.
#include <algorithm>
#include <limits>
#include <string>

#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/core/one_line.h"
#include "palpate/core/time.h"
#include "palpate/model/timing.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/commands.h"

namespace palpate::commands {
namespace {

struct ValueReport {
  double maximum = 0.0;
  std::size_t saturatedFrames = 0;  // with at least one taxel at or above saturation
};

ValueReport valuesOf(const Profile& profile) {
  ValueReport report;
  if (profile.numFrames() > 0) report.maximum = std::numeric_limits<double>::lowest();
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    profile.readFrame(i, frame);
    const float largest = *std::max_element(frame.values.begin(), frame.values.end());
    report.maximum = std::max(report.maximum, static_cast<double>(largest));
    if (largest >= profile.hand().saturationCounts) ++report.saturatedFrames;
  }
  return report;
}

const char* valueTypeText(const Profile& profile) {
  return profile.info().valueType == ValueType::kCounts ? "counts" : "float";
}

// A rate needs two frames; with fewer it is not known.
Json rateJson(double hz) { return hz > 0.0 ? Json(hz) : Json(); }

Json matricesJson(const SensorLayout& layout) {
  Json matrices = Json::array();
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    matrices.push(Json::object()
                      .set("index", m)
                      .set("rows", matrix.rows)
                      .set("columns", matrix.columns)
                      .set("pitch_mm", matrix.pitchMm)
                      .set("taxels", matrix.numTaxels())
                      .set("enabled", matrix.numEnabled()));
  }
  return matrices;
}

std::string jsonText(const Profile& profile,
                     const TimingReport& timing,
                     const ValueReport& values) {
  const ProfileInfo& info = profile.info();
  Json gaps = Json::array();
  for (const Gap& gap : timing.gaps)
    gaps.push(Json::object().set("frame", gap.frame).set("seconds", gap.seconds));
  Json warnings = Json::array();
  for (const std::string& warning : info.warnings) warnings.push(warning);
  Json report = Json::object();
  report.set("format", info.format)
      .set("value_type", valueTypeText(profile))
      .set("frames", profile.numFrames())
      .set("duration_s", timing.durationS)
      .set("rate_hz", rateJson(timing.rateHz))
      .set("mean_rate_hz", rateJson(timing.meanRateHz))
      .set("gaps", timing.gaps.size())
      .set("gap_list", gaps)
      .set("matrices", matricesJson(profile.layout()))
      .set("temperatures", profile.numTemperatures())
      .set("joint_angles", profile.numAngles())
      .set("max_value", values.maximum)
      .set("saturated_frames", values.saturatedFrames)
      .set("serial", info.serial)
      .set("firmware", info.firmware)
      .set("hand", profile.hand().name)
      .set("start_utc", profile.numFrames() ? Json(utcText(profile.frameTimeUs(0))) : Json())
      .set("warnings", warnings);
  return report.text() + "\n";
}

std::string row(const std::string& name, const std::string& value) {
  std::string line = name;
  line.resize(std::max<std::size_t>(18, line.size() + 1), ' ');
  return line + oneLine(value) + "\n";
}

std::string matricesText(const Profile& profile) {
  std::string text;
  const SensorLayout& layout = profile.layout();
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    std::string line = std::to_string(matrix.rows) + " x " + std::to_string(matrix.columns) +
                       " places, " + std::to_string(matrix.numTaxels()) + " taxels of " +
                       numberText(matrix.pitchMm) + " mm";
    if (matrix.numEnabled() != matrix.numTaxels())
      line += ", " + std::to_string(matrix.numEnabled()) + " enabled";
    text += row("  " + std::to_string(m), profile.hand().matrixName(m) + ": " + line);
  }
  return text;
}

std::string plainText(const std::string& file,
                      const Profile& profile,
                      const TimingReport& timing,
                      const ValueReport& values) {
  const ProfileInfo& info = profile.info();
  std::string text = row("file", file);
  text += row("format", info.format + ", values are " + valueTypeText(profile));
  text += row("sensor",
              profile.hand().name + (info.serial.empty() ? "" : ", serial " + info.serial) +
                  (info.firmware.empty() ? "" : ", firmware " + info.firmware));
  text += row("frames", std::to_string(profile.numFrames()));
  if (profile.numFrames() > 0) text += row("start", utcText(profile.frameTimeUs(0)) + " UTC");
  text += row("duration", fixedText(timing.durationS, 3) + " s");
  text += row("rate",
              timing.rateHz > 0.0 ? fixedText(timing.rateHz, 2) + " Hz (median interval), " +
                                        fixedText(timing.meanRateHz, 2) + " Hz (mean)"
                                  : "not known: fewer than two frames");
  std::string gaps = std::to_string(timing.gaps.size());
  for (const Gap& gap : timing.gaps)
    gaps += (&gap == &timing.gaps.front() ? ": " : ", ") + fixedText(gap.seconds, 1) +
            " s after frame " + std::to_string(gap.frame);
  text += row("gaps", gaps);
  text += row("joint angles", std::to_string(profile.numAngles()) + " samples");
  text += row("temperatures", std::to_string(profile.numTemperatures()) + " samples");
  text +=
      row("largest value",
          numberText(values.maximum) + ", " + std::to_string(values.saturatedFrames) +
              " frames with a saturated taxel (>= " + numberText(profile.hand().saturationCounts) +
              ")");
  text += row("matrices", std::to_string(profile.layout().numMatrices()));
  text += matricesText(profile);
  for (const std::string& warning : info.warnings) text += row("warning", warning);
  return text;
}

}  // namespace

int infoCommand(const Words& words) {
  const CommandLine given(
      {.synopsis = "palpate info FILE [--json]",
       .purpose =
           "Says what is in a recording: frames, rates, gaps, matrices, angles, temperatures, "
           "largest value.\nThe rate comes from the median interval; a gap is longer than "
           "max(1 s, 5 median intervals).",
       .options = {{"json", "", "one JSON object"}},
       .example = "palpate info foam_ball.dsa --json",
       .fewestWords = 1,
       .mostWords = 1},
      words);
  if (given.helpShown()) return kDone;
  const std::string& file = given.words()[0];
  const Profile profile = [&] {
    ProgressLine progress("reading " + file, given.quiet());
    return openRecording(file, progress.callback());
  }();
  const TimingReport timing = timingOf(profile);
  const ValueReport values = valuesOf(profile);
  StandardOutput out;
  out.write(given.has("json") ? jsonText(profile, timing, values)
                              : plainText(file, profile, timing, values));
  out.finish();
  return kDone;
}

}  // namespace palpate::commands
