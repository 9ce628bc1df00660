// What remote control says about a hand and its recordings: the fields of answers, the same for
// every target; and when a start counts as done.
#pragma once

#include <optional>

#include <palpate/capture/link_health.h>
#include <palpate/capture/recorder.h>
#include <palpate/interop/remote_protocol.h>

namespace palpate {

// Sets `frames_received`, `rate_hz`, `age_ms`, `lost`, `bad_checksums`, `alarms` (texts) of the
// link.
void setLinkFields(Json& fields, const LinkHealth& health);
// Sets `file`, `frames`, `frames_on_disk`, `elapsed_s`, `bytes`, `recorder_lost`, `write_error` of
// a recording that runs.
void setRecorderFields(Json& fields, const RecorderStatus& recorder);
// The answer to `stop`: `files`, `frames`, `angles`, `temperatures`, `events`, `recorder_lost`,
// `gaps`, `duration_s`, `rate_hz`, `mean_rate_hz`, `bytes`, `complete`; the message is the
// report's. Error "no_frames" when there is no file.
RemoteAnswer stopAnswer(const RecordingReport& report);

struct StartLimits {
  double noHandS = 1.0;       // a newest frame older than this is no hand [s]
  double firstFrameS = 10.0;  // a start is given up without a frame on disk after so long [s]
  double diskS = 2.0;         // and after so long when the disk fails [s]
};

// Why nothing can be recorded now ("no_hand"); nothing: frames come.
std::optional<RemoteAnswer> noHand(const LinkHealth& health, const StartLimits& limits = {});
// Why there is no room for a recording ("no_space"); nothing: there is, or nobody knows.
std::optional<RemoteAnswer> noSpace(std::optional<std::uint64_t> freeBytes);

// Judges a start that was asked for `waitedS` ago: nothing as long as it must be waited for. Done
// once a frame is committed: `file`, `frames_on_disk`. "disk", "no_frames": give it up.
// `recording`: it runs still.
std::optional<RemoteAnswer> startResult(const RecorderStatus& recorder,
                                        bool recording,
                                        double waitedS,
                                        const StartLimits& limits = {});

}  // namespace palpate
