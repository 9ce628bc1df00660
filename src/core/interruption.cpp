#include "palpate/core/interruption.h"

#include <cstdint>

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace palpate {
namespace {

int wakeup = -1;  // descriptor of the Interruption object; a signal handler can only use globals

void onSignal(int) {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(wakeup, &one, sizeof one);
}

}  // namespace

Interruption::Interruption() {
  wakeup = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  struct sigaction action {};
  action.sa_handler = &onSignal;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) ::sigaction(kSignals[i], &action, nullptr);
  }
}

Interruption::~Interruption() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before_[i], nullptr);
  ::close(wakeup);
  wakeup = -1;
}

int Interruption::descriptor() const noexcept { return wakeup; }

bool Interruption::waitForSignal(int withinMs) {
  pollfd polled{wakeup, POLLIN, 0};
  if (::poll(&polled, 1, withinMs) <= 0) return false;
  std::uint64_t count = 0;
  return ::read(wakeup, &count, sizeof count) == sizeof count;
}

}  // namespace palpate
