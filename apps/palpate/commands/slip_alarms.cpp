#include "commands/slip_alarms.h"

#include "palpate/core/error.h"
#include "palpate/laboratory/slip_evaluation.h"
#include "palpate/recording/recording.h"

#include "commands/command_line.h"
#include "commands/recording_list.h"

namespace palpate::commands {
namespace {

Json slipAlarmsToJson(const SlipScore& score) {
  Json json = Json::object();
  json.set("per_hour", score.perHour(kAllContact))
      .set("per_hour_settled", score.perHour(kSettledContact))
      .set("per_hour_quiet", score.perHour(kQuietContact))
      .set("false_alarms", static_cast<std::int64_t>(score.falseAlarms[kAllContact]))
      .set("false_alarms_settled", static_cast<std::int64_t>(score.falseAlarms[kSettledContact]))
      .set("hours", score.matrixHours[kAllContact])
      .set("hours_settled", score.matrixHours[kSettledContact])
      .set("slips", static_cast<std::int64_t>(score.slips))
      .set("found", static_cast<std::int64_t>(score.found))
      .set("found_part", score.detectionRate());
  if (const std::size_t n = score.delaysFrames.size(); n > 0)
    json.set("delay_median_frames", static_cast<std::int64_t>(score.delaysFrames[n / 2]))
        .set("delay_p90_frames", static_cast<std::int64_t>(score.delaysFrames[n * 9 / 10]));
  return json;
}

}  // namespace

Json slipAlarms(const std::filesystem::path& folder, bool quiet) {
  SlipEvaluation evaluation;
  const auto readAll = [&](const char* below, bool slip) {
    const std::filesystem::path path = folder / below;
    if (!std::filesystem::is_directory(path))
      throw Error(path.string() +
                  ": is not a folder; FOLDER must contain slip-detection and grasps_by_class");
    const int code = forEachOpened(
        recordingsIn({path.string()}),
        quiet,
        [&](const std::filesystem::path&, const Recording& recording, const Progress& progress) {
          if (slip)
            evaluation.addSlipRecording(recording.profile, progress);
          else
            evaluation.addNoSlipRecording(recording.profile, progress);
        });
    if (code != kDone) throw Error(path.string() + ": not all recordings could be read");
  };
  readAll("slip-detection", true);
  readAll("grasps_by_class", false);
  const SlipEvaluationReport report = evaluation.report();
  Json alarms = Json::object();
  for (const ScoredAlarm& alarm : report.alarms)
    alarms.set(alarm.name, slipAlarmsToJson(alarm.score));
  Json json = Json::object();
  json.set("hold_recordings", static_cast<std::int64_t>(report.noSlipRecordings))
      .set("slip_recordings", static_cast<std::int64_t>(report.slipRecordings))
      .set("methods", alarms);
  return json;
}

}  // namespace palpate::commands
