#include "gui/record/recording_countdown.h"

#include <utility>

namespace palpate::gui {
namespace {

constexpr int kCountdownTickMs = 1000;

}  // namespace

RecordingCountdown::RecordingCountdown(QObject* parent) : QObject(parent) {
  timer_.setInterval(kCountdownTickMs);
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, &RecordingCountdown::tick);
}

void RecordingCountdown::start(int seconds, std::function<void()> begin) {
  leftS_ = seconds;
  begin_ = std::move(begin);
  timer_.start();
  emit changed();
}

bool RecordingCountdown::cancel() {
  if (!running()) return false;
  timer_.stop();
  leftS_ = 0;
  begin_ = {};
  emit cancelled();
  emit changed();
  return true;
}

void RecordingCountdown::tick() {
  if (!running()) return;
  if (--leftS_ > 0) {
    emit changed();
    return;
  }
  timer_.stop();
  const auto begin = std::exchange(begin_, {});
  emit changed();
  if (begin) begin();
}

}  // namespace palpate::gui
