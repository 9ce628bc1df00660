#include "device/descriptor_channel.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <limits>
#include <system_error>

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "palpate/core/error.h"

namespace palpate {
namespace {

using DescriptorChannelSteadyClock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kWriteLimit{1000};

// Milliseconds until the deadline, for poll(); rounded up, so that the last one is not a busy loop.
int untilMs(DescriptorChannelSteadyClock::time_point deadline) {
  const auto left =
      std::chrono::ceil<milliseconds>(deadline - DescriptorChannelSteadyClock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, std::numeric_limits<int>::max()));
}

bool wouldBlock(int error) { return error == EAGAIN || error == EWOULDBLOCK; }

}  // namespace

DescriptorChannel::DescriptorChannel(std::string name, int fd, bool isSocket)
    : name_(std::move(name)),
      fd_(fd),
      isSocket_(isSocket),
      wake_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (wake_.get() < 0)
    throw DeviceError(DeviceFault::kBusy, name_, std::generic_category().message(errno));
}

void DescriptorChannel::gone(int error) const {
  const std::string reason = error == 0 || error == EIO ? "the other side closed the connection"
                                                        : std::generic_category().message(error);
  throw DeviceError(DeviceFault::kDisconnected, name_, "connection lost (" + reason + ")");
}

ssize_t DescriptorChannel::receive(std::span<std::byte> into) {
  return ::read(fd_, into.data(), into.size());
}

std::size_t DescriptorChannel::take(std::span<std::byte> into, short events) {
  const ssize_t got = receive(into);
  if (got > 0) return static_cast<std::size_t>(got);
  if (got < 0) {
    if (wouldBlock(errno) || errno == EINTR) {
      // Nothing to read after a hang-up or an error: no further bytes can arrive.
      if ((events & (POLLHUP | POLLERR | POLLNVAL)) != 0) gone(0);
      return 0;
    }
    gone(errno);
  }
  if (isSocket_) {
    atEnd_ = true;
    gone(0);
  }
  // A tty returns zero bytes when there is nothing to read (VMIN 0) as well as after a hang-up.
  int waiting = 0;
  if ((events & (POLLHUP | POLLERR)) != 0 || ::ioctl(fd_, FIONREAD, &waiting) != 0) gone(0);
  return 0;
}

std::size_t DescriptorChannel::read(std::span<std::byte> into, milliseconds timeout) {
  if (into.empty()) return 0;
  const auto deadline = DescriptorChannelSteadyClock::now() + std::max(timeout, milliseconds(0));
  for (;;) {
    pollfd waits[2] = {{fd_, POLLIN, 0}, {wake_.get(), POLLIN, 0}};
    const int ready = ::poll(waits, 2, untilMs(deadline));
    if (ready < 0 && errno != EINTR) gone(errno);
    if (ready > 0) {
      bool interrupted = false;
      if (waits[1].revents != 0) {
        std::uint64_t count = 0;
        interrupted = ::read(wake_.get(), &count, sizeof count) == sizeof count;
      }
      if (waits[0].revents != 0) {
        const std::size_t got = take(into, waits[0].revents);
        if (got > 0) return got;
      }
      if (interrupted) return 0;
    }
    if (DescriptorChannelSteadyClock::now() >= deadline) return 0;
  }
}

void DescriptorChannel::write(std::span<const std::byte> bytes) {
  const auto deadline = DescriptorChannelSteadyClock::now() + kWriteLimit;
  while (!bytes.empty()) {
    const ssize_t written = isSocket_ ? ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL)
                                      : ::write(fd_, bytes.data(), bytes.size());
    if (written > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(written));
      continue;
    }
    if (written < 0 && errno != EINTR && !wouldBlock(errno)) gone(errno);
    pollfd waits{fd_, POLLOUT, 0};
    if (::poll(&waits, 1, untilMs(deadline)) > 0 && (waits.revents & (POLLHUP | POLLERR)) != 0)
      gone(0);
    if (DescriptorChannelSteadyClock::now() >= deadline)
      throw DeviceError(
          DeviceFault::kSilent, name_, "the device accepts no data; is it switched on?");
  }
}

void DescriptorChannel::interrupt() noexcept {
  const std::uint64_t one = 1;
  // The write fails only when an interruption is pending already.
  [[maybe_unused]] const ssize_t ignored = ::write(wake_.get(), &one, sizeof one);
}

}  // namespace palpate
