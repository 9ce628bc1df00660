#include "palpate/device/series_source.h"

#include <stdexcept>
#include <thread>
#include <utility>

#include "palpate/core/number_text.h"
#include "palpate/device/stream_device.h"

#include "device/series_link.h"
#include "device/stream_source.h"

namespace palpate {
SeriesPlace seriesPlaceOf(std::string_view text) {
  constexpr std::string_view kSerial = "serial:";
  const bool isSerial = text.starts_with(kSerial);
  if (isSerial) text.remove_prefix(kSerial.size());
  SeriesPlace place{std::string(text)};
  const std::size_t at = text.rfind('@');
  if ((!isSerial && !text.starts_with('/')) || at == std::string_view::npos) return place;
  const auto baud = parseInteger(text.substr(at + 1));
  if (!baud) return place;
  OptionCheck{"series"}(StreamDeviceOptions::kBaud, "baud", static_cast<double>(*baud));
  place.source.resize(at);
  place.baud = static_cast<int>(*baud);
  return place;
}

void SeriesSourceOptions::validate() const {
  palpate::validate(SeriesDescription{name, "", {{"1", ""}}, ""});
  if (source.empty()) throw std::invalid_argument("series " + name + ": no source is named");
  OptionCheck{("series " + name).c_str()}(StreamDeviceOptions::kBaud, "baud", baud);
  if (!columns.empty()) requireColumns(columns);
  if (!open) StreamSource{source, baud};
}

struct SeriesSource::Impl {
  Impl(SeriesSourceOptions given, const Clock& clock)
      : options(std::move(given)),
        time(clock),
        source(options.open ? "test" : options.source, options.baud, clock),
        link(
            options,
            options.open ? options.open : [this](const std::string&) { return source.open(); },
            options.open ? nullptr : &source,
            time,
            clock) {}

  const SeriesSourceOptions options;
  HostTime time;
  StreamSource source;
  SeriesLink link;
  std::jthread thread;
};

SeriesSource::SeriesSource(SeriesSourceOptions options, const Clock& clock) {
  options.validate();
  impl_ = std::make_unique<Impl>(std::move(options), clock);
}

SeriesSource::~SeriesSource() { stop(); }

const std::string& SeriesSource::name() const noexcept { return impl_->options.name; }

SeriesDescription SeriesSource::description() const { return impl_->link.description(); }

void SeriesSource::start(DeviceSink& sink, std::size_t series) {
  if (impl_->thread.joinable())
    throw std::logic_error("SeriesSource::start: it was started already");
  SeriesLink& link = impl_->link;
  link.setSeries(series);
  link.begin(sink);
  impl_->thread = std::jthread([&link] {
    while (!link.stopping()) link.step();
    link.finish();
  });
}

void SeriesSource::requestStop() noexcept { impl_->link.requestStop(); }

void SeriesSource::stop() noexcept {
  requestStop();
  impl_->thread = {};
  impl_->source.close();
}

SeriesStatus SeriesSource::status() const {
  return {name(), impl_->link.status(), impl_->link.rateHz()};
}

std::optional<Event> SeriesSource::openGap(std::int64_t untilUs) const {
  return impl_->link.openGap(untilUs);
}

std::string SeriesSource::lastFault() const { return impl_->link.lastFault(); }

std::optional<std::uint16_t> SeriesSource::localPort() const { return impl_->source.localPort(); }

std::string SeriesSource::notice() const {
  const std::string place = impl_->source.placeText();
  if (place.empty()) return {};
  return "series " + name() + ": listening at " + place +
         (isOpenToOthers() ? ": any machine that reaches this address can send rows"
                           : ", for programs of this machine only");
}

bool SeriesSource::isOpenToOthers() const { return impl_->source.isOpenToOthers(); }

}  // namespace palpate
