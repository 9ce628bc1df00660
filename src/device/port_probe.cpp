#include "palpate/device/port_probe.h"

#include <algorithm>
#include <exception>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "palpate/core/byte_reader.h"
#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/core/time.h"
#include "palpate/device/dsa_controller.h"
#include "palpate/device/dsa_packet.h"
#include "palpate/device/sdh_reply_parser.h"

namespace palpate {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPortProbeSlice{20};
// Used twice, because the first `ver` may only end an incomplete command of another program.
constexpr milliseconds kVersionWait{500};
constexpr milliseconds kSerialWait{300};
constexpr milliseconds kStopWait{300};
constexpr milliseconds kQueryWait{500};
// Sent by a tactile controller while it boots, for 8 s.
constexpr std::string_view kBootSign = "\x1B[5n";

class Prober {
 public:
  Prober(ByteChannel& channel, const PortProbeOptions& options, const Clock& clock)
      : channel_(channel), options_(options), clock_(clock), replies_(!channel.isNetwork()) {}

  PortProbe run() {
    if (!requestMotion() && !stopped()) requestTactile();
    return conclusion();
  }

 private:
  bool stopped() const { return options_.isCancelled && options_.isCancelled(); }

  void send(std::string_view text) {
    channel_.write(std::as_bytes(std::span<const char>(text.data(), text.size())));
  }

  // Reads until `done` returns true, at most for `limit`.
  void listen(milliseconds limit, const std::function<bool()>& done) {
    const std::int64_t endUs = clock_.monotonicUs() + usOf(limit);
    std::vector<std::byte> buffer(1024);
    while (!done() && !stopped()) {
      const std::int64_t leftUs = endUs - clock_.monotonicUs();
      if (leftUs <= 0) return;
      const std::size_t count =
          channel_.read(buffer, std::min(kPortProbeSlice, milliseconds(leftUs / 1000 + 1)));
      take(std::span<const std::byte>(buffer).first(count));
    }
  }

  void take(std::span<const std::byte> bytes) {
    bytes_ += bytes.size();
    recent_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    boots_ = boots_ || recent_.find(kBootSign) != std::string::npos;
    if (recent_.size() > kBootSign.size()) recent_.erase(0, recent_.size() - kBootSign.size());
    replies_.push(bytes, [this](SdhReply&& reply) {
      const auto* line = std::get_if<SdhLine>(&reply);
      if (!line || line->kind != SdhLine::Kind::kValue) return;
      if (line->name == "VER") version_ = line->text;
      if (line->name == "SN") serial_ = line->text;
    });
    packets_.push(bytes, [this](const DsaPacket& packet) {
      ++tactilePackets_;
      if (packet.id == DsaId::kAcquisition) acknowledged_ = true;
      constexpr std::size_t kConfigurationBytes = 18;
      if (packet.id != DsaId::kControllerConfiguration ||
          packet.payload.size() != kConfigurationBytes)
        return;
      ByteReader reader(packet.payload);
      if (reader.u16() != 0) return;
      DsaControllerInfo facts;
      facts.serial = reader.u32();
      reader.u8();
      facts.firmwareVersion = reader.u16();
      tactile_ = facts;
    });
  }

  // True when this is a motion controller.
  bool requestMotion() {
    for (int tries = 0; tries < 2 && !version_ && tactilePackets_ == 0 && !stopped(); ++tries) {
      send(" \r\nver\r\n");
      // When packets of a streaming tactile controller arrive, there is no need to wait for the
      // other one.
      listen(kVersionWait, [this] { return version_.has_value() || tactilePackets_ > 0; });
    }
    if (!version_) return false;
    send("sn\r\n");
    listen(kSerialWait, [this] { return serial_.has_value(); });
    return true;
  }

  void requestTactile() {
    channel_.write(dsaRequest(DsaId::kAcquisition, kStop));
    listen(kStopWait, [this] { return acknowledged_; });
    for (int tries = 0; tries < 2 && !tactile_ && !stopped(); ++tries) {
      packets_.flush([](const DsaPacket&) {});
      channel_.write(dsaRequest(DsaId::kControllerConfiguration));
      listen(kQueryWait, [this] { return tactile_.has_value(); });
    }
  }

  PortProbe conclusion() const {
    PortProbe probe;
    if (version_) {
      probe.answer = PortAnswer::kMotion;
      probe.firmware = *version_;
      probe.serial = serial_.value_or("");
      probe.message = "motion controller, firmware " + probe.firmware +
                      (probe.serial.empty() ? "" : ", serial " + probe.serial);
    } else if (tactile_) {
      probe.answer = PortAnswer::kTactile;
      probe.firmware = tactile_->firmwareText();
      probe.serial = hexDigits(tactile_->serial, 8);
      probe.message = "tactile controller, firmware " + probe.firmware + ", serial " + probe.serial;
    } else if (tactilePackets_ > 0) {
      probe.answer = PortAnswer::kTactile;
      probe.message = "tactile controller that doesn't report its type; switch it off and on";
    } else if (boots_) {
      probe.answer = PortAnswer::kTactile;
      probe.message = "tactile controller that is starting; check again in 10 s";
    } else if (bytes_ > 0) {
      probe.answer = PortAnswer::kUnknownDevice;
      probe.message = "something else: " + std::to_string(bytes_) +
                      " bytes that no hand sends; check the speed of the line";
    } else {
      probe.message = "nothing answers; is the hand switched on and the cable right?";
    }
    return probe;
  }

  // Acquisition off, as in the protocol document: AA AA AA 03 03 00 01 00 00 2F 6A.
  static constexpr std::byte kStop[] = {std::byte{1}, std::byte{0}, std::byte{0}};

  ByteChannel& channel_;
  const PortProbeOptions& options_;
  const Clock& clock_;
  SdhReplyParser replies_;
  DsaPacketParser packets_;
  std::optional<std::string> version_;
  std::optional<std::string> serial_;
  std::optional<DsaControllerInfo> tactile_;
  std::size_t tactilePackets_ = 0;
  std::size_t bytes_ = 0;
  std::string recent_;  // the last bytes received
  bool boots_ = false;
  bool acknowledged_ = false;
};

PortAnswer answerOf(DeviceFault fault) {
  switch (fault) {
    case DeviceFault::kBusy:
      return PortAnswer::kBusy;
    case DeviceFault::kNoPermission:
      return PortAnswer::kNoPermission;
    case DeviceFault::kDisconnected:
      return PortAnswer::kDisconnected;
    case DeviceFault::kSilent:
      return PortAnswer::kNothing;
    default:
      return PortAnswer::kNotFound;
  }
}

}  // namespace

std::string PortProbe::answerName() const {
  switch (answer) {
    case PortAnswer::kNothing:
      return "nothing";
    case PortAnswer::kMotion:
      return "motion";
    case PortAnswer::kTactile:
      return "tactile";
    case PortAnswer::kUnknownDevice:
      return "something";
    case PortAnswer::kBusy:
      return "busy";
    case PortAnswer::kNoPermission:
      return "no_permission";
    case PortAnswer::kNotFound:
      return "not_found";
    case PortAnswer::kDisconnected:
      return "gone";
  }
  return "";
}

PortProbe probePort(const std::string& port, const PortProbeOptions& options, const Clock& clock) {
  PortProbe probe;
  try {
    const auto channel = options.open ? options.open(port) : openChannel(port);
    probe = Prober(*channel, options, clock).run();
  } catch (const DeviceError& error) {
    probe.answer = answerOf(error.fault());
    const std::string text = error.what();
    const std::string prefix = port + ": ";  // the port's name is shown in a column of its own
    probe.message = text.starts_with(prefix) ? text.substr(prefix.size()) : text;
  } catch (const Error& error) {
    probe.answer = PortAnswer::kNotFound;
    probe.message = error.what();
  } catch (const std::exception& failure) {
    probe.answer = PortAnswer::kNotFound;
    probe.message = std::string("the program failed while it asked: ") + failure.what();
  } catch (...) {
    probe.answer = PortAnswer::kNotFound;
    probe.message = "the program failed while it asked: an unknown exception";
  }
  probe.port = port;
  return probe;
}

std::string describeSwap(const PortProbe& tactilePort, const PortProbe& motionPort) {
  const bool motionAtTactile = tactilePort.answer == PortAnswer::kMotion;
  const bool tactileAtMotion = motionPort.answer == PortAnswer::kTactile;
  if (motionAtTactile && tactileAtMotion)
    return "the ports are swapped: " + tactilePort.port + " is the motion controller, " +
           motionPort.port + " the tactile controller; exchange the two names";
  if (motionAtTactile)
    return tactilePort.port +
           " was named as the tactile port, but the motion controller answers there; 'palpate "
           "ports' lists the device at each port";
  if (tactileAtMotion)
    return motionPort.port +
           " was named as the motion port, but the tactile controller answers there; 'palpate "
           "ports' lists the device at each port";
  return {};
}

}  // namespace palpate
