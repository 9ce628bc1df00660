#include "palpate/interop/remote_fields.h"

#include <string>

#include "palpate/core/number_text.h"
#include "palpate/core/time.h"

namespace palpate {
namespace {

constexpr std::uint64_t kMinFreeBytes = 1U << 20;  // one minute of an SDH-2

Json known(double value) { return value > 0.0 ? Json(value) : Json(); }

}  // namespace

void setLinkFields(Json& fields, const LinkHealth& health) {
  fields.set("frames_received", static_cast<std::int64_t>(health.frames.frames));
  fields.set("rate_hz", known(health.frames.rateHz));
  fields.set("age_ms", health.frames.ageMs ? Json(*health.frames.ageMs) : Json());
  fields.set("lost", static_cast<std::int64_t>(health.lost));
  fields.set("bad_checksums", static_cast<std::int64_t>(health.badChecksums));
  Json alarms = Json::array();
  for (const Alarm& alarm : health.alarms) alarms.push(alarm.text);
  fields.set("alarms", std::move(alarms));
}

void setRecorderFields(Json& fields, const RecorderStatus& recorder) {
  if (!recorder.path.empty()) fields.set("file", recorder.path.string());
  fields.set("frames", recorder.frames);
  fields.set("frames_on_disk", recorder.framesOnDisk);
  fields.set("elapsed_s", recorder.elapsedS);
  fields.set("bytes", recorder.bytesOnDisk);
  fields.set("recorder_lost", recorder.lost + recorder.refused);
  const std::string& error =
      recorder.writeError.empty() ? recorder.relocation : recorder.writeError;
  fields.set("write_error", error.empty() ? Json() : Json(error));
}

RemoteAnswer stopAnswer(const RecordingReport& report) {
  if (report.paths.empty())
    return RemoteAnswer::refused(
        "no_frames", report.message.empty() ? "no frame arrived while it ran" : report.message);
  RemoteAnswer answer;
  answer.message = report.message;
  Json files = Json::array();
  for (const auto& path : report.paths) files.push(path.string());
  answer.fields.set("files", std::move(files))
      .set("frames", report.frames)
      .set("angles", report.angles)
      .set("temperatures", report.temperatures)
      .set("events", report.events)
      .set("recorder_lost", report.lost + report.refused)
      .set("gaps", report.gaps)
      .set("duration_s", report.durationS)
      .set("rate_hz", known(report.rateHz))
      .set("mean_rate_hz", known(report.meanRateHz))
      .set("bytes", report.bytes)
      .set("complete", report.complete);
  return answer;
}

std::optional<RemoteAnswer> noHand(const LinkHealth& health, const StartLimits& limits) {
  const auto& ageMs = health.frames.ageMs;
  if (ageMs && *ageMs <= limits.noHandS * kMsPerS) return {};
  std::string why = ageMs ? "no frame has arrived for " + fixedText(*ageMs / kMsPerS, 1) + " s"
                          : std::string("no frame has arrived yet");
  const PortStatus& tactile = health.device.tactile;
  why += tactile.message.empty() ? "; is the hand switched on and its cable plugged in?"
                                 : ": " + tactile.message;
  return RemoteAnswer::refused("no_hand", why);
}

std::optional<RemoteAnswer> noSpace(std::optional<std::uint64_t> freeBytes) {
  if (!freeBytes || *freeBytes >= kMinFreeBytes) return {};
  return RemoteAnswer::refused(
      "no_space",
      "the disk of the recordings is full (" + std::to_string(*freeBytes) + " bytes free)");
}

std::optional<RemoteAnswer> startResult(const RecorderStatus& recorder,
                                        bool recording,
                                        double waitedS,
                                        const StartLimits& limits) {
  if (recorder.framesOnDisk > 0) {
    RemoteAnswer answer;
    answer.fields.set("file", recorder.path.string()).set("frames_on_disk", recorder.framesOnDisk);
    return answer;
  }
  if (!recording)
    return RemoteAnswer::refused("disk", "the recording ended before a frame was on disk");
  if (!recorder.writeError.empty() && waitedS >= limits.diskS)
    return RemoteAnswer::refused("disk", recorder.writeError);
  if (waitedS < limits.firstFrameS) return {};
  const std::string time = fixedText(limits.firstFrameS, 1) + " s";
  if (recorder.frames > 0)
    return RemoteAnswer::refused("disk", "no frame was on disk within " + time);
  return RemoteAnswer::refused("no_frames", "no frame arrived within " + time);
}

}  // namespace palpate
