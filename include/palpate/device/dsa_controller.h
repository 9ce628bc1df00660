// Driver of the tactile controller DSACON32-M: asks, sets, streams. Synchronous; the one thread
// that owns the port uses it. Frames that arrive while an answer is awaited are not lost: they go
// to the sink.
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
  MatrixLayout layout;  // dynamic mask as read; all on where the controller doesn't tell
  std::vector<std::uint8_t> uniqueId;
  int hardwareRevision = 0;
  double centreMm[3] = {};  // of a flat display layout, not the pose on the hand
  double rotationDeg[3] = {};
  double fullScale = 0.0;  // [counts]
  bool sensitivityAdjustable = false;
  double sensitivity = 0.5;  // 0..1
  double factorySensitivity = 0.5;
  std::optional<int> thresholdCounts;  // nothing: firmware before 268 doesn't tell
};

struct DsaControllerInfo {
  std::uint32_t serial = 0;  // of the controller
  int hardwareVersion = 0;   // BCD
  int firmwareVersion = 0;   // below 0x1000: release number; else one hex digit per part
  int status = 0;            // bit 7 operable, bit 6 acquisition running
  int features = 0;          // bit 6 USB, bit 5 CAN, bit 4 RS-232
  int generatedBy = 0;       // revision of the tool that wrote the sensor's description
  int sensorHardwareRevision = 0;
  std::uint32_t sensorSerial = 0;
  bool masksKnown = false;  // the controller told its masks
  std::vector<DsaMatrixInfo> matrices;

  // "2.9.0.0", or "268".
  std::string firmwareText() const;
  bool hasThresholds() const noexcept { return firmwareVersion >= 268; }
  // Firmware up to 288 but 269 takes "one frame" for "stream".
  bool hasSingleFrames() const noexcept { return firmwareVersion > 288 || firmwareVersion == 269; }
  SensorLayout layout() const;
};

struct DsaControllerOptions {
  std::chrono::milliseconds answerTimeout{1000};
  int tries = 3;                                  // of one request
  std::chrono::milliseconds openTimeout{15'000};  // a controller that boots is deaf for 8 s
  std::chrono::milliseconds stopAnswer{400};      // each try of the first stop waits so long
  std::chrono::milliseconds settle{200};          // after a stop, before something is set
  bool runLength = true;                          // frames run-length coded; else raw
  bool readMasks = true;  // newer firmware only; asked once, not insisted on
  // Asked between waits: true ends open() and request loops early with DeviceError (kSilent).
  std::function<bool()> isCancelled;
};

struct DsaControllerStats {
  DsaPacketStats packets;
  std::uint64_t retries = 0;       // requests sent again
  std::uint64_t strayAnswers = 0;  // answers nobody waited for
};

class DsaController {
 public:
  // `payload` of a full-frame packet; valid inside the call only.
  using FrameSink = std::function<void(std::span<const std::byte> payload)>;

  // The channel must outlive the driver. `frames` gets every frame packet, whenever it comes.
  DsaController(ByteChannel& channel,
                FrameSink frames,
                const Clock& clock = systemClock(),
                DsaControllerOptions options = {});

  // Stops a stream left over, waits for silence, asks for everything. All throw DeviceError:
  // kSilent (no answer), kWrongDevice (a motion controller answers: ports swapped), kRefused (error
  // code, with its meaning), kProtocol, kUnsupported (firmware too old), kDisconnected.
  const DsaControllerInfo& open();
  const DsaControllerInfo& facts() const noexcept { return facts_; }

  // Push mode: frames come as fast as the controller scans; it doesn't honour a rate.
  void startStream();
  // Returns when the controller has said so; frames under way still reach the sink.
  void stopStream();
  // One stop, once, waiting so long at most; whether the controller answered. For leaving, and for
  // trying whether it still is there.
  bool stopStreamOnce(std::chrono::milliseconds limit);
  bool streaming() const noexcept { return streaming_; }
  // Pull mode: asks for one frame and waits for it (it goes to the sink).
  void pullFrame();
  // Reads what has come, waiting at most `timeout` for a first byte. Returns the bytes read.
  std::size_t poll(std::chrono::milliseconds timeout);
  // Tells the parser that the line has been silent (see DsaPacketParser::flush).
  void flush();

  // Setters pause the stream (stop, settle, set, start again) and read back what was set.
  // `persistent` writes the controller's memory, which lasts about 100,000 writes.
  // std::invalid_argument: value or matrix out of range, nothing was sent.
  void setSensitivity(std::size_t matrix, double sensitivity, bool persistent = false);
  void resetSensitivity(std::size_t matrix);  // to the factory's
  void setThreshold(std::size_t matrix, int counts, bool persistent = false);
  void setDynamicMask(std::size_t matrix, const Mask& mask);
  // Several settings within one pause: the setters called inside don't pause by themselves.
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
  // Sends until answered; checks the error word and the size (0: any from 2 up).
  Bytes request(DsaId id, const Bytes& payload, std::size_t answerBytes);
  // What has come already can't be the answer to what is asked next.
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
  DsaControllerInfo facts_;
  bool streaming_ = false;
  bool paused_ = false;
  std::uint64_t framesTaken_ = 0;
  std::uint64_t retries_ = 0;
  std::uint64_t strayAnswers_ = 0;
};

// What an error code of the tactile controller means ("index out of bounds").
std::string dsaErrorText(int code);

}  // namespace palpate
