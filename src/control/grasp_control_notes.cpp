// What the control of a hand tells its session: noted under the lock, handed over without it.
#include <exception>
#include <utility>

#include "palpate/control/grasp_control.h"

namespace palpate {

void GraspControl::note(RecordingEvent event, bool ends) {
  owed_.push_back({std::move(event), ends});
  if (ends) ++endsOwed_;
  owes_.notify_one();
}

void GraspControl::deliver() {
  while (true) {
    Owed owed;
    {
      const std::lock_guard lock(mutex_);
      if (owed_.empty()) return;
      owed = std::move(owed_.front());
      owed_.pop_front();
    }
    try {
      session_.note(owed.event);
    } catch (...) {
      // No memory: what moves a hand goes on without this line.
    }
    if (!owed.ends) continue;
    const std::lock_guard lock(mutex_);
    --endsOwed_;
  }
}

void GraspControl::deliverLoop(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    {
      std::unique_lock lock(mutex_);
      if (!owes_.wait(lock, stop, [this] { return !owed_.empty(); })) return;
    }
    deliver();
  }
}

// Without a thread for it, in the call itself.
void GraspControl::deliverHere() {
  if (!delivery_.joinable()) deliver();
}

void GraspControl::round() {
  hear();
  send();
  heedAnswers();
  heedPorts();
  machine_.onTime(clock_.monotonicUs());
  send();
  report();
}

}  // namespace palpate
