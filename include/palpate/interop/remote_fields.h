// Fields of the answers of remote control about a hand and its recordings, the same for every
// RemoteTarget; also decides when a start is complete.
#pragma once

#include <optional>

#include <palpate/capture/link_health.h>
#include <palpate/capture/recorder.h>
#include <palpate/core/option_check.h>
#include <palpate/interop/remote_protocol.h>

namespace palpate {

// Sets the fields of the connection: `frames_received`, `rate_hz`, `age_ms`, `lost`,
// `bad_checksums`, `alarms` (texts).
void setLinkFields(Json& fields, const LinkHealth& health);
// Sets the fields of a running recording: `file`, `frames`, `frames_on_disk`, `elapsed_s`, `bytes`,
// `recorder_lost`, `write_error`.
void setRecorderFields(Json& fields, const RecorderStatus& recorder);
// The answer to `stop`: `files`, `frames`, `angles`, `temperatures`, `events`, `recorder_lost`,
// `gaps`, `duration_s`, `rate_hz`, `mean_rate_hz`, `bytes`, `complete`; the message is the
// report's. Error "no_frames" when there is no file.
RemoteAnswer stopAnswer(const RecordingReport& report);

struct StartLimits {
  // Without a newer frame than this, no hand counts as connected [s].
  double noHandS = 1.0;
  // A start fails when no frame is on disk after this time [s].
  static constexpr OptionRange kFirstFrameS{0.1, 1e6, "s"};
  double firstFrameS = 10.0;
  // A start fails when the disk still fails after this time [s].
  double diskS = 2.0;
};

// Reason why nothing can be recorded now ("no_hand"); empty when frames arrive.
std::optional<RemoteAnswer> noHand(const LinkHealth& health, const StartLimits& limits = {});
// Error "no_space" when the disk has no room for a recording; empty when it has, or when unknown.
std::optional<RemoteAnswer> noSpace(std::optional<std::uint64_t> freeBytes);

// Result of a start that was requested `waitedS` ago; empty while it is pending. It succeeds once a
// frame is committed (`file`, `frames_on_disk`) and fails with "disk" or "no_frames". `recording`:
// whether the recording still runs.
std::optional<RemoteAnswer> startResult(const RecorderStatus& recorder,
                                        bool recording,
                                        double waitedS,
                                        const StartLimits& limits = {});

}  // namespace palpate
