// Thread of the tactile port in LiveHand: delivers frames and changes settings.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <palpate/device/dsa_controller.h>
#include <palpate/device/dsa_frame.h>
#include <palpate/model/hand_description.h>

#include "device/port_link.h"

namespace palpate {

constexpr double kTactileByteUs = 86.8;  // 10 bits at 115200 Bd

class TactileLink : public PortLink {
 public:
  TactileLink(
      const std::string& port, Open open, bool runLength, const HostTime& time, const Clock& clock);
  ~TactileLink() override;

  HandDescription hand() const;  // may be called from any thread
  std::optional<DsaControllerInfo> info() const;
  std::optional<Event> openGap(std::int64_t untilUs) const;  // see Device

 protected:
  void connect(ByteChannel& channel) override;
  void work() override;
  void disconnected() override;
  void ended() override;
  void forget() override;
  void closing() override;
  CommandAnswer execute(const DeviceCommand& command) override;

 private:
  // Settings made in this session; a controller that was switched off has lost them.
  struct Wanted {
    std::optional<double> sensitivity;
    std::optional<int> thresholdCounts;
    std::optional<Mask> dynamicMask;
  };

  void onPayload(std::span<const std::byte> payload);
  void checkStamp(TactileFrame&& frame, const DsaFrame& packet);
  void deliver(TactileFrame&& frame, std::int64_t deviceMs, std::size_t packetBytes);
  void watchSilence();
  void watchChecksums();
  // Number of missing frames; empty when it is unknown.
  struct Missing {
    std::optional<std::uint64_t> frames;
    bool estimated = true;
  };
  // A time without frames that has not ended.
  struct OpenGap {
    std::int64_t fromUs = 0;
    double periodMs = 0.0;  // as Session::periodMs
  };
  static Missing missingIn(const OpenGap& gap, std::int64_t nowUs, bool frameReceived);
  static Event gapEvent(std::int64_t fromUs, std::int64_t toUs, const Missing& missing);
  Missing missingSince(std::int64_t fromUs, std::int64_t nowUs, bool frameReceived) const {
    return missingIn({fromUs, session_.periodMs}, nowUs, frameReceived);
  }
  void beginGap(std::int64_t fromUs);
  void endGap(std::int64_t nowUs, const Missing& missing);
  void resetRateEstimate();
  void restoreSettings();
  std::string settingsJson() const;
  void applySetting(std::size_t matrix, const Wanted& wanted);
  void change(const Wanted& wanted, std::optional<int> matrix, const std::string& text);
  void learn();
  void countPackets();

  const bool runLength_;
  std::unique_ptr<DsaController> controller_;
  bool delivering_ = false;

  // Read by other threads, requires mutex_.
  HandDescription hand_;
  std::optional<DsaControllerInfo> known_;
  std::optional<OpenGap> openGap_;

  std::shared_ptr<const SensorLayout> layout_;
  std::map<std::size_t, Wanted> wanted_;

  struct Held {
    TactileFrame frame;
    DsaFrame packet;
  };
  // State of one session, from begin() to finish().
  struct Session {
    DsaClock deviceClock;
    DsaLossEstimate loss{kTactileByteUs};
    double periodMs = 0.0;  // usual time between two frames; 0: not known
    std::optional<Held> held;

    std::int64_t lastStampUs = 0;  // host time of the newest frame
    std::int64_t lastFrameUs = 0;  // its monotonic time, or that of the start of the stream
    std::optional<std::int64_t> gapFromUs;  // host time of the last frame before the silence
    int restarts = 0;                       // attempts to restart a silent controller

    DsaPacketStats before;  // sum over the controllers of earlier connections
    std::uint64_t retriesBefore = 0;
    std::uint64_t frames = 0;
    std::uint64_t suspect = 0;

    // Checksum counts of the last three seconds.
    std::int64_t windowFromUs = 0;
    std::uint64_t windowFrames = 0;
    std::uint64_t windowBad = 0;
    std::int64_t lastStreamRestartUs = 0;
    bool restartedForChecksums = false;
  };
  Session session_;
};

}  // namespace palpate
