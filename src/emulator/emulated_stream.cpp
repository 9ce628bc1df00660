#include "palpate/emulator/emulated_stream.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "palpate/core/escaped_line.h"
#include "palpate/core/file_descriptor.h"
#include "palpate/core/network_place.h"
#include "palpate/core/time.h"

#include "emulator/stream_encoder.h"

namespace palpate {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;
// A hand that is later than this does not catch up.
constexpr std::int64_t kMaxLateUs = kSecondUs;

}  // namespace

void EmulatedStreamOptions::validate() const {
  if (!networkPlaceOf(where))
    throw std::invalid_argument("'" + shortened(where) +
                                "' is not [ADDRESS:]PORT, for example 9871 or 0.0.0.0:9871; " +
                                kNetworkPlaceRule);
  OptionCheck{"EmulatedStreamOptions"}(kRateHz, "rateHz", rateHz);
}

class EmulatedStream::Loop {
 public:
  Loop(std::unique_ptr<PhysicalHand> model,
       EmulatedStreamOptions options,
       EmulatedStreamObserver observer)
      : options_((options.validate(), std::move(options))),
        place_(networkPlaceOf(options_.where).value()),
        model_(std::move(model)),
        observer_(std::move(observer)),
        encoder_(model_->hand(), options_.format),
        byteFaults_(options_.faults, options_.seed),
        wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
        values_(model_->hand().layout->numReadings()) {
    if (options_.faults.bootS) outages_.push_back({{0.0, *options_.faults.bootS}, false});
    for (const Outage& stall : options_.faults.stalls) outages_.push_back({stall, false});
    for (const Outage& unplug : options_.faults.unplugs) outages_.push_back({unplug, true});
    listen();
    thread_ = std::thread([this] { runGuarded(); });
  }

  ~Loop() {
    const std::uint64_t one = 1;
    [[maybe_unused]] const ssize_t ignored = ::write(wake_.get(), &one, sizeof one);
    thread_.join();
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  std::string name() const { return "tcp:" + place_.text(); }
  bool isOpenToOthers() const { return place_.isOpenToOthers(); }
  EmulatedStreamCounts counts() const {
    std::lock_guard lock(mutex_);
    return counts_;
  }

 private:
  struct ScheduledFault {
    Outage outage;
    bool isUnplug = false;
    bool isCounted = false;
  };

  void listen() { listener_ = listenAt(place_, name(), SOCK_STREAM, 1); }

  void runGuarded() {
    try {
      while (turn()) {
      }
    } catch (const std::exception& error) {
      client_ = FileDescriptor();
      listener_ = FileDescriptor();
      std::lock_guard lock(mutex_);
      counts_.failure = error.what();
    }
  }

  // Waits for what happens next, and does it. Returns false at the end.
  bool turn() {
    const bool isBlocked = options_.asFastAsRead && !pending_.empty();
    std::int64_t waitUs = -1;
    if ((client_.get() >= 0 || unplugged_) && !isBlocked)
      waitUs = options_.asFastAsRead
                   ? 0
                   : std::max<std::int64_t>(dueUs_ - systemClock().monotonicUs(), 0);
    pollfd watched[] = {
        {wake_.get(), POLLIN, 0},
        {client_.get() >= 0 ? client_.get() : listener_.get(),
         static_cast<short>(client_.get() >= 0 && !pending_.empty() ? POLLIN | POLLOUT : POLLIN),
         0}};
    const timespec limit{waitUs / kSecondUs, waitUs % kSecondUs * 1000};
    if (::ppoll(watched, 2, waitUs < 0 ? nullptr : &limit, nullptr) < 0 && errno != EINTR)
      throw std::system_error(errno, std::generic_category(), "waiting for a client");
    if (watched[0].revents != 0) return false;
    if (client_.get() < 0 && watched[1].revents != 0) accept();
    if (client_.get() >= 0 && watched[1].revents != 0) serve();
    const bool isRunning = client_.get() >= 0 || unplugged_;
    const bool isDue =
        options_.asFastAsRead ? pending_.empty() : systemClock().monotonicUs() >= dueUs_;
    if (isRunning && isDue) frame();
    return true;
  }

  void accept() {
    client_ =
        FileDescriptor(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (client_.get() < 0) return;
    const int on = 1;
    ::setsockopt(client_.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    dueUs_ = systemClock().monotonicUs();
    if (options_.faults.junkStartBytes > 0) {
      pending_ = byteFaults_.junk(options_.faults.junkStartBytes);
      std::lock_guard lock(mutex_);
      counts_.faults.junkBytes += options_.faults.junkStartBytes;
    }
    const std::vector<std::byte> beginning = encoder_.beginning();
    pending_.insert(pending_.end(), beginning.begin(), beginning.end());
    flush();
    std::lock_guard lock(mutex_);
    ++counts_.clients;
  }

  void hangUp() {
    client_ = FileDescriptor();
    pending_.clear();
  }

  // What a client sends is not used; the end of its connection is noticed.
  void serve() {
    std::byte ignored[4096];
    const ssize_t n = ::recv(client_.get(), ignored, sizeof ignored, MSG_DONTWAIT);
    if (n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR)) return hangUp();
    flush();
  }

  void flush() {
    while (client_.get() >= 0 && !pending_.empty()) {
      const ssize_t n =
          ::send(client_.get(), pending_.data(), pending_.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
      if (n < 0 && (errno == EAGAIN || errno == EINTR)) return;
      if (n < 0) return hangUp();
      pending_.erase(pending_.begin(), pending_.begin() + n);
    }
  }

  // Begins and ends unplugs; returns whether nothing can be sent now.
  bool isOut(double timeS) {
    bool isOut = false, isUnplugged = false;
    for (ScheduledFault& fault : outages_) {
      if (timeS < fault.outage.atS || timeS >= fault.outage.atS + fault.outage.durationS) continue;
      isOut = true;
      isUnplugged = isUnplugged || fault.isUnplug;
      if (std::exchange(fault.isCounted, true)) continue;
      std::lock_guard lock(mutex_);
      ++(fault.isUnplug ? counts_.faults.unplugs : counts_.faults.stalls);
    }
    if (isUnplugged && !unplugged_) {
      hangUp();
      listener_ = FileDescriptor();
    }
    if (!isUnplugged && unplugged_) listen();
    unplugged_ = isUnplugged;
    return isOut || client_.get() < 0;
  }

  void frame() {
    const double timeS = static_cast<double>(number_) / options_.rateHz;
    dueUs_ += std::llround(1e6 / options_.rateHz);
    if (const std::int64_t nowUs = systemClock().monotonicUs(); dueUs_ < nowUs - kMaxLateUs)
      dueUs_ = nowUs;
    model_->advanceTo(timeS);
    const std::uint64_t number = number_++;
    if (isOut(timeS) || !pending_.empty()) {
      std::lock_guard lock(mutex_);
      ++counts_.lost;
      return;
    }
    model_->measure(values_);
    if (observer_) observer_({number, timeS, hostTime_.nowUs(), values_, *model_});
    send(number, timeS);
  }

  void send(std::uint64_t number, double timeS) {
    const std::int64_t deviceUs = std::llround(timeS * 1e6);
    FaultCounts faults;
    const auto add = [&](const auto& append, std::optional<std::uint64_t> frame) {
      LineMessage message;
      message.checksummed = encoder_.isChecksummed();
      message.frame = frame;
      append(message.bytes);
      byteFaults_.apply(message, faults);
      pending_.insert(pending_.end(), message.bytes.begin(), message.bytes.end());
    };
    if (!model_->hand().axes.empty())
      add([&](auto& out) { encoder_.appendAngles(out, deviceUs, model_->joints().angles()); }, {});
    if (!model_->hand().temperatureSensors.empty() && timeS >= temperaturesDueS_) {
      add([&](auto& out) { encoder_.appendTemperatures(out, deviceUs, model_->temperatures()); },
          {});
      temperaturesDueS_ = std::floor(timeS) + 1.0;
    }
    add([&](auto& out) { encoder_.appendFrame(out, number, deviceUs, values_); }, number);
    flush();
    std::lock_guard lock(mutex_);
    ++counts_.frames;
    counts_.faults.spoiltChecksums += faults.spoiltChecksums;
    counts_.faults.droppedBytes += faults.droppedBytes;
    counts_.faults.insertedBytes += faults.insertedBytes;
    counts_.faults.damagedFrames += faults.damagedFrames;
  }

  const EmulatedStreamOptions options_;
  NetworkPlace place_;  // its port is fixed by the constructor
  const std::unique_ptr<PhysicalHand> model_;
  const EmulatedStreamObserver observer_;
  const StreamEncoder encoder_;
  const HostTime hostTime_;
  ByteFaults byteFaults_;
  std::vector<ScheduledFault> outages_;
  FileDescriptor wake_, listener_, client_;
  bool unplugged_ = false;
  std::uint64_t number_ = 0;  // of the next frame
  std::int64_t dueUs_ = 0;    // monotonic time of the next frame
  double temperaturesDueS_ = 0.0;
  std::vector<float> values_;
  std::vector<std::byte> pending_;  // for the client
  mutable std::mutex mutex_;
  EmulatedStreamCounts counts_;  // guarded by mutex_
  std::thread thread_;
};

EmulatedStream::EmulatedStream(std::unique_ptr<PhysicalHand> model,
                               EmulatedStreamOptions options,
                               EmulatedStreamObserver observer)
    : loop_(std::make_unique<Loop>(std::move(model), std::move(options), std::move(observer))) {}
EmulatedStream::~EmulatedStream() = default;

std::string EmulatedStream::name() const { return loop_->name(); }
bool EmulatedStream::isOpenToOthers() const { return loop_->isOpenToOthers(); }
EmulatedStreamCounts EmulatedStream::counts() const { return loop_->counts(); }

}  // namespace palpate
