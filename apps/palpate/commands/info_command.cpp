// The command `palpate info PATH...` describes the content of one or several recordings.
#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/json.h"
#include "palpate/core/number_text.h"
#include "palpate/core/progress.h"
#include "palpate/core/text_table.h"
#include "palpate/core/time.h"
#include "palpate/model/fitted_times.h"
#include "palpate/model/timing.h"
#include "palpate/recording/recording.h"
#include "palpate/recording/recording_losses.h"

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/recording_list.h"
#include "commands/table_command.h"

namespace palpate::commands {
namespace {

struct ValueReport {
  double maximum = 0.0;
  std::size_t saturatedFrames = 0;  // with at least one taxel at or above saturation
  // Of the sender; empty where no frame has one.
  std::vector<std::optional<std::int64_t>> deviceUs = {};
};

ValueReport valuesOf(const Profile& profile, const Progress& progress) {
  ValueReport report;
  if (profile.numFrames() > 0) report.maximum = std::numeric_limits<double>::lowest();
  TactileFrame frame;
  for (std::size_t i = 0; i < profile.numFrames(); ++i) {
    reportProgress(progress, i, profile.numFrames());
    profile.readFrame(i, frame);
    const float largest = *std::max_element(frame.values.begin(), frame.values.end());
    report.maximum = std::max(report.maximum, static_cast<double>(largest));
    if (numSaturated(profile.hand(), frame) > 0) ++report.saturatedFrames;
    if (frame.deviceUs && report.deviceUs.empty()) report.deviceUs.resize(profile.numFrames());
    if (frame.deviceUs) report.deviceUs[i] = frame.deviceUs;
  }
  return report;
}

// A detail that the operator entered; empty when there is none.
std::string saidOf(const Recording& recording, const std::string& key) {
  const auto at = recording.meta.find(key);
  return at == recording.meta.end() ? std::string() : at->second;
}

// Texts of events "label" and "segment", each once, ordered by time.
std::vector<std::string> labelsOf(const Recording& recording) {
  std::vector<std::string> texts;
  for (const Event& event : recording.events)
    if ((event.kind == "label" || event.kind == "segment") && !event.text.empty() &&
        std::find(texts.begin(), texts.end(), event.text) == texts.end())
      texts.push_back(event.text);
  return texts;
}

// The warnings of the reader, and the damage.
std::vector<std::string> warningsOf(const Recording& recording) {
  std::vector<std::string> warnings = recording.profile.info().warnings;
  if (!recording.damage.text.empty()) warnings.push_back(recording.damage.text);
  return warnings;
}

// The details that operators enter before a recording (docs/notes/palpate_format.md).
constexpr const char* kSaid[] = {"operator", "object", "run", "notes"};

Json detailsOf(const Event& event) {
  if (event.json.empty()) return {};
  try {
    return Json::parse(event.json);
  } catch (const Error&) {
    return event.json;
  }
}

Json eventsJson(const Recording& recording) {
  return jsonList(recording.events, [](const Event& event) {
    return Json::object()
        .set("time_ms", event.tUs / kUsPerMs)
        .set("end_ms", event.t1Us / kUsPerMs)
        .set("kind", event.kind)
        .set("matrix", event.matrix ? Json(*event.matrix) : Json())
        .set("text", event.text)
        .set("json", detailsOf(event));
  });
}

std::string joinedTexts(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : "; ") + text;
  return all;
}

const char* valueTypeText(const Profile& profile) {
  return profile.info().valueType == ValueType::kCounts ? "counts" : "float";
}

// The rate as JSON; null when it is unknown, because a rate needs two frames.
Json infoRateJson(double hz) { return hz > 0.0 ? Json(hz) : Json(); }

Json matricesJson(const SensorLayout& layout) {
  Json matrices = Json::array();
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    matrices.push(Json::object()
                      .set("index", m)
                      .set("rows", matrix.rows)
                      .set("columns", matrix.columns)
                      .set("pitch_mm", pitchJson(matrix.pitchMm))
                      .set("taxels", matrix.numTaxels())
                      .set("enabled", matrix.numEnabled()));
  }
  return matrices;
}

Json lossesJson(const std::vector<Event>& events) {
  return jsonList(lossesOf(events), [](const RecordingLoss& loss) {
    return Json::object()
        .set("stream", loss.stream)
        .set("lost", loss.counted ? Json(static_cast<std::int64_t>(loss.lost)) : Json())
        .set("spans", loss.spans)
        .set("seconds", loss.seconds);
  });
}

std::vector<std::string> lossTexts(const std::vector<Event>& events) {
  std::vector<std::string> texts;
  for (const RecordingLoss& loss : lossesOf(events)) texts.push_back(loss.text());
  return texts;
}

// The series in addition to those of the hand.
Json furtherSeriesJson(const Profile& profile) {
  Json all = Json::array();
  for (std::size_t i = kHandSeries; i < profile.series().size(); ++i) {
    const SeriesDescription& series = profile.series()[i];
    all.push(
        Json::object()
            .set("name", series.name)
            .set("role", series.role)
            .set("columns",
                 jsonList(series.columns,
                          [](const Column& column) {
                            return Json::object().set("name", column.name).set("unit", column.unit);
                          }))
            .set("source", series.source)
            .set("samples", profile.numSamples(i))
            .set("mean_rate_hz", infoRateJson(profile.meanSampleRateHz(i))));
  }
  return all;
}

// The senders' clocks; empty where no frame and no sample has a time of one.
std::vector<FittedClock> sendersClocks(const Profile& profile, const ValueReport& values) {
  std::vector<FittedClock> clocks = clocksOf(profile, values.deviceUs);
  std::erase_if(clocks, [](const FittedClock& clock) { return clock.isWithoutTimes; });
  return clocks;
}

Json clocksJson(const std::vector<FittedClock>& clocks) {
  return jsonList(clocks, [](const FittedClock& clock) {
    Json json = Json::object().set("of", clock.name);
    if (!clock.base) return json.set("problem", clock.why);
    const ClockReport& report = clock.base->report();
    return json.set("drift_ppm", report.driftPpm ? Json(*report.driftPpm) : Json())
        .set("delay_spread_ms", report.delaySpreadMs)
        .set("restarts", report.restarts)
        .set("rms_ms", report.rmsMs)
        .set("bound_ms", report.boundMs)
        .set("unusable", report.unusable);
  });
}

// `report` contains the members that come first.
Json infoJsonOf(Json report,
                const Recording& recording,
                const TimingReport& timing,
                const ValueReport& values) {
  const Profile& profile = recording.profile;
  const ProfileInfo& info = profile.info();
  Json gaps = jsonList(timing.gaps, [](const Gap& gap) {
    return Json::object().set("frame", gap.frame).set("seconds", gap.seconds);
  });
  Json warnings = jsonList(warningsOf(recording));
  const std::vector<FittedClock> clocks = sendersClocks(profile, values);
  report.set("format", info.format)
      .set("value_type", valueTypeText(profile))
      .set("frames", profile.numFrames())
      .set("duration_s", timing.durationS)
      .set("rate_hz", infoRateJson(timing.rateHz))
      .set("mean_rate_hz", infoRateJson(timing.meanRateHz))
      .set("gaps", timing.gaps.size())
      .set("gap_list", gaps)
      .set("lost", lossesJson(recording.events))
      .set("matrices", matricesJson(profile.layout()))
      .set("temperatures", profile.numTemperatures())
      .set("joint_angles", profile.numAngles())
      .set("series", furtherSeriesJson(profile))
      .set("max_value", values.maximum)
      .set("saturated_frames", values.saturatedFrames)
      .set("serial", info.serial)
      .set("firmware", info.firmware)
      .set("hand", profile.hand().name)
      .set("start_utc", profile.numFrames() ? Json(utcText(profile.frameTimeUs(0))) : Json())
      .set("warnings", warnings);
  if (!clocks.empty()) report.set("clocks", clocksJson(clocks));
  for (const char* key : kSaid) report.set(key, saidOf(recording, key));
  Json labels = jsonList(labelsOf(recording));
  report.set("labels", labels)
      .set("events", eventsJson(recording))
      .set("damaged_events", recording.damage.events);
  return report;
}

std::string row(const std::string& name, const std::string& value) {
  std::string line = name;
  line.resize(std::max<std::size_t>(18, line.size() + 1), ' ');
  return line + escapedLine(value) + "\n";
}

std::string matricesText(const Profile& profile) {
  std::string text;
  const SensorLayout& layout = profile.layout();
  for (std::size_t m = 0; m < layout.numMatrices(); ++m) {
    const MatrixLayout& matrix = layout.matrix(m);
    std::string line = std::to_string(matrix.rows) + " x " + std::to_string(matrix.columns) +
                       " places, " + counted(matrix.numTaxels(), "taxel") + " of " +
                       pitchText(matrix.pitchMm);
    if (matrix.numEnabled() != matrix.numTaxels())
      line += ", " + std::to_string(matrix.numEnabled()) + " enabled";
    text += row("  " + std::to_string(m), profile.hand().matrixName(m) + ": " + line);
  }
  return text;
}

// The operator's details, then every event with its time since the first frame.
std::string notesText(const Recording& recording) {
  const Profile& profile = recording.profile;
  constexpr std::size_t kMaxListed = 200;
  std::string text;
  for (const char* key : kSaid)
    if (const std::string said = saidOf(recording, key); !said.empty()) text += row(key, said);
  if (const auto labels = labelsOf(recording); !labels.empty())
    text += row("labels", joinedTexts(labels));
  const auto& events = recording.events;
  text += row("events", std::to_string(events.size()));
  const std::int64_t beginUs = profile.numFrames() > 0 ? profile.frameTimeUs(0) : 0;
  const auto seconds = [&](std::int64_t us) {
    return fixedText(static_cast<double>(us - beginUs) / kUsPerS, 2);
  };
  for (std::size_t i = 0; i < std::min(events.size(), kMaxListed); ++i) {
    const Event& event = events[i];
    std::string when = seconds(event.tUs);
    if (event.t1Us != event.tUs) when += " to " + seconds(event.t1Us);
    std::string what = event.kind;
    if (event.matrix) what += ", matrix " + std::to_string(*event.matrix);
    if (!event.text.empty()) what += ": " + event.text;
    text += row("  " + when + " s", what);
  }
  if (events.size() > kMaxListed)
    text += row("", "and " + std::to_string(events.size() - kMaxListed) + " more: --json has all");
  if (recording.damage.events > 0)
    text += row("warning", eventsLeftOutText(recording.damage.events));
  return text;
}

std::string plainText(const std::string& file,
                      const Recording& recording,
                      const TimingReport& timing,
                      const ValueReport& values) {
  const Profile& profile = recording.profile;
  const ProfileInfo& info = profile.info();
  std::string text = row("file", file);
  text += row("format", info.format + ", values are " + valueTypeText(profile));
  text += row("sensor",
              profile.hand().name + (info.serial.empty() ? "" : ", serial " + info.serial) +
                  (info.firmware.empty() ? "" : ", firmware " + info.firmware));
  text += row("frames", std::to_string(profile.numFrames()));
  if (profile.numFrames() > 0) text += row("start", utcText(profile.frameTimeUs(0)) + " UTC");
  text += row("duration", fixedText(timing.durationS, 3) + " s");
  text +=
      row("rate",
          timing.rateHz > 0.0 ? fixedText(timing.rateHz, 2) +
                                    (timing.inBursts ? " Hz (without gaps; frames came in bursts), "
                                                     : " Hz (median interval), ") +
                                    fixedText(timing.meanRateHz, 2) + " Hz (mean)"
                              : "not known: fewer than two frames");
  std::string gaps = std::to_string(timing.gaps.size());
  for (const Gap& gap : timing.gaps)
    gaps += (&gap == &timing.gaps.front() ? ": " : ", ") + fixedText(gap.seconds, 1) +
            " s after frame " + std::to_string(gap.frame);
  text += row("gaps", gaps + (profile.numFrames() > 0 ? " (of the frames)" : ""));
  for (const std::string& loss : lossTexts(recording.events)) text += row("lost", loss);
  text += row("joint angles", counted(profile.numAngles(), "sample"));
  text += row("temperatures", counted(profile.numTemperatures(), "sample"));
  for (std::size_t i = kHandSeries; i < profile.series().size(); ++i)
    text += row("series", profile.series()[i].name + ": " + seriesText(profile, i));
  for (const FittedClock& clock : sendersClocks(profile, values))
    text += row("clock", clock.text());
  text += row("largest value",
              numberText(values.maximum) + ", " + counted(values.saturatedFrames, "frame") +
                  " with a saturated taxel (>= " + profile.hand().saturationText() + ")");
  text += row("matrices", std::to_string(profile.layout().numMatrices()));
  text += matricesText(profile);
  text += notesText(recording);
  for (const std::string& warning : warningsOf(recording)) text += row("warning", warning);
  return text;
}

constexpr const char* kTableHeader =
    "file,format,value_type,frames,duration_s,rate_hz,mean_rate_hz,gaps,temperatures,joint_angles,"
    "max_value,saturated_frames,serial,warnings,operator,object,run,notes,labels,events,lost\n";

// One row of the table over several recordings; unknown values are empty.
std::string tableRow(const std::filesystem::path& file,
                     const Recording& recording,
                     const TimingReport& timing,
                     const ValueReport& values) {
  const Profile& profile = recording.profile;
  const ProfileInfo& info = profile.info();
  const auto rate = [](double hz) { return hz > 0.0 ? numberText(hz) : std::string(); };
  return csvLine({file.string(),
                  info.format,
                  valueTypeText(profile),
                  std::to_string(profile.numFrames()),
                  numberText(timing.durationS),
                  rate(timing.rateHz),
                  rate(timing.meanRateHz),
                  std::to_string(timing.gaps.size()),
                  std::to_string(profile.numTemperatures()),
                  std::to_string(profile.numAngles()),
                  profile.numFrames() > 0 ? numberText(values.maximum) : std::string(),
                  std::to_string(values.saturatedFrames),
                  info.serial,
                  joinedTexts(warningsOf(recording)),
                  saidOf(recording, "operator"),
                  saidOf(recording, "object"),
                  saidOf(recording, "run"),
                  saidOf(recording, "notes"),
                  joinedTexts(labelsOf(recording)),
                  std::to_string(recording.events.size()),
                  joinedTexts(lossTexts(recording.events))});
}

// Of one recording a report, of several (or into a .csv) a table with a row each, or JSON.
int writeInfo(const CommandLine& given, const RecordingList& recordings) {
  const bool json = formOf(given) == TableForm::kJson;
  const bool table = !json && (recordings.several || given.has("output"));
  const bool list = json && recordings.several;
  const bool any = !recordings.files.empty();
  ResultOutput out(given);
  if (any && table) out.write(kTableHeader);
  if (any && list) out.write("{\"recordings\": [");
  out.flush();
  const int code = writeReadableTexts(
      recordings,
      given.quiet(),
      list ? TextFrame{.begin = "\n", .between = ",\n"} : TextFrame{},
      out,
      [&](const std::filesystem::path& file,
          const Recording& recording,
          const TextSink& write,
          const Progress& progress) {
        const TimingReport timing = timingOf(recording.profile);
        const ValueReport values = valuesOf(recording.profile, progress);
        Json first = Json::object();
        if (list) first.set("file", file.string());
        write(table  ? tableRow(file, recording, timing, values)
              : list ? infoJsonOf(first, recording, timing, values).text(-1)
              : json ? infoJsonOf(first, recording, timing, values).text() + "\n"
                     : plainText(file.string(), recording, timing, values));
      },
      given.texts("topic"));
  if (any && list) out.write("\n]}\n");
  if (code == kFailed)
    out.flush();
  else
    out.finish();
  return code;
}

}  // namespace

int infoCommand(const Arguments& words) {
  const CommandLine given(
      {.synopsis = "palpate info PATH... [--json] [-o OUT.csv] [--topic TOPIC]..",
       .purpose =
           "Shows what a recording contains: frames, rates, gaps, matrices, angles, temperatures, "
           "largest value, what was entered before recording (operator, object, run, notes), "
           "labels and events (of a .dsa those of its notes). The rate comes from the median "
           "interval; a gap is longer than max(1 s, 5 median intervals), and only of frames; the "
           "losses of frames, angles and temperatures that the events report are listed "
           "separately. For several "
           "PATHs or a folder (every recording below it) it prints a table as CSV, a row each; a "
           "file that can't be read is reported, and the others are printed: exit code 3. Of a "
           "damaged "
           "recording it shows what can be read and what is missing: also exit code 3.",
       .options = withOutputOptions(
           {{"json",
             "",
             "one object of JSON, for several with the list recordings; -o: by the ending"},
            topicOption()},
           "OUT.csv"),
       .example = "palpate info foam_ball.dsa --json",
       .minArguments = 1},
      words);
  if (given.helpShown()) return kDone;
  return writeInfo(given, recordingsIn(given.words()));
}

}  // namespace palpate::commands
