// The thread of the tactile port: frames out, settings in.
#pragma once

#include <array>
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

class TactileLink : public PortLink {
 public:
  TactileLink(
      const std::string& port, Open open, bool runLength, const HostTime& time, const Clock& clock);
  ~TactileLink() override;

  HandDescription hand() const;  // any thread
  std::optional<DsaFacts> facts() const;

 protected:
  void connect(ByteChannel& channel) override;
  void work() override;
  void disconnected() override;
  void closing() override;
  CommandAnswer execute(const DeviceCommand& command) override;

 private:
  // What was set in this session: a controller that was switched off has forgotten it.
  struct Wanted {
    std::optional<double> sensitivity;
    std::optional<int> thresholdCounts;
    std::optional<Mask> dynamicMask;
  };

  void onPayload(std::span<const std::byte> payload);
  void judge(TactileFrame&& frame, const DsaFrame& packet);
  void deliver(TactileFrame&& frame, std::int64_t deviceMs, std::size_t packetBytes);
  void watchSilence();
  void watchChecksums();
  void endGap(std::int64_t nowUs);
  void restoreSettings();
  std::string settingsJson() const;
  void applySetting(std::size_t matrix, const Wanted& wanted);
  void change(const Wanted& wanted, std::optional<int> matrix, const std::string& text);
  void learn();
  void countPackets();
  void measureAge(std::int64_t hostUs, std::int64_t deviceMs);

  const bool runLength_;
  const double byteUs_;
  std::unique_ptr<DsaController> controller_;
  bool delivering_ = false;

  // Read from outside, under mutex_.
  HandDescription hand_;
  std::optional<DsaFacts> known_;

  std::shared_ptr<const SensorLayout> layout_;
  DsaClock deviceClock_;
  DsaLossEstimate loss_;
  struct Held {
    TactileFrame frame;
    DsaFrame packet;
  };
  std::optional<Held> held_;
  std::map<std::size_t, Wanted> wanted_;

  std::int64_t lastStampUs_ = 0;           // host time of the newest frame
  std::int64_t lastFrameUs_ = 0;           // monotonic time of it, or of the start of the stream
  std::optional<std::int64_t> gapFromUs_;  // host time of the last frame before the silence
  std::uint64_t lostInGap_ = 0;
  int restarts_ = 0;  // attempts to wake a silent controller

  DsaPacketStats before_;  // of controllers of earlier connections
  std::uint64_t retriesBefore_ = 0;
  std::uint64_t frames_ = 0;
  std::uint64_t suspect_ = 0;

  // Checksums of the last three seconds.
  std::int64_t windowFromUs_ = 0;
  std::uint64_t windowFrames_ = 0;
  std::uint64_t windowBad_ = 0;
  std::int64_t lastCureUs_ = 0;
  bool restartedForChecksums_ = false;

  // Least (host - device) of this and the last half minute: what a frame takes when nothing delays it.
  std::array<std::optional<std::int64_t>, 2> leastOffsetUs_;
  std::int64_t offsetWindowUs_ = 0;
};

}  // namespace palpate
