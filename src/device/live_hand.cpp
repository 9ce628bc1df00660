#include "palpate/device/live_hand.h"

#include <stdexcept>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "palpate/core/error.h"
#include "palpate/core/escaped_line.h"
#include "palpate/core/number_text.h"
#include "palpate/device/port_list.h"
#include "palpate/device/sdh2.h"

#include "device/motion_link.h"
#include "device/tactile_link.h"

namespace palpate {
namespace {

void requireRange(const char* field, double value, double least, double most) {
  if (!(value >= least && value <= most))
    throw std::invalid_argument(std::string("LiveHandOptions: ") + field + " " + numberText(value) +
                                " is not in " + numberText(least) + ".." + numberText(most));
}

}  // namespace

void LiveHandOptions::validate() const {
  requireRange("angleHz", angleHz, 1.0, 250.0);
  requireRange("temperatureHz", temperatureHz, 0.1, 10.0);
  if (dsaPort.empty() && sdhPort.empty())
    throw std::invalid_argument("LiveHandOptions: neither a tactile nor a motion port is named");
  if (dsaPort == sdhPort)
    throw std::invalid_argument("LiveHandOptions: both ports are '" + shortened(dsaPort) + "'");
}

struct LiveHand::Impl {
  Impl(const LiveHandOptions& options, const Clock& clock) : time(clock) {
    // A replugged port may get another number, but its name under /dev/serial/by-id stays the same.
    PortLink::Open open = options.open;
    if (!open)
      open = [stable = std::string()](const std::string& port) mutable {
        std::unique_ptr<ByteChannel> channel = openChannel(stable.empty() ? port : stable);
        if (stable.empty()) stable = stableNameOf(port);
        return channel;
      };
    if (!options.dsaPort.empty())
      tactile =
          std::make_unique<TactileLink>(options.dsaPort, open, options.runLength, time, clock);
    if (!options.sdhPort.empty())
      motion = std::make_unique<MotionLink>(
          options.sdhPort, open, options.angleHz, options.temperatureHz, time, clock);
  }

  std::vector<PortLink*> links() const {
    std::vector<PortLink*> all;
    if (tactile) all.push_back(tactile.get());
    if (motion) all.push_back(motion.get());
    return all;
  }

  HostTime time;
  std::unique_ptr<TactileLink> tactile;
  std::unique_ptr<MotionLink> motion;
  std::vector<std::jthread> threads;
};

LiveHand::LiveHand(LiveHandOptions options, const Clock& clock) {
  options.validate();
  impl_ = std::make_unique<Impl>(options, clock);
}

LiveHand::~LiveHand() { stop(); }

HandDescription LiveHand::hand() const { return impl_->tactile ? impl_->tactile->hand() : sdh2(); }

DeviceInfo LiveHand::info() const {
  DeviceInfo info;
  if (impl_->tactile) {
    if (const auto known = impl_->tactile->info()) {
      info.serial = hexDigits(known->serial, 8);
      info.firmware = known->firmwareText();
      for (const DsaMatrixInfo& matrix : known->matrices)
        info.matrices.push_back({matrix.sensitivity, matrix.thresholdCounts.value_or(0)});
      info.sensorSerial = hexDigits(known->sensorSerial, 8);
      info.sensorRevision = known->generatedBy;
      info.sensorHardwareRevision = known->sensorHardwareRevision;
    }
  }
  if (impl_->motion) {
    if (const auto known = impl_->motion->info()) info.motionFirmware = known->firmware;
  }
  return info;
}

void LiveHand::start(DeviceSink& sink) {
  if (!impl_->threads.empty()) throw std::logic_error("LiveHand::start: it was started already");
  try {
    for (PortLink* link : impl_->links()) {
      link->begin(sink);
      impl_->threads.emplace_back([link] {
        while (!link->stopping()) link->step();
        link->finish();
      });
    }
  } catch (...) {
    stop();  // the second thread could not be created: end the first one, too
    throw;
  }
}

void LiveHand::stop() noexcept {
  for (PortLink* link : impl_->links()) link->requestStop();
  impl_->threads.clear();
}

DeviceStatus LiveHand::status() const {
  DeviceStatus status;
  if (impl_->tactile) status.tactile = impl_->tactile->status();
  if (impl_->motion) status.motion = impl_->motion->status();
  return status;
}

std::future<CommandAnswer> LiveHand::submit(DeviceCommand command) {
  const bool tactile = std::holds_alternative<SetThreshold>(command) ||
                       std::holds_alternative<SetSensitivity>(command) ||
                       std::holds_alternative<SetDynamicMask>(command);
  if (tactile && impl_->tactile) return impl_->tactile->submit(std::move(command));
  if (!tactile && impl_->motion) return impl_->motion->submit(std::move(command));
  std::promise<CommandAnswer> nobody;
  nobody.set_exception(std::make_exception_ptr(
      DeviceError(DeviceFault::kUnsupported,
                  "the hand",
                  tactile ? "no tactile port was named" : "no motion port was named")));
  return nobody.get_future();
}

std::optional<Event> LiveHand::openGap(std::int64_t untilUs) const {
  return impl_->tactile ? impl_->tactile->openGap(untilUs) : std::nullopt;
}

std::vector<int> LiveHand::axisStates() const {
  return impl_->motion ? impl_->motion->axisStates() : std::vector<int>{};
}

}  // namespace palpate
