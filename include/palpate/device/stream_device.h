// A stream of frames as a Device: text lines, JSON or packets from a serial port, a pty, TCP, UDP
// or standard input, of any hand whose description is known. docs/manual/stream_protocol.md
// specifies what is sent.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <palpate/core/option_check.h>
#include <palpate/core/time.h>
#include <palpate/device/byte_channel.h>
#include <palpate/device/device.h>
#include <palpate/device/stream_lines.h>

namespace palpate {

enum class StreamFormat {
  kAuto,    // whichever of the others is the first to give an item, anew for each connection
  kLines,   // lines of numbers
  kJson,    // JSON objects, one per line
  kBinary,  // packets
};
inline constexpr std::array<OptionWord<StreamFormat>, 4> kStreamFormatWords{
    {{"auto", StreamFormat::kAuto},
     {"lines", StreamFormat::kLines},
     {"json", StreamFormat::kJson},
     {"binary", StreamFormat::kBinary}}};

struct StreamDeviceOptions {
  // Where the stream comes from:
  //   a serial device, a /dev/serial/by-id name, a pty, or tcp:HOST:PORT, as openChannel() takes
  //     them;
  //   listen:[ADDRESS:]PORT  a TCP port of this machine, to which senders connect. One at a time is
  //     read; when it is silent for a second, the newest one of the others that sends;
  //   udp:[ADDRESS:]PORT     a UDP port of this machine;
  //   -                      standard input.
  // ADDRESS is numeric ("0.0.0.0", "[::1]"); without it only programs of this machine can send.
  // PORT 0 takes a free one, see StreamDevice::localPort().
  std::string source = {};
  // What is sent: layout, number of axes and temperature sensors, unit and full scale.
  HandDescription hand = {};
  StreamFormat format = StreamFormat::kAuto;
  StreamTime time = StreamTime::kAuto;  // of lines of numbers
  static constexpr OptionRange kBaud{50, 10'000'000, "baud"};
  int baud = 115'200;  // of a serial port
  // Which taxel each label of a line stands for (imports/label_places.h).
  PlacesOfLabels placesOfLabels = {};
  // Opens the source; empty means that `source` is opened. Tests pass their own channel. Called
  // from the port's thread.
  std::function<std::unique_ptr<ByteChannel>(const std::string& source)> open = {};
  // Throws std::invalid_argument naming the field.
  void validate() const;
};

// Host times of frames, angles and temperatures are their times of arrival, as with LiveHand; the
// device's time of a frame is kept beside it (TactileFrame::deviceUs).
//
// Lost frames are counted by the sender's sequence numbers. Without these they are estimated during
// a silence only, from the usual rate. Each loss and each silence is an event "gap"; the end of a
// connection that its sender closed is neither. PortStatus::suspect counts what was refused: lines,
// packets with implausible content, and frames that arrived late or twice. Values outside of the
// description of the hand are kept; PortStatus::outOfRange counts their frames.
class StreamDevice : public Device {
 public:
  // Opens nothing yet. The clock must outlive the device. Throws std::invalid_argument (options).
  explicit StreamDevice(StreamDeviceOptions options, const Clock& clock = systemClock());
  ~StreamDevice() override;
  StreamDevice(const StreamDevice&) = delete;
  StreamDevice& operator=(const StreamDevice&) = delete;

  HandDescription hand() const override;
  // Serial number and firmware as far as the sender described itself.
  DeviceInfo info() const override;
  void start(DeviceSink& sink) override;
  void stop() noexcept override;
  DeviceStatus status() const override;
  // A stream accepts no command: the future holds a DeviceError kUnsupported.
  std::future<CommandAnswer> submit(DeviceCommand command) override;

  // True when standard input has ended and everything was delivered.
  bool finished() const;
  // The TCP or UDP port at which senders are awaited; empty before it is open (soon after start()),
  // and for other sources.
  std::optional<std::uint16_t> localPort() const;
  // What is wrong with the last line or packet that was refused since start(): "line 812: 255
  // numbers instead of 256"; empty when none was.
  std::string lastFault() const;
  // The last value that was outside of the description of the hand: "line 9: value 2 is 5880, not
  // in 0..1023 counts"; empty when none was.
  std::string lastOutOfRange() const;
  // Lines for the user, each of which comes once since start(): what was guessed of the stream, and
  // what is odd about its senders.
  std::vector<std::string> remarks() const;
  std::optional<Event> openGap(std::int64_t untilUs) const override;
  // One line that says where senders are awaited, and from which machines; empty where localPort()
  // is.
  std::string notice() const;
  // True when other machines can send to the source, because an address was given.
  bool isOpenToOthers() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate
