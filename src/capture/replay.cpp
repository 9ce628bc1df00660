#include "palpate/capture/replay.h"

#include <algorithm>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "palpate/core/error.h"
#include "palpate/core/number_text.h"
#include "palpate/model/in_time_order.h"

namespace palpate {
namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
constexpr double kSlowest = 0.1;
constexpr double kFastest = 16.0;

void requireSpeed(double factor) {
  if (!(factor >= kSlowest && factor <= kFastest))
    throw std::invalid_argument("Replay: speed must be 0.1..16, is " + std::to_string(factor));
}

}  // namespace

struct Replay::Impl {
  Impl(Profile recorded,
       const ReplayOptions& given,
       std::vector<Event> noted,
       const Clock& theClock)
      : profile(std::move(recorded)),
        pace(given.pace),
        events(std::move(noted)),
        clock(theClock),
        speed(given.speed) {
    std::stable_sort(
        events.begin(), events.end(), [](const auto& a, const auto& b) { return a.tUs < b.tUs; });
  }

  void rewind() {
    order.emplace(profile, events, [this](InTimeOrder::Kind kind, const std::string& fault) {
      countUnreadable(kind == InTimeOrder::Kind::kFrame, fault);
    });
    warned = false;
    untold.clear();
    const std::lock_guard lock(mutex);
    status = {};
    status.tactile.port = "replay";
    status.tactile.state = PortState::kStreaming;
    if (profile.numAngles() + profile.numTemperatures() > 0) status.motion = status.tactile;
    ended = false;
  }

  // Stamp of the next item; kNever at the end.
  std::int64_t nextUs() {
    const auto item = order->next();
    return item ? item->timeUs : kNever;
  }

  // Counts a sample that can't be read; the first one is to be reported.
  void countUnreadable(bool tactile, const std::string& fault) {
    if (!std::exchange(warned, true)) untold = fault;
    const std::lock_guard lock(mutex);
    PortStatus& port = tactile || !status.motion ? status.tactile : *status.motion;
    ++port.lost;
    port.message = fault;
  }

  void tellUnreadable(std::int64_t atUs) {
    if (!untold.empty()) sink->onEvent({atUs, atUs, "alarm", {}, std::exchange(untold, {}), ""});
  }

  void deliver(const InTimeOrder::Item& item) {
    if (item.kind == InTimeOrder::Kind::kEvent) return sink->onEvent(Event(events[item.index]));
    const bool tactile = item.kind == InTimeOrder::Kind::kFrame;
    try {
      if (tactile)
        sink->onFrame(profile.frame(item.index));
      else
        sink->onSample(profile.sample(item.series, item.index));
    } catch (const Error& error) {
      countUnreadable(tactile, error.what());
      return tellUnreadable(item.timeUs);
    }
    if (!tactile && item.series >= kHandSeries) return;  // of no port of the hand
    const std::lock_guard lock(mutex);
    PortStatus& port = tactile || !status.motion ? status.tactile : *status.motion;
    ++port.items;
    port.lastItemUs = item.timeUs;
  }

  // No exception in the delivering thread may end the process: it ends the replay instead.
  void runGuarded(const std::stop_token& stop) noexcept {
    std::string fault;
    try {
      return run(stop);
    } catch (const std::exception& error) {
      fault = std::string("the replay has ended: ") + error.what();
    } catch (...) {
      fault = "the replay has ended: an unknown exception";
    }
    try {
      sink->onEvent({lastUs, lastUs, "alarm", {}, fault, ""});
    } catch (...) {
      // The sink itself failed: status() reports it.
    }
    const std::lock_guard lock(mutex);
    ended = true;
    status.tactile.state = PortState::kFault;
    status.tactile.message = fault;
    if (status.motion) status.motion->state = PortState::kFault;
  }

  void end() {
    {
      const std::lock_guard lock(mutex);
      const auto silence = [](PortStatus& port) {
        port.state = PortState::kSilent;
        if (port.message.empty()) port.message = "the recording has ended";
      };
      silence(status.tactile);
      if (status.motion) silence(*status.motion);
    }
    sink->onEvent({lastUs, lastUs, "link", {}, "the recording has ended", ""});
    const std::lock_guard lock(mutex);
    ended = true;  // after the last item: whoever sees it may read everything delivered
  }

  // Delivers all items up to and including `untilUs`; returns false at the end.
  bool deliverUntil(std::int64_t untilUs, const std::stop_token& stop) {
    for (std::int64_t at = nextUs(); at <= untilUs && !stop.stop_requested(); at = nextUs()) {
      tellUnreadable(at == kNever ? lastUs : at);
      if (at == kNever) {
        end();
        return false;
      }
      deliver(*order->take());
      lastUs = at;
    }
    return true;
  }

  void run(const std::stop_token& stop) {
    if (pace == ReplayPace::kUnpaced) {
      deliverUntil(kNever, stop);
      return;
    }
    double positionUs = 0.0;  // in the recording's time
    std::int64_t monoUs = clock.monotonicUs();
    while (!stop.stop_requested()) {
      const double factor = speedNow();
      const std::int64_t nowUs = clock.monotonicUs();
      positionUs += static_cast<double>(nowUs - monoUs) * factor;
      monoUs = nowUs;
      const bool empty = nextUs() == kNever;
      if (!deliverUntil(empty ? kNever : firstUs + static_cast<std::int64_t>(positionUs), stop))
        return;
      // The end is handled at once, not after kNever.
      if (nextUs() == kNever) {
        deliverUntil(kNever, stop);
        return;
      }
      const double waitUs = (static_cast<double>(nextUs() - firstUs) - positionUs) / factor;
      std::unique_lock lock(mutex);
      moved.wait_for(
          lock, stop, std::chrono::microseconds(static_cast<std::int64_t>(waitUs) + 1), [&] {
            return speed != factor;
          });
    }
  }

  double speedNow() const {
    const std::lock_guard lock(mutex);
    return speed;
  }

  const Profile profile;
  const ReplayPace pace;
  std::vector<Event> events;
  const Clock& clock;
  DeviceSink* sink = nullptr;

  // Used by the delivering thread.
  std::optional<InTimeOrder> order;  // of what comes next
  std::int64_t lastUs = 0;           // stamp of the last item delivered
  bool warned = false;
  std::string untold;       // why the first sample can't be read, until the sink is told
  std::int64_t handUs = 0;  // kManual: position in the recording's time
  std::int64_t firstUs = 0;

  mutable std::mutex mutex;
  std::condition_variable_any moved;
  double speed;
  DeviceStatus status;
  bool ended = false;

  std::jthread thread;
};

Replay::Replay(Profile profile,
               const ReplayOptions& options,
               std::vector<Event> events,
               const Clock& clock) {
  requireSpeed(options.speed);
  impl_ = std::make_unique<Impl>(std::move(profile), options, std::move(events), clock);
  impl_->status.tactile.port = "replay";
}

Replay::~Replay() { stop(); }

HandDescription Replay::hand() const { return impl_->profile.hand(); }

DeviceInfo Replay::info() const {
  DeviceInfo info;
  info.serial = impl_->profile.info().serial;
  info.firmware = impl_->profile.info().firmware;
  info.sensorRevision =
      static_cast<int>(parseInteger(impl_->profile.info().sensorRevision).value_or(0));
  return info;
}

std::vector<SeriesDescription> Replay::series() const {
  const std::span all(impl_->profile.series());
  const auto further = all.subspan(std::min(kHandSeries, all.size()));
  return {further.begin(), further.end()};
}

void Replay::start(DeviceSink& sink) {
  Impl& impl = *impl_;
  if (impl.sink) throw std::logic_error("Replay::start: it was started already");
  impl.sink = &sink;
  impl.rewind();
  impl.lastUs = 0;
  const std::int64_t firstUs = impl.nextUs();
  impl.lastUs = impl.firstUs = firstUs == kNever ? 0 : firstUs;
  impl.handUs = 0;
  if (impl.pace == ReplayPace::kManual) return;
  impl.thread = std::jthread([&impl](const std::stop_token& stop) { impl.runGuarded(stop); });
}

void Replay::stop() noexcept {
  Impl& impl = *impl_;
  if (!impl.sink) return;
  impl.thread = {};  // requests its end and waits for it
  impl.sink = nullptr;
  const std::lock_guard lock(impl.mutex);
  impl.status.tactile.state = PortState::kClosed;
  if (impl.status.motion) impl.status.motion->state = PortState::kClosed;
}

DeviceStatus Replay::status() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->status;
}

std::future<CommandAnswer> Replay::submit(DeviceCommand) {
  std::promise<CommandAnswer> refused;
  refused.set_exception(std::make_exception_ptr(DeviceError(
      DeviceFault::kUnsupported, "replay", "a recording accepts no commands: connect a hand")));
  return refused.get_future();
}

void Replay::setSpeed(double factor) {
  requireSpeed(factor);
  const std::lock_guard lock(impl_->mutex);
  impl_->speed = factor;
  impl_->moved.notify_all();
}

void Replay::advance(std::int64_t recordedUs) {
  Impl& impl = *impl_;
  if (!impl.sink || impl.pace != ReplayPace::kManual)
    throw std::logic_error("Replay::advance: it isn't moved by hand, or wasn't started");
  if (recordedUs < 0) throw std::invalid_argument("Replay::advance: time only goes forward");
  if (finished()) return;
  impl.handUs += recordedUs;
  if (!impl.deliverUntil(impl.firstUs + impl.handUs, {})) return;
  if (impl.nextUs() == kNever) impl.deliverUntil(kNever, {});
}

bool Replay::finished() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->ended;
}

}  // namespace palpate
