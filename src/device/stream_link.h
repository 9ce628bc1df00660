// Thread of a StreamDevice: reads lines or packets, delivers frames, counts losses, notices
// silence.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <palpate/device/stream_device.h>
#include <palpate/device/stream_lines.h>
#include <palpate/device/stream_packets.h>
#include <palpate/model/hand_description.h>

#include "device/frame_numbers.h"
#include "device/port_link.h"
#include "device/stream_clock.h"

namespace palpate {

class StreamSource;

struct StreamLinkOptions {
  bool startsInside = false;  // see StreamLineOptions
  // True for standard input: its frames may arrive faster than they were measured.
  bool isInput = false;
  // Knows who sends; null in tests that open a channel of their own.
  StreamSource* source = nullptr;
};

class StreamLink : public PortLink {
 public:
  StreamLink(const StreamDeviceOptions& device,
             Open open,
             const StreamLinkOptions& options,
             const HostTime& time,
             const Clock& clock);

  // May be called from any thread.
  StreamDescription description() const;
  std::string lastFault() const;
  std::string lastOutOfRange() const;
  std::vector<std::string> remarks() const;
  std::optional<Event> openGap(std::int64_t untilUs) const;

 protected:
  void connect(ByteChannel& channel) override;
  void work() override;
  void disconnected() override;
  void ended() override;
  void forget() override;
  void closing() override {}
  CommandAnswer execute(const DeviceCommand&) override { return {}; }

 private:
  // Counts over all connections of a session.
  struct Counts {
    std::uint64_t badChecksums = 0;
    std::uint64_t refused = 0;
    std::uint64_t outOfRange = 0;
    std::uint64_t skippedBytes = 0;
  };
  // A time without frames that has not ended.
  struct Gap {
    std::int64_t fromUs = 0;
    double periodUs = 0.0;
    std::optional<std::int64_t> closedUs;  // when the sender closed its connection
  };

  void parse(std::span<const std::byte> bytes, bool isDatagram);
  void endOfBytes();
  void take(const StreamItem& item);
  void takeFrame(const StreamItem& item);
  void takeDescription(std::string_view text);
  // How its number follows that of the frame before; reports another numbering.
  FrameNumbers::Step stepOf(const StreamItem& item, std::int64_t monotonicUs);
  std::optional<std::int64_t> deviceTime(const StreamItem& item, std::int64_t monotonicUs);
  void measureRate(std::int64_t monotonicUs);
  void beginGap(bool isEnd);
  void beginGapOfConnection();
  void publishGap();
  void endGap(std::int64_t nowUs, std::optional<std::uint64_t> missing, bool frameReceived);
  void noteLoss(std::int64_t fromUs, std::int64_t toUs, std::uint64_t missing);
  void reportLoss(bool atOnce);
  Counts countsOfConnection() const;
  std::string faultOfConnection() const;
  void updateCounts();
  void watchFaults();
  void watchOutOfRange(const Counts& counts);
  void showFault(const std::string& text,
                 std::uint64_t more,
                 std::optional<std::int64_t>& reportedUs);
  void watchRemarks();
  void endPile(std::size_t got);
  void remark(const std::string& text, const std::string& kind = "link");
  void watchSilence();
  std::string whySilent(std::int64_t monotonicUs) const;

  const HandDescription hand_;
  const StreamFormat format_;
  const StreamLineOptions lineOptions_;
  const StreamLinkOptions options_;
  const StreamShape shape_;
  std::vector<std::byte> buffer_;
  ByteChannel* channel_ = nullptr;

  // Of this connection; null when the form is not read, or another one was found.
  std::unique_ptr<StreamLineParser> lines_;
  std::unique_ptr<StreamLineParser> earlierLines_;  // of the connection before
  std::unique_ptr<StreamPacketParser> packets_;
  bool formatFound_ = false;

  // Read by other threads, requires mutex_.
  StreamDescription description_;
  std::string lastFault_;
  std::string lastOutOfRange_;
  std::vector<std::string> remarks_;
  std::optional<Gap> openGap_;

  // State of one session, from begin() to finish().
  struct Session {
    StreamClock clock;
    bool speedReported = false;
    FrameNumbers numbers;
    std::optional<std::int64_t> renumberedUs;  // monotonic time of the last other numbering
    double periodUs = 0.0;                     // usual time between two frames; 0: not known
    std::uint64_t bytes = 0;
    std::uint64_t frames = 0;
    // Items that the parsers accepted and this link refused.
    std::uint64_t refused = 0;
    std::string refusedWhy;
    Counts before;  // of earlier connections

    std::int64_t lastStampUs = 0;  // host times of the newest items
    std::int64_t lastAnglesUs = 0;
    std::int64_t lastTemperaturesUs = 0;
    std::int64_t lastFrameUs = 0;  // monotonic time of the newest frame, or of the connection
    std::int64_t connectedUs = 0;  // host time of the connection
    bool frameSinceConnect = false;
    bool silent = false;
    std::optional<std::int64_t> gapFromUs;  // host time of the last frame before the silence
    bool gapIsEnd = false;                  // it began when the sender closed its connection
    std::optional<std::int64_t> closedUs;   // host time when the sender closed its connection
    // Missing frames that no event tells of yet.
    std::uint64_t lossFrames = 0;
    std::int64_t lossFromUs = 0;
    std::int64_t lossToUs = 0;
    std::optional<std::int64_t> lossReportedUs;  // monotonic
    // Frames that waited in a connection until it was read.
    bool readsPile = false;
    std::uint64_t framesBeforePile = 0;
    bool guessReported = false;
    std::size_t notesReported = 0;  // of this connection

    std::uint64_t reportedRefused = 0;
    std::uint64_t reportedOutOfRange = 0;
    std::optional<std::int64_t> outOfRangeUs;     // monotonic time of the last alarm about values
    std::optional<std::int64_t> clockReportedUs;  // monotonic time of the last jump of the clock
    std::int64_t faultUs = 0;                     // monotonic time of the last fault
    std::optional<std::int64_t> alarmUs;          // monotonic time of the last alarm about faults
  };
  Session session_;
};

}  // namespace palpate
