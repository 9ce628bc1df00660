#include "gui/termination.h"

#include <QSocketNotifier>
#include <cstdint>

#include <sys/eventfd.h>
#include <unistd.h>

namespace palpate::gui {
namespace {

int descriptor = -1;  // of the one that waits; a handler knows nothing else

void onSignal(int) {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(descriptor, &one, sizeof one);
}

}  // namespace

Termination::Termination(QObject* parent) : QObject(parent) {
  descriptor = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  notifier_ = new QSocketNotifier(descriptor, QSocketNotifier::Read, this);
  connect(notifier_, &QSocketNotifier::activated, this, [this] {
    std::uint64_t count = 0;
    if (::read(descriptor, &count, sizeof count) == sizeof count) emit asked();
  });
  struct sigaction action {};
  action.sa_handler = &onSignal;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) ::sigaction(kSignals[i], &action, nullptr);
  }
}

Termination::~Termination() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before_[i], nullptr);
  delete notifier_;
  ::close(descriptor);
  descriptor = -1;
}

}  // namespace palpate::gui
