#include "palpate/device/stream_device.h"

#include <stdexcept>
#include <thread>

#include "palpate/core/error.h"

#include "device/stream_link.h"
#include "device/stream_source.h"

namespace palpate {

void StreamDeviceOptions::validate() const {
  if (source.empty()) throw std::invalid_argument("StreamDeviceOptions: no source is named");
  OptionCheck{"StreamDeviceOptions"}(kBaud, "baud", baud);
  StreamShape{hand};
  if (!open) StreamSource{source, baud};
}

struct StreamDevice::Impl {
  Impl(const StreamDeviceOptions& given, const Clock& clock)
      : options(given),
        time(clock),
        source(options.open ? "test" : options.source, options.baud, clock),
        link(
            options,
            options.open ? options.open : [this](const std::string&) { return source.open(); },
            {.startsInside = !options.open && source.startsInside(),
             .isInput = source.isInput(),
             .source = &source},
            time,
            clock) {}

  const StreamDeviceOptions options;
  HostTime time;
  StreamSource source;
  StreamLink link;
  std::jthread thread;
};

StreamDevice::StreamDevice(StreamDeviceOptions options, const Clock& clock) {
  options.validate();
  impl_ = std::make_unique<Impl>(options, clock);
}

StreamDevice::~StreamDevice() { stop(); }

HandDescription StreamDevice::hand() const { return impl_->options.hand; }

DeviceInfo StreamDevice::info() const {
  const StreamDescription described = impl_->link.description();
  DeviceInfo info;
  info.serial = described.serial;
  info.firmware = described.firmware;
  return info;
}

void StreamDevice::start(DeviceSink& sink) {
  if (impl_->thread.joinable())
    throw std::logic_error("StreamDevice::start: it was started already");
  StreamLink& link = impl_->link;
  link.begin(sink);
  impl_->thread = std::jthread([&link] {
    while (!link.stopping()) link.step();
    link.finish();
  });
}

void StreamDevice::stop() noexcept {
  impl_->link.requestStop();
  impl_->thread = {};
  impl_->source.close();
}

DeviceStatus StreamDevice::status() const {
  DeviceStatus status;
  status.tactile = impl_->link.status();
  return status;
}

std::future<CommandAnswer> StreamDevice::submit(DeviceCommand) {
  std::promise<CommandAnswer> nobody;
  nobody.set_exception(std::make_exception_ptr(
      DeviceError(DeviceFault::kUnsupported,
                  impl_->options.source,
                  "a stream only sends: it can't be moved or set from here")));
  return nobody.get_future();
}

bool StreamDevice::finished() const { return impl_->source.ended(); }

std::optional<std::uint16_t> StreamDevice::localPort() const { return impl_->source.localPort(); }

std::string StreamDevice::lastFault() const { return impl_->link.lastFault(); }

std::string StreamDevice::lastOutOfRange() const { return impl_->link.lastOutOfRange(); }

std::vector<std::string> StreamDevice::remarks() const { return impl_->link.remarks(); }

std::optional<Event> StreamDevice::openGap(std::int64_t untilUs) const {
  return impl_->link.openGap(untilUs);
}

std::string StreamDevice::notice() const {
  const std::string place = impl_->source.placeText();
  if (place.empty()) return {};
  return "listening at " + place +
         (impl_->source.isOpenToOthers() ? ": any machine that reaches this address can send frames"
                                         : ", for programs of this machine only");
}

bool StreamDevice::isOpenToOthers() const { return impl_->source.isOpenToOthers(); }

}  // namespace palpate
