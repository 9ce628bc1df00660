// Rows of numbers beside the hand, a further series: what a load cell, a wrist or an IMU sends as
// lines of text over a serial port, a pty, TCP, UDP or standard input.
// docs/manual/stream_protocol.md specifies what is sent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <palpate/core/time.h>
#include <palpate/device/byte_channel.h>
#include <palpate/device/device.h>
#include <palpate/model/series.h>

namespace palpate {

struct SeriesSourceOptions {
  std::string name;    // of the series, as in SeriesDescription
  std::string source;  // as StreamDeviceOptions::source
  // What each number of a row is, a column of time included; of JSON objects those that are taken.
  // Empty: a header line or the names in the objects say it, else they are "1", "2", ..
  std::vector<Column> columns = {};
  int baud = 115'200;  // of a serial port, 50..10,000,000 [baud]
  // As StreamDeviceOptions::open.
  std::function<std::unique_ptr<ByteChannel>(const std::string& source)> open = {};
  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// The port and the baud rate of "serial:/dev/ttyUSB0@921600", with or without "serial:" and "@BAUD"
// (115200); another source as it is. Throws std::invalid_argument (a baud rate out of range).
struct SeriesPlace {
  std::string source;
  int baud = 115'200;
};
SeriesPlace seriesPlaceOf(std::string_view text);

// The columns of "fx[N],fy (N),mode". Throws std::invalid_argument (as validate() of a series).
std::vector<Column> columnsOf(std::string_view text);

struct SeriesStatus {
  std::string name;
  // Items are rows; `suspect` counts the rows that were refused.
  PortStatus port;
  double rateHz = 0.0;  // usual rate; 0: not known, or no rows come
};

// Host times are times of arrival, strictly ascending; the sender's clock is kept beside them
// (Sample::deviceUs). A silence, and a time without connection, is an event "gap" whose JSON has
// "stream", the name of the series, beside what it has for frames. Rows are read at 10,000 per
// second at most; more waits at the sender, or is lost there.
class SeriesSource {
 public:
  // Opens nothing yet. The clock must outlive the source. Throws std::invalid_argument (options).
  explicit SeriesSource(SeriesSourceOptions options, const Clock& clock = systemClock());
  ~SeriesSource();  // stops
  SeriesSource(const SeriesSource&) = delete;
  SeriesSource& operator=(const SeriesSource&) = delete;

  const std::string& name() const noexcept;
  // Without columns until they are known, at the first row at the latest. From then on they stay
  // as they are until stop().
  SeriesDescription description() const;
  // Delivers samples of this series, and events, to `sink`, which must stay valid until stop()
  // returns. A source that can't be opened is looked for until then. Throws std::logic_error when
  // already started.
  void start(DeviceSink& sink, std::size_t series);
  // Asks for the end, and does not wait for it.
  void requestStop() noexcept;
  // Ends delivery within 2 s.
  void stop() noexcept;

  // These may be called from any thread.
  SeriesStatus status() const;
  // As Device::openGap().
  std::optional<Event> openGap(std::int64_t untilUs) const;
  // What is wrong with the last row that was refused since start(); empty when none was.
  std::string lastFault() const;
  // As of a StreamDevice.
  std::optional<std::uint16_t> localPort() const;
  std::string notice() const;
  bool isOpenToOthers() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
