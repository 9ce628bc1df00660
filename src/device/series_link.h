// Thread of a SeriesSource: reads lines, delivers samples, notices silence.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "palpate/device/series_source.h"

#include "device/port_link.h"
#include "device/series_lines.h"
#include "device/stream_clock.h"

namespace palpate {

class StreamSource;

class SeriesLink : public PortLink {
 public:
  // `source` knows who sends; null in tests that open a channel of their own.
  SeriesLink(const SeriesSourceOptions& options,
             Open open,
             StreamSource* source,
             const HostTime& time,
             const Clock& clock);

  // The index of the samples; before begin().
  void setSeries(std::size_t series) noexcept { series_ = series; }
  // May be called from any thread.
  SeriesDescription description() const;
  double rateHz() const;
  std::string lastFault() const;
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
  // A time without rows that has not ended.
  struct Gap {
    std::int64_t fromUs = 0;
    double periodUs = 0.0;
    bool isEnd = false;  // the sender closed its connection in order: nothing is missing
  };
  void take(const SeriesRow& row);
  std::optional<std::int64_t> deviceTime(std::optional<std::int64_t> deviceUs, std::int64_t nowUs);
  void measureRate(std::int64_t nowUs);
  void watchFaults();
  void watchSilence();
  void beginGap(bool isEnd);
  void endGap(std::int64_t toUs, bool rowReceived);
  Event gapEventOf(const Gap& gap, std::int64_t toUs, std::optional<std::uint64_t> missing) const;

  const std::vector<Column> given_;
  StreamSource* const source_;
  std::size_t series_ = kHandSeries;
  SeriesLines lines_;
  std::vector<std::byte> buffer_;
  ByteChannel* channel_ = nullptr;

  // Read by other threads, requires mutex_.
  SeriesDescription description_;
  std::string lastFault_;
  std::optional<Gap> gap_;  // only this thread writes it
  double periodUs_ = 0.0;   // mean; 0: not known

  // Since start().
  struct Session {
    std::uint64_t rows = 0;
    std::uint64_t bytes = 0;
    StreamClock clock;
    std::int64_t lastStampUs = 0;
    std::int64_t lastRowUs = 0;  // monotonic, or when it was connected
    std::int64_t connectedUs = 0;
    bool rowSinceConnect = false;
    bool silent = false;
    double longestUs = 0.0;   // of the usual intervals
    std::int64_t paidUs = 0;  // monotonic time up to which rows were read at the highest rate
    std::uint64_t reportedRefused = 0;
    std::int64_t faultUs = 0;                     // monotonic time of the last fault
    std::optional<std::int64_t> alarmUs;          // of the last alarm about faults
    std::optional<std::int64_t> clockReportedUs;  // of the last jump of the clock
  };
  Session session_;
};

}  // namespace palpate
