#include "gui/link/alarm_notifier.h"

#include <QApplication>
#include <utility>

#include <palpate/core/time.h>

namespace palpate::gui {

QString handAlarm(const GraspStatus& status, std::int64_t nowUs) {
  QString why = QString::fromStdString(status.unprotected);
  if (!why.isEmpty()) why.prepend("not protected: ");
  if (!status.portGone) return why;
  const GraspReport& gone = *status.portGone;
  // No number of seconds: a text that changes would sound again.
  if (static_cast<double>(nowUs - gone.endUs) / kUsPerS >= gone.remainingMotionS.value_or(0.0))
    return why;
  return "the hand is still moving, and the window can't stop it: use the emergency stop, or "
         "switch its power off; " +
         (why.isEmpty() ? QString::fromStdString(gone.text) : why);
}

AlarmNotifier::AlarmNotifier(QObject* parent)
    : QObject(parent), playSound([] { QApplication::beep(); }) {}

void AlarmNotifier::updateAlarms(const std::vector<Alarm>& alarms,
                                 std::int64_t monoUs,
                                 const QString& hand) {
  std::set<AlarmKind> now;
  QStringList texts;
  bool isNew = false;
  for (const Alarm& alarm : alarms) {
    now.insert(alarm.kind);
    texts.append(QString::fromStdString(alarm.text));
    if (activeAlarms_.contains(alarm.kind)) continue;
    isNew = true;
    emit raised(texts.back());
  }
  if (!hand.isEmpty()) texts.prepend(hand);
  if (std::exchange(hand_, hand) != hand && !hand.isEmpty()) {
    isNew = true;
    emit raised(hand);
  }
  if (isNew || (!texts.isEmpty() && monoUs - lastUs_ >= kAgainUs)) {
    lastUs_ = monoUs;
    if (!muted_) playSound();
  }
  activeAlarms_ = std::move(now);
  if (texts == texts_) return;
  texts_ = texts;
  emit changed(texts_);
}

}  // namespace palpate::gui
