// Driver of the tactile controller DSACON32-M: reads its properties, changes its settings and
// streams frames. All calls are synchronous and belong to the one thread that owns the port. Frames
// that arrive while an answer is awaited are not lost: they go to the sink.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <palpate/core/time.h>
#include <palpate/device/byte_channel.h>
#include <palpate/device/dsa_packet.h>
#include <palpate/model/matrix_layout.h>

namespace palpate {

struct DsaMatrixInfo {
  // The dynamic mask is the one read from the controller; all taxels are on if it reports none.
  MatrixLayout layout;
  std::vector<std::uint8_t> uniqueId;
  int hardwareRevision = 0;
  // Centre in a flat display layout [mm], not the pose on the hand.
  double centreMm[3] = {};
  double rotationDeg[3] = {};
  double fullScale = 0.0;  // [counts]
  bool sensitivityAdjustable = false;
  double sensitivity = 0.5;  // 0..1
  double factorySensitivity = 0.5;
  // Empty for firmware before 268, which does not report thresholds.
  std::optional<int> thresholdCounts;
};

struct DsaControllerInfo {
  // Serial number of the controller.
  std::uint32_t serial = 0;
  int hardwareVersion = 0;  // as BCD
  // Below 0x1000 a release number; otherwise one hexadecimal digit per part.
  int firmwareVersion = 0;
  int status = 0;    // bit 7 operable, bit 6 acquisition running
  int features = 0;  // bit 6 USB, bit 5 CAN, bit 4 RS-232
  // Revision of the tool that wrote the sensor's description.
  int generatedBy = 0;
  int sensorHardwareRevision = 0;
  std::uint32_t sensorSerial = 0;
  // True when the controller reported its masks.
  bool masksKnown = false;
  std::vector<DsaMatrixInfo> matrices;

  // Firmware as text: "2.9.0.0", or "268".
  std::string firmwareText() const;
  bool hasThresholds() const noexcept { return firmwareVersion >= 268; }
  // Firmware up to 288, except 269, misinterprets the request for one frame as the start of a
  // stream.
  bool hasSingleFrames() const noexcept { return firmwareVersion > 288 || firmwareVersion == 269; }
  SensorLayout layout() const;
};

struct DsaControllerOptions {
  // Time limit for one answer.
  std::chrono::milliseconds answerTimeout{1000};
  // Number of times that one request is sent before it fails.
  int tries = 3;
  // Time limit for open(): a booting controller does not answer for 8 s.
  std::chrono::milliseconds openTimeout{15'000};
  // Time limit for the answer to each try of the first stop.
  std::chrono::milliseconds stopAnswer{400};
  // Pause between a stop and the change of a setting.
  std::chrono::milliseconds settle{200};
  // True for run-length coded frames, false for raw frames.
  bool runLength = true;
  // Requests the masks once; only newer firmware answers, and a missing answer is no error.
  bool readMasks = true;
  // Called between waits; when it returns true, open() and pending requests end early with
  // DeviceError (kSilent).
  std::function<bool()> isCancelled;
};

struct DsaControllerStats {
  DsaPacketStats packets;
  std::uint64_t retries = 0;       // requests sent again
  std::uint64_t strayAnswers = 0;  // answers to no pending request
};

class DsaController {
 public:
  // `payload` belongs to a full-frame packet and is valid only inside the call.
  using FrameSink = std::function<void(std::span<const std::byte> payload)>;

  // The channel must outlive the driver. `frames` gets every frame packet as soon as it arrives.
  DsaController(ByteChannel& channel,
                FrameSink frames,
                const Clock& clock = systemClock(),
                DsaControllerOptions options = {});

  // Stops a stream that is still running, waits for silence and reads all properties. Throws
  // DeviceError, as do all other functions: kSilent (no answer), kWrongDevice (a motion controller
  // answers: ports swapped), kRefused (error code, with its meaning), kProtocol, kUnsupported
  // (firmware too old), kDisconnected.
  const DsaControllerInfo& open();
  const DsaControllerInfo& info() const noexcept { return info_; }

  // Push mode: frames arrive as fast as the controller scans; it ignores a requested rate.
  void startStream();
  // Returns when the controller has confirmed the stop; frames on the way still reach the sink.
  void stopStream();
  // Sends one stop once and waits at most `limit`; returns whether the controller answered. Used
  // before closing the port, and to test whether the controller is still there.
  bool stopStreamOnce(std::chrono::milliseconds limit);
  bool streaming() const noexcept { return streaming_; }
  // Pull mode: requests one frame and waits for it (it goes to the sink).
  void pullFrame();
  // Reads the bytes that arrived, waiting at most `timeout` for the first one. Returns their
  // number.
  std::size_t poll(std::chrono::milliseconds timeout);
  // Tells the parser that the line has been silent (see DsaPacketParser::flush).
  void flush();

  // Setters pause the stream (stop, settle, set, start again) and read back what was set.
  // `persistent` writes the controller's memory, which endures about 100,000 writes. Throw
  // std::invalid_argument when a value or a matrix is out of range; nothing was sent then.
  void setSensitivity(std::size_t matrix, double sensitivity, bool persistent = false);
  void resetSensitivity(std::size_t matrix);  // to the factory setting
  void setThreshold(std::size_t matrix, int counts, bool persistent = false);
  void setDynamicMask(std::size_t matrix, const Mask& mask);
  // Changes several settings within one pause: setters called inside `set` do not pause the stream
  // themselves.
  void whilePaused(const std::function<void()>& set);
  std::string descriptor(bool ofMatrix, std::size_t matrix);

  DsaControllerStats stats() const;

 private:
  using Bytes = std::vector<std::byte>;
  struct Answer {
    DsaId id;
    Bytes payload;
  };

  bool take(const DsaPacket& packet);
  std::optional<Answer> awaitAnswer(DsaId id, std::chrono::milliseconds limit);
  // Repeats the request until it is answered; checks the error word and the size (0: any size from
  // 2).
  Bytes request(DsaId id, const Bytes& payload, std::size_t answerBytes);
  // Discards answers that have arrived already: they can't belong to the next request.
  void dropLateAnswers();
  void send(DsaId id, const Bytes& payload);
  void acquisition(bool on, int rate);
  void awaitSilence(std::chrono::milliseconds silence, std::chrono::milliseconds limit);
  [[noreturn]] void failSilent(const std::string& what);
  bool looksLikeMotionController();
  void checkMatrix(std::size_t matrix) const;
  void readMatrix(std::size_t matrix);
  void readSettings(std::size_t matrix);
  void readMasks();
  Mask readMask(int type, std::size_t matrix);

  ByteChannel& channel_;
  FrameSink frames_;
  const Clock& clock_;
  DsaControllerOptions options_;
  DsaPacketParser parser_;
  std::vector<std::byte> buffer_;
  std::deque<Answer> answers_;
  DsaControllerInfo info_;
  bool streaming_ = false;
  bool paused_ = false;
  std::uint64_t framesTaken_ = 0;
  std::uint64_t retries_ = 0;
  std::uint64_t strayAnswers_ = 0;
};

// The meaning of an error code of the tactile controller ("index out of bounds").
std::string dsaErrorText(int code);

}  // namespace palpate
